#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# First contact: installs what is missing (Debian 12), builds, makes a mesh on 2 ranks, draws it and says where it is.
#   scripts/run.sh [config.ini] [section.key=value ...] [options of trime_mpi]
# Without a config it takes configs/square.ini. Environment: TRIME_RANKS (2), OMP_NUM_THREADS (cores over ranks),
# TRIME_NO_INSTALL=1 (say which packages are missing, and stop).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/scripts/packages.sh"

if [ "${1:-}" = --help ] || [ "${1:-}" = -h ]; then
  sed -n '3,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
  exit 0
fi

config="$root/configs/square.ini"
case "${1:-}" in
  '' | -* | *=*) ;;
  *) config=$1; shift ;;
esac

ranks=${TRIME_RANKS:-2}
if ! [[ $ranks =~ ^[1-9][0-9]{0,5}$ ]]; then
  echo "run.sh: TRIME_RANKS=$ranks: expected a number of ranks, 1 or more, for example TRIME_RANKS=2" >&2
  exit 2
fi

trime_need_packages "${trime_run_packages[@]}"
trime_mpi_environment

# Build. Ninja finds out by itself, within a second, that nothing is to do.
build="$root/build/release"
program="$build/trime_mpi"
[ -x "$program" ] || echo "Building into $build; the first time takes some minutes (5 on two cores)."
[ -f "$build/build.ninja" ] || (cd "$root" && trime_quietly configure cmake --preset release)
trime_quietly build cmake --build "$build" --target trime_mpi

# Where will the mesh go? The program says it itself, and tells of all mistakes in the config.
resolved=$("$program" "$config" "$@" --print-config)
output_value() { sed -n '/^\[output\]/,/^\[/s/^ *'"$1"' *= *//p' <<<"$resolved" | head -n 1; }
directory=$(output_value directory)
name=$(output_value name)
formats=$(output_value formats | tr ',' ' ')
extra=()
case " $* " in
  *" output.directory="* | *" output.overwrite="*) ;; # the user decides
  *)
    if [ "${directory:-out}" = out ]; then # nobody asked for a place: ours, which may be overwritten
      directory="$root/out"
      extra=("output.directory=$directory" output.overwrite=true)
    fi ;;
esac
[ -n "$name" ] && [ "$name" != auto ] || name=$(basename "${config%.*}")
mesh="$directory/$name.h5"
identity() { stat -L -c '%d %i %s %y' "$mesh" 2>/dev/null || true; } # changes when the file is written anew
earlier=$(identity)

# Run, by the launcher of the MPI that the program was built with. All cores are shared out among the ranks; binding is
# left to the system, which suits a laptop, and there may be more ranks than cores.
cores=$(nproc)
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-$((cores > ranks ? cores / ranks : 1))}
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_rmaps_base_oversubscribe=1 # Open MPI; others do so by themselves
mpiexec=$(sed -n 's/^MPIEXEC_EXECUTABLE:[A-Z]*=//p' "$build/CMakeCache.txt")
status=0
"$mpiexec" -n "$ranks" "$program" "$config" ${extra[@]+"${extra[@]}"} "$@" || status=$?
[ "$status" -eq 0 ] || [ "$status" -eq 5 ] || exit "$status" # 5: the mesh is there, but marked
if [ "$(identity)" = "$earlier" ]; then                      # --validate and the like; no mesh of an earlier run is shown
  [ -z "$earlier" ] || echo "This run wrote no mesh; $mesh is that of an earlier run."
  exit "$status"
fi

picture="$directory/$name.png"
/usr/bin/python3 "$root/scripts/plot_mesh.py" "$mesh" -o "$picture"
paraview='' # only the formats of this run
case " $formats " in *" vtkhdf "*) paraview+="  ParaView  open ${mesh%.h5}.vtkhdf, colour by alpha"$'\n' ;; esac
case " $formats " in *" xdmf "*) paraview+="  ParaView  open ${mesh%.h5}.xdmf with the Xdmf3 reader, colour by alpha"$'\n' ;; esac
cat <<TEXT

Files
  $mesh   the mesh (HDF5, with the config and all numbers of the run)
  $picture  a picture of it
How to look at them
  picture   xdg-open $picture
$paraview  Python    PYTHONPATH=$root/scripts/python /usr/bin/python3 -c 'import trime_mpi; print(trime_mpi.read("$mesh"))'
  numbers   h5dump -A -g /trime_mpi $mesh   (package hdf5-tools)
TEXT
exit "$status"
