#!/bin/sh
# Configures and builds one preset (default: release) into build/PRESET. Quiet unless something fails.
#   scripts/build.sh [PRESET [TARGET...]]
# SCOTOPIC_CONFIGURE: options for cmake, as -DSCOTOPIC_WERROR=ON, which CI sets.
set -eu
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -eq 0 ] || shift
log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "building (preset $preset, into build/$preset)"
# shellcheck disable=SC2086  # options without blanks
if ! { cmake --preset "$preset" ${SCOTOPIC_CONFIGURE:-} &&
       cmake --build --preset "$preset" ${1+--target "$@"}; } >"$log" 2>&1; then
  cat "$log"
  echo "the build failed; see above" >&2
  exit 1
fi
