#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the reference pages of the public headers (include/trime) with Doxygen, and fails on any warning.
#   scripts/doxygen.sh [FOLDER]      FOLDER: where the pages are written, as FOLDER/html/index.html (default: build/doxygen)
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=${1:-$root/build/doxygen}
case $folder in
  -*) sed -n '3,4s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2 ;;
esac
command -v doxygen >/dev/null || { echo "doxygen is missing (Debian: doxygen)" >&2; exit 1; }
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
cd "$root"

# The first page.
cat >"$folder/mainpage.md" <<'PAGE'
# The library of TriMe-MPI {#mainpage}
These pages describe the public headers of the C++ library `trime::trime`, which makes large triangle meshes in the plane
with MPI. The functions throw the errors of `trime/core/error.hpp`. "Collective" means that all ranks of the communicator
must call the function.

Start with the programs in `src/examples`, and with the list of namespaces: `trime::meshing` makes meshes, `trime::shape`
describes shapes and `trime::sizing` edge lengths. `trime::io` and `trime::formats` write files, and `trime::handover`
passes the mesh to a solver.
PAGE

# Doxygen reads its settings from this text. Everything that is not set here has Doxygen's default.
doxygen - <<SETTINGS
PROJECT_NAME           = TriMe-MPI
PROJECT_BRIEF          = "Distributed generator of large 2D triangle meshes"
OUTPUT_DIRECTORY       = "$folder"
INPUT                  = include/trime "$folder/mainpage.md"
USE_MDFILE_AS_MAINPAGE = "$folder/mainpage.md"
FILE_PATTERNS          = *.hpp *.md
RECURSIVE              = YES
STRIP_FROM_PATH        = include
STRIP_FROM_INC_PATH    = include
JAVADOC_AUTOBRIEF      = YES
EXTRACT_ALL            = YES
EXTRACT_STATIC         = YES
HIDE_SCOPE_NAMES       = YES
SORT_MEMBER_DOCS       = NO
GENERATE_LATEX         = NO
QUIET                  = YES
WARNINGS               = YES
WARN_IF_INCOMPLETE_DOC = NO
WARN_AS_ERROR          = FAIL_ON_WARNINGS
MACRO_EXPANSION        = YES
HAVE_DOT               = NO
SEARCHENGINE           = NO
SETTINGS
echo "$folder/html/index.html"
