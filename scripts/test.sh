#!/bin/sh
# Installs what is needed, builds, and runs every test. Ends with ctest's closing lines.
#   scripts/test.sh            release build
#   scripts/test.sh asan-ubsan the same suite under AddressSanitizer and UndefinedBehaviorSanitizer
#   scripts/test.sh tsan       the same suite under ThreadSanitizer
#   scripts/test.sh PRESET ROOM...  only the tests of these folders of tests/, or fuzz.NAME
set -eu
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -eq 0 ] || shift
targets='' rooms=''
for room in "$@"; do
  case $room in
    fuzz.*) targets="$targets replay_${room#fuzz.}" ;;
    *) targets="$targets test_$room" ;;
  esac
  rooms="${rooms:+$rooms|}$room"
done
scripts/install_packages.sh
# shellcheck disable=SC2086  # names without blanks
scripts/build.sh "$preset" $targets
exec ctest --preset "$preset" -j "$(nproc)" --output-on-failure --progress ${rooms:+-R "^($rooms)[._]"}
