#!/bin/sh
# Installs Slurm (Debian's slurmctld, slurmd, slurm-client, munge), builds, starts a cluster of one node of its own,
# runs a shot on it, kills a task, and looks whether all frames are there and right. Nothing of it stays running.
set -eu
cd "$(dirname "$0")/../.."
scripts/install_packages.sh farm
scripts/build.sh release
exec ctest --preset release -R '^farm\.' --verbose
