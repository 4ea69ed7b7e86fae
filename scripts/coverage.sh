#!/bin/sh
# Line coverage of the library's rooms, receptors to scene, by their own tests and the properties in their short form;
# exits 1 below 95 %. Needs gcovr (Debian). Prints a table by file, and the lines that no test runs.
set -eu
cd "$(dirname "$0")/.."
rooms="receptors kernel adaptation stages acuity batch scene"
command -v gcovr >/dev/null || { echo "gcovr is not installed (apt-get install gcovr)" >&2; exit 1; }
cmake --preset coverage >/dev/null
find build/coverage -name '*.gcda' -delete
for room in $rooms properties; do
  cmake --build --preset coverage --target "test_$room" >/dev/null
  SCOTOPIC_DRAWS=1e5 SCOTOPIC_STRIDE=65536 "build/coverage/tests/test_$room" --gtest_brief=1
done
# Threads that count at once can leave a branch's number below 0, which gcovr takes for an error.
gcovr --root . --object-directory build/coverage --filter "src/($(echo "receptors kernel adaptation stages batch scene" | tr ' ' '|'))/" --fail-under-line 95 \
  --gcov-ignore-parse-errors -j "$(nproc)" build/coverage
