#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs clang-tidy with the rules of .clang-tidy, and fails if it finds anything. scripts/test.sh does not run it.
#   scripts/tidy.sh FILE...   checks these sources, e.g. $(git diff --name-only main -- 'src/*.cpp'); needs build/ci
#   scripts/tidy.sh --all     checks the library and the program in the groups of preset tsan; needs build/tsan.
#                             A group of twelve sources takes about 10 s; there are 31 groups.
# The build folder must be configured, and its target trime_build_info built. Environment: TRIME_JOBS (cores).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

[ $# -gt 0 ] || { sed -n '3,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2; }
if [ "$1" = --all ]; then
  build=build/tsan
  mapfile -t files < <(find "$build/CMakeFiles/trime.dir/Unity" "$build/CMakeFiles/trime_app.dir/Unity" -name '*_cxx.cxx')
else
  build=build/ci
  files=("$@")
fi
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "${TRIME_JOBS:-$(nproc)}" clang-tidy --quiet -p "$build"
