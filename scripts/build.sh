#!/bin/sh
# Configures and builds one preset (default: release) into build/PRESET. Quiet unless something fails.
#   scripts/build.sh [PRESET [TARGET...]]
set -eu
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -eq 0 ] || shift
log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "building (preset $preset, into build/$preset)"
if ! { cmake --preset "$preset" && cmake --build --preset "$preset" ${1+--target "$@"}; } >"$log" 2>&1; then
  cat "$log"
  echo "the build failed; see above" >&2
  exit 1
fi
