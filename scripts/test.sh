#!/bin/sh
# Installs what is needed, builds, and runs every test. Ends with ctest's closing lines.
#   scripts/test.sh            release build
#   scripts/test.sh asan-ubsan the same suite under AddressSanitizer and UndefinedBehaviorSanitizer
#   scripts/test.sh tsan       the same suite under ThreadSanitizer
set -eu
cd "$(dirname "$0")/.."
preset=${1:-release}
scripts/install_packages.sh
scripts/build.sh "$preset"
exec ctest --preset "$preset" -j "$(nproc)" --output-on-failure --progress
