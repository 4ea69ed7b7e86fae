#!/bin/sh
# The long form of the fault tests: every fault at every place, 200 kills per writing verb, and what the neighbours
# (oiiotool, ocioconvert, ociobakelut) do. Builds what is needed; prints the table of docs/faults.md; exit code 1
# if a promise was broken. Takes two hours or so on two processors; SCOTOPIC_FAULTS=short for the form of the suite.
set -eu
cd "$(dirname "$0")/.."
preset=${1:-release}
form=${SCOTOPIC_FAULTS:-long}
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --target test_faults >/dev/null
table=$PWD/build/$preset/faults-table.md
rm -f "$table"
result=0
SCOTOPIC_FAULTS=$form SCOTOPIC_FAULT_TABLE=$table "build/$preset/tests/test_faults" --gtest_brief=1 || result=1
echo
echo "| fault | tries | expected | seen |"
echo "|---|---:|---|---|"
cat "$table"
exit $result
