#!/bin/sh
# Installs the packages of Debian 12 or 13 that building, testing and the demonstration need. Quiet; does nothing
# (and needs no network) where all are there already. Needs root, or sudo.
#   scripts/install_packages.sh farm   Slurm as well (3 MB), for the test of scripts/farm
set -eu

build="g++ cmake ninja-build pkg-config libopencolorio-dev libopenimageio-dev libopenexr-dev liblcms2-dev libssl-dev libhwy-dev
  libcli11-dev libfmt-dev nlohmann-json3-dev libgtest-dev libgmock-dev librapidcheck-dev libmpfr-dev valgrind
  libegl-dev libgl-dev libopengl-dev glslang-tools spirv-cross dpkg-dev file locales help2man pybind11-dev python3-dev python3-numpy"
# The programs that looks are tested in, the data that tables are checked against, the night image.
use="openimageio-tools opencolorio-tools python3-pyopencolorio python3-openimageio python3-scipy
  psychtoolbox-3-common blender-data liblcms2-utils icc-profiles-free ffmpeg gnuplot-nox imagemagick graphicsmagick gmic
  xvfb xauth libgl1-mesa-dri libegl1"
[ "${1:-}" != farm ] || use="$use slurmctld slurmd slurm-client munge"

missing=""
for package in $build $use; do
  status=$(dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null || true)
  case "$status" in ii*) ;; *) missing="$missing $package" ;; esac
done
[ -n "$missing" ] || exit 0

root=""
[ "$(id -u)" = 0 ] || root="sudo"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "installing Debian packages:$missing"
if ! { $root apt-get update && DEBIAN_FRONTEND=noninteractive \
       $root apt-get install -y --no-install-recommends $missing; } >"$log" 2>&1; then
  cat "$log"
  echo "could not install:$missing" >&2
  exit 1
fi
