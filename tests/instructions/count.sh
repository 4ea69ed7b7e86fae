#!/bin/sh
# count.sh VALGRIND WORKLOAD WAY CEILING: instructions per pixel of the workload, as the difference of two runs.
set -eu
valgrind=$1 workload=$2 way=$3 ceiling=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

collected() {
  "$valgrind" --tool=callgrind --callgrind-out-file=/dev/null \
    --toggle-collect="scotopic::AppearanceBatch::apply*" "$workload" "$way" "$1" >"$folder/out" 2>"$folder/log" ||
    { cat "$folder/log" >&2; exit 1; }
  sed -n 's/.*Collected *: *\([0-9]*\).*/\1/p' "$folder/log"
}

short=$(collected 2)
target=$(cat "$folder/out")
long=$(collected 12)
per_pixel=$(awk "BEGIN { printf \"%.2f\", ($long - $short) / 40960 }")
echo "$way on $target: $per_pixel instructions per pixel, ceiling $ceiling"
# The ceilings are stated for AVX2; a machine without it skips, visibly.
[ "$target" = AVX2 ] || exit 77
awk "BEGIN { exit !($per_pixel <= $ceiling) }"
