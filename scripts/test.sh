#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs every test: installs what is missing (Debian 12), then format, layers, a release build with all its tests, the
# parallel tests with a second MPI, MPICH, and the serial tests and fuzz targets under the sanitizers of
# a second compiler, clang.
#   scripts/test.sh [--quick]      --quick: without second MPI, sanitizers and second compiler
# The last line says how many tests passed and failed. Environment: TRIME_JOBS (cores), TRIME_NO_INSTALL=1,
# TRIME_FULL_TABLE=1 (equal meshes on 1 to 16 ranks in all combinations), TRIME_FUZZ_SECONDS (of each fuzz target),
# TRIME_SIMD (see src/building.md).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/scripts/packages.sh"
cd "$root"

quick=no
case "${1:-}" in
  --quick) quick=yes ;;
  '') ;;
  *) sed -n '3,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2 ;;
esac

trime_need_packages "${trime_run_packages[@]}" "${trime_test_packages[@]}"
trime_mpi_environment
export OMPI_MCA_rmaps_base_oversubscribe=1 OMP_WAIT_POLICY=passive
jobs=${TRIME_JOBS:-$(nproc)}
# Sanitizers of this age need addresses that are not spread too widely.
fixed_addresses=()
if setarch -R true 2>/dev/null; then
  fixed_addresses=(setarch -R)
fi
passed=0
failed=0
failures=()
output=$(mktemp "${TMPDIR:-/tmp}/trime-test-XXXXXX.log")
trap 'rm -f "$output"' EXIT

# Sets `used`: the seconds of all processors that whatever has ended until now has taken.
processor_seconds() {
  times >"$output" # no pipe: its end would be a process of its own, with times of its own
  used=$(awk '{ for (k = 1; k <= 2; ++k) { split($k, part, "[ms]"); sum += 60 * part[1] + part[2] } }
              END { printf "%.0f", sum }' "$output")
}

# Notes the time, for `stop_clock`.
start_clock() {
  processor_seconds
  begin=$SECONDS begin_used=$used
}

# Sets `took`: the time since `start_clock`, as text.
stop_clock() {
  processor_seconds
  took="$((SECONDS - begin)) s, $((used - begin_used)) s of processors"
}

# stage NAME COMMAND...: one test of its own; what it prints is shown only if it fails.
stage() {
  local name=$1
  shift
  start_clock
  if trime_quietly "$name" "$@"; then
    passed=$((passed + 1))
    stop_clock
    echo "-- $name: passed ($took)"
  else
    failed=$((failed + 1))
    failures+=("$name")
    echo "-- $name: FAILED"
    return 1
  fi
}

# tests PRESET SLOTS: runs the tests of a preset, each in as many slots as it has ranks, and adds up what ctest counts.
tests() {
  local preset=$1 slots=$2 status=0 total bad
  echo "-- ctest, preset $preset"
  start_clock
  ${fixed_addresses[@]+"${fixed_addresses[@]}"} ctest --preset "$preset" -j "$slots" 2>&1 | tee "$output" || status=$?
  read -r bad total < <(sed -n 's/^.*% tests passed, \([0-9]*\) tests failed out of \([0-9]*\).*/\1 \2/p' "$output") ||
    { bad=1 total=1; }
  [ "$total" -gt 0 ] && { [ "$status" -eq 0 ] || [ "$bad" -gt 0 ]; } || { bad=1 total=1; } # no test at all is a failure
  passed=$((passed + total - bad))
  failed=$((failed + bad))
  [ "$bad" -eq 0 ] || failures+=("ctest $preset")
  stop_clock
  echo "-- ctest, preset $preset: $took"
}

# build PRESET: configures and builds it.
build() {
  echo "-- building $1"
  local options=()
  # A fresh clone compiles sources in groups, which takes less time; where somebody works on them, each compiles alone.
  if [ "$1" = ci ] && [ ! -e build/ci ]; then options=(-D TRIME_UNITY=ON); fi
  stage "configure_$1" cmake --preset "$1" ${options[@]+"${options[@]}"} && stage "build_$1" \
    ${fixed_addresses[@]+"${fixed_addresses[@]}"} cmake --build --preset "$1" -j "$jobs"
}

# The bytes of our sources against .clang-format.
check_format() {
  find include src tests scripts/cluster \( -name '*.hpp' -o -name '*.cpp' \) -print0 | xargs -0 clang-format --dry-run -Werror
}
export -f check_format

stage format bash -euo pipefail -c check_format || true
stage layers /usr/bin/python3 scripts/check_layers.py || true
stage includes /usr/bin/python3 scripts/check_includes.py || true
stage functions /usr/bin/python3 scripts/check_functions.py || true
stage doxygen scripts/doxygen.sh || true
stage python flake8 || true
if build ci; then
  tests ci "$((4 * jobs))" # for half of their time most of them wait for mpirun
fi
if [ "$quick" = no ]; then
  # The one file of which sanitizers leave out a part: without them, by the second compiler.
  stage second_compiler clang++ -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Wconversion \
    -Wno-sign-conversion -Werror -Iinclude -Isrc src/app/large_arrays.cpp || true
  for preset in mpich asan tsan; do
    if build "$preset"; then
      tests "$preset" "$jobs"
    fi
  done
fi

[ "$failed" -eq 0 ] || printf 'Failed: %s\n' "${failures[*]}"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
