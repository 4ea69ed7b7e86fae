#!/bin/sh
# The demonstration and the tests on Debian 13, as a newcomer meets them: a clone of HEAD in a fresh system, made with
# debootstrap, which nothing of this machine reaches into. Needs root, the network, and 6 GB.
#   scripts/test_debian13.sh [DIR [COMMAND...]]   DIR: where the system is, or is made (/var/tmp/scotopic-debian13)
#   COMMAND: what to run there in place of scripts/demo.sh and scripts/test.sh
# JOBS: how many compilers at once (2). CACHE: a folder for ccache's objects, kept from one run to the next.
set -eu
cd "$(dirname "$0")/.."
root=${1:-/var/tmp/scotopic-debian13}
[ $# -eq 0 ] || shift
[ "$(id -u)" = 0 ] || { echo "test_debian13.sh: only root may make and enter a system of its own" >&2; exit 2; }
command -v debootstrap >/dev/null || { echo "test_debian13.sh: needs debootstrap (apt-get install debootstrap)" >&2; exit 2; }

mirror=$(cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null |
  sed -n 's/^\(URIs:\|deb\( \[[^]]*\]\)*\) *\(http[^ ]*\/debian\)\/*\( .*\)*$/\3/p' | head -n 1)
if [ ! -e "$root/etc/debian_version" ]; then
  echo "making a Debian 13 in $root"
  debootstrap --variant=minbase --include=ca-certificates,git trixie "$root" "${mirror:-http://deb.debian.org/debian}" \
    >"$root.log" 2>&1 || { tail -n 20 "$root.log"; exit 1; }
fi

leave() {
  for place in mnt/ccache dev/pts dev proc; do
    ! mountpoint -q "$root/$place" || umount "$root/$place"
  done
}
trap leave EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount --bind /dev/pts "$root/dev/pts"
cp -L /etc/resolv.conf "$root/etc/resolv.conf"
set -- "${@:-scripts/demo.sh && scripts/test.sh}"
launcher=''
if [ -n "${CACHE:-}" ]; then
  mkdir -p "$CACHE" "$root/mnt/ccache"
  mount --bind "$CACHE" "$root/mnt/ccache"
  launcher=ccache
fi

rm -rf "$root/root/scotopic"
git clone -q --no-hardlinks . "$root/root/scotopic"
enter() { nice -n 10 chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root TERM=dumb "$@"; }
[ -z "$launcher" ] || enter sh -c 'command -v ccache || { apt-get update && apt-get install -y ccache; }' >/dev/null
enter ${launcher:+CCACHE_DIR=/mnt/ccache CMAKE_CXX_COMPILER_LAUNCHER=$launcher} CMAKE_BUILD_PARALLEL_LEVEL="${JOBS:-2}" \
  sh -c "cd /root/scotopic && $*"
