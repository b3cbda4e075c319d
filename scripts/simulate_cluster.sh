#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the program on a simulated cluster: SimGrid's SMPI makes all ranks take turns on one core of this machine, times
# what they compute, and simulates what they send over the network that a platform file describes. The run is repeated,
# and each stretch of work between two calls of MPI takes the least of its times: see scripts/cluster/simulated_work.hpp.
#   scripts/simulate_cluster.sh --ranks P [options] config.ini [section.key=value ...]
#     --report FILE    the numbers of the run as JSON; its seconds are simulated
#     --cluster FILE   the platform: nodes named node0, node1, ... (scripts/cluster/fat_tree.xml)
#     --cores N        ranks on a node (64)
#     --runs N         so many runs, of which the last one is told, with the least times of all (3)
#     --hash HEX       the mesh_hash that must come out; without it a real run finds it first
#     --keep DIR       where the times of the stretches stay: a file of doubles for each rank, in seconds
#     --program FILE   the simulated program (build/simulated/trime_mpi, built if it is not given)
#     --build-only     builds it, and stops
# One thread a rank, no output of meshes. Exit codes: those of the program; 2 bad use; 4 no simulator, or another mesh.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/scripts/packages.sh"

fail() { # CODE MESSAGE
  echo "simulate_cluster.sh: $2" >&2
  exit "$1"
}
usage() { sed -n '6,15s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; }

ranks='' cluster="$root/scripts/cluster/fat_tree.xml" cores=64 runs=3 report='' hash='' program='' keep='' build_only=no rest=()
while [ $# -gt 0 ]; do
  [ "$1" != --record ] || set -- --report "${@:2}" # its name before
  case "$1" in
    --ranks | --cluster | --cores | --runs | --report | --hash | --keep | --program)
      [ $# -ge 2 ] || fail 2 "$1 needs a value; see --help"
      declare "${1#--}=$2"
      shift ;;
    --build-only) build_only=yes ;;
    --help | -h) usage; exit 0 ;;
    -*) fail 2 "unknown option $1; see --help" ;;
    *) rest+=("$1") ;;
  esac
  shift
done

command -v smpirun >/dev/null || trime_need_packages "${trime_simulation_packages[@]}" || fail 4 "no simulator here"
command -v smpirun >/dev/null || fail 4 "no simulator here: SimGrid's smpirun is not on the PATH"
if [ -z "$program" ]; then
  program="$root/build/simulated/trime_mpi"
  [ -x "$program" ] || echo "Building into $root/build/simulated; the first time takes some minutes." >&2
  [ -f "$root/build/simulated/build.ninja" ] || (cd "$root" && trime_quietly configure cmake --preset simulated)
  trime_quietly build cmake --build "$root/build/simulated" --target trime_mpi
fi
[ "$build_only" = no ] || exit 0

[[ $ranks =~ ^[1-9][0-9]{0,5}$ ]] || fail 2 "--ranks '$ranks': expected a number of ranks, 1 or more, such as --ranks 64"
[[ $cores =~ ^[1-9][0-9]{0,3}$ ]] || fail 2 "--cores '$cores': expected the number of ranks on a node, such as --cores 64"
[[ $runs =~ ^[1-9][0-9]?$ ]] || fail 2 "--runs '$runs': expected a number of runs, 1 to 99, such as --runs 3"
[ -f "$cluster" ] || fail 2 "there is no platform file $cluster"
[ -f "$program" ] || fail 2 "there is no program $program"
[ "${#rest[@]}" -gt 0 ] || fail 2 "no config file is given; see --help"

work=$(mktemp -d "${TMPDIR:-/tmp}/trime-simulation-XXXXXX")
trap 'rm -rf "$work"' EXIT
for ((rank = 0; rank < ranks; ++rank)); do # one line a rank
  echo "node$((rank / cores))"
done >"$work/hosts"

# hash_of FILE: the mesh_hash in a report, empty if there is none.
hash_of() { sed -n 's/.*"mesh_hash_hex": *"\([0-9a-f]*\)".*/\1/p' "$1" 2>/dev/null | head -n 1; }

if [ -z "$hash" ]; then
  real="$root/build/release/trime_mpi"
  [ -x "$real" ] || fail 2 "no real run to compare with: build $real (scripts/run.sh does), or give the mesh_hash with --hash"
  trime_mpi_environment
  status=0
  "$real" "${rest[@]}" output.interval=0 --quiet --report "$work/real.json" || status=$?
  [ "$status" -eq 0 ] || [ "$status" -eq 5 ] || fail "$status" "the real run, with which this one is compared, failed"
  hash=$(hash_of "$work/real.json")
fi

# Factors of 1: the network of the platform file as it stands, not corrected for the Ethernet that SMPI was first
# calibrated on. os, or, ois: what a core spends on a message (LogGP's o), 0.2 us. ompi: collectives as Open MPI does them.
# privatization: no rank has globals of its own to keep (what main.cpp has serves signals only), and one copy of the
# code stays in the caches, as it does on a real core. With a copy for each rank every turn of a rank began with fetching
# its code: a mesh of 16 000 points on 64 ranks took 0.067 s in place of 0.045.
# The solver of the network takes shares below maxmin/precision as 0. With 1e-5, its default, what rounding left of the
# usage of a link with hundreds of flows was above it, and SimGrid crashed in the message that tells so.
simulation=(
  --cfg=smpi/simulate-computation:no # comm does
  --cfg=smpi/privatization:no --cfg=maxmin/precision:1e-4
  --cfg=network/bandwidth-factor:1 --cfg=network/latency-factor:1
  --cfg=smpi/os:0:2e-7:0 --cfg=smpi/or:0:2e-7:0 --cfg=smpi/ois:0:2e-7:0
  --cfg=smpi/coll-selector:ompi --cfg=smpi/host-speed:10Gf --log=root.thres:warning
)
export TRIME_SIMULATED_WORK=${keep:-$work/least} TMPDIR=$work OMP_NUM_THREADS=1
mkdir -p "$TRIME_SIMULATED_WORK"
rm -f "$TRIME_SIMULATED_WORK"/work-*
new_and_delete=$(dirname "$program")/libtrime_large_arrays.so
[ -f "$new_and_delete" ] || fail 2 "there is no $new_and_delete beside the program: build both, see --build-only"
for ((run = 0; run < runs; ++run)); do
  status=0 told=/dev/stdout
  [ "$run" -eq $((runs - 1)) ] || told=/dev/null
  LD_PRELOAD=$new_and_delete smpirun -quiet -np "$ranks" -platform "$cluster" -hostfile "$work/hosts" "${simulation[@]}" \
    "$program" "${rest[@]}" output.interval=0 --threads 1 --report "$work/report.json" >"$told" || status=$?
  [ "$status" -eq 0 ] || [ "$status" -eq 5 ] || break # 5: a mesh that is marked
done
[ -s "$work/report.json" ] || fail $((status > 0 ? status : 4)) "the simulated run left no report"
[ -z "$report" ] || cp "$work/report.json" "$report"
found=$(hash_of "$work/report.json")
[ "$found" = "$hash" ] || fail 4 "mesh_hash $found on $ranks simulated ranks, $hash on a real one; please report this with the config"
exit "$status"
