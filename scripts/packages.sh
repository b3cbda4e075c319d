# SPDX-License-Identifier: BSD-3-Clause
# The one list of the Debian packages that this project needs, and a function that installs those that are missing.
# To be sourced by run.sh, test.sh, simulate_cluster.sh and same_bits.py; does nothing by itself.
# shellcheck shell=bash disable=SC2034

# To build and run the program, and to draw its mesh.
trime_run_packages=(
  g++ cmake ninja-build                           # tool chain
  openmpi-bin libopenmpi-dev libhdf5-openmpi-dev  # MPI, and HDF5 with MPI
  libfmt-dev libcli11-dev libmuparser-dev         # text, command line, formulas
  nlohmann-json3-dev                              # GeoJSON; the file by which ParaView plays steps
  libshp-dev libproj-dev                          # shapefiles; longitude and latitude
  python3 python3-h5py python3-numpy python3-matplotlib # scripts/python, scripts/plot_mesh.py, scripts/scaling.py
  python3-dev pybind11-dev python3-mpi4py         # the Python module that meshes in place: trime_mpi.parallel
)
# To run the tests, beside the above.
trime_test_packages=(
  libgtest-dev libbenchmark-dev                   # unit tests, benchmarks
  libcgal-dev libboost-dev                        # oracles of the tests, and trime_check: CGAL, big integers of Boost
  libmpfr-dev libgmp-dev                          # oracle of the elementary functions
  hdf5-tools python3-vtk9 python3-meshio          # h5diff, and two foreign readers of the mesh file
  python3-gmsh python3-dolfinx freefem++ dolfin-bin # readers of the formats of other programs
  calculix-ccx                                    # a solver that reads .inp
  python3-netcdf4                                 # reads UGRID files
  python3-qgis qgis-providers                     # reads .2dm; 99 packages, 424 MB: without it one test is skipped
  gdal-bin python3-gdal                           # reads and writes maps: ogr2ogr, ogrinfo; Python too
  gmt-gshhg-full                                  # coasts of full resolution; 42 MB: without it one test is skipped
  python3-scipy gmsh                              # Poisson's equation, on meshes of Gmsh too, judge.py; benchmark.py --gmsh;
                                                  # scaling.py --model
  libpetsc-real-dev python3-petsc4py              # the PETSc example (the rest of PETSc comes with dolfinx); to_petsc()
  metis scotch                                    # edge_cut.py
  python3-pip python3-setuptools                  # installs scripts/python
  munge slurmctld slurmd slurm-client             # a SLURM of one node for the job scripts
  environment-modules                             # loads the module file
  iproute2                                        # hosts of one's own: network namespaces, for runs over TCP
  mpich libhdf5-mpich-dev                         # the other MPI, beside Open MPI, which stays the default
  doxygen                                         # reference pages of the public headers: scripts/doxygen.sh
  clang clang-format libomp-dev libclang-rt-14-dev # second compiler with its OpenMP and sanitizers, house style
  clang-tidy                                      # tidy.sh
  flake8 universal-ctags                          # rules for Python; the names and lengths of our functions
)

# To run the program on a simulated cluster, beside the first list: scripts/simulate_cluster.sh.
trime_simulation_packages=(
  libsimgrid-dev                                  # SimGrid: MPI, cores and network, simulated in one process
)

# To build and run the program for AArch64 on another processor, beside the first list: scripts/same_bits.py.
trime_aarch64_packages=(
  g++-aarch64-linux-gnu qemu-user-static          # cross compiler; runs its programs
)
# The arm64 packages that same_bits.py unpacks for it; they are not installed.
trime_aarch64_libraries=(
  libc6-dev libstdc++-12-dev libgcc-12-dev libgomp1
  libopenmpi-dev libhdf5-openmpi-dev libfmt-dev libcli11-dev libmuparser-dev nlohmann-json3-dev
  libshp-dev libproj-dev libcurl4-openssl-dev     # PROJ's CMake files ask for curl
)

# Prints those of its arguments that are not installed.
trime_missing_packages() {
  local package
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" = installed ] || printf '%s\n' "$package"
  done
}

# Installs what is missing of its arguments; with TRIME_NO_INSTALL=1, or without the right to install, says what and fails.
trime_need_packages() {
  if ! command -v dpkg-query >/dev/null; then
    echo "This is no Debian-like system, so nothing is installed. Needed, under their Debian names: $*" >&2
    return 0
  fi
  local missing=() update=(apt-get update) install=(apt-get install -y --no-install-recommends) as_root=()
  mapfile -t missing < <(trime_missing_packages "$@")
  [ "${#missing[@]}" -gt 0 ] || return 0
  install+=("${missing[@]}")
  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
      as_root=(sudo)
    fi
  fi
  if [ "${TRIME_NO_INSTALL:-0}" = 1 ]; then
    echo "Missing packages; TRIME_NO_INSTALL=1 forbids to install them. As root:" >&2
  elif [ "$(id -u)" -ne 0 ] && [ "${#as_root[@]}" -eq 0 ]; then
    echo "Missing packages, and no right to install them here. As root:" >&2
  else
    echo "Installing ${#missing[@]} missing packages: ${missing[*]}"
    trime_quietly packages ${as_root[@]+"${as_root[@]}"} "${update[@]}"
    trime_quietly packages ${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive "${install[@]}"
    return
  fi
  echo "  ${update[*]} && ${install[*]}" >&2
  return 1
}

# trime_quietly NAME COMMAND...: runs the command with its output in a log file, which is shown only if it fails.
trime_quietly() {
  local log status=0
  log=$(mktemp "${TMPDIR:-/tmp}/trime-$1-XXXXXX.log")
  shift
  "$@" >"$log" 2>&1 </dev/null || status=$?
  if [ "$status" -ne 0 ]; then
    tail -n 60 "$log" >&2
    echo "Failed with exit code $status: $*" >&2
    echo "Whole output: $log" >&2
    return "$status"
  fi
  rm -f "$log"
}

# Lets Open MPI start as root (containers) and start more ranks than there are cores.
trime_mpi_environment() {
  if [ "$(id -u)" -eq 0 ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  fi
}
