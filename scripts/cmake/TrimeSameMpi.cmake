# Stops where HDF5 was built with another MPI: such a program links, and fails when it runs. Open MPI is told from all
# others, which share one binary interface (MPICH, Intel MPI, MVAPICH), by the symbols of its own that HDF5 uses.
include(CheckCXXSymbolExists)
set(CMAKE_REQUIRED_LIBRARIES MPI::MPI_CXX)
check_cxx_symbol_exists(OPEN_MPI mpi.h TRIME_HAS_OPEN_MPI)
unset(CMAKE_REQUIRED_LIBRARIES)

foreach(library IN LISTS HDF5_C_LIBRARIES)
  if(NOT CMAKE_NM OR NOT library MATCHES "/libhdf5\\.(so|a)$")
    continue()
  endif()
  execute_process(COMMAND "${CMAKE_NM}" --undefined-only --dynamic "${library}" OUTPUT_VARIABLE uses ERROR_QUIET)
  if(NOT uses MATCHES "MPI_") # a static library has no dynamic symbols
    execute_process(COMMAND "${CMAKE_NM}" --undefined-only "${library}" OUTPUT_VARIABLE uses ERROR_QUIET)
  endif()
  set(expected "another than Open MPI")
  set(found "another than Open MPI")
  if(TRIME_HAS_OPEN_MPI)
    set(expected "Open MPI")
  endif()
  if(uses MATCHES " ompi_")
    set(found "Open MPI")
  endif()
  if(uses MATCHES " MPI_" AND NOT found STREQUAL expected)
    message(FATAL_ERROR "HDF5 is of another MPI than ${MPI_CXX_COMPILER}: expected ${expected}, found ${found} in "
      "${library}. Name the right HDF5 in a new build directory, by HDF5_C_COMPILER_EXECUTABLE (its h5pcc) or "
      "HDF5_ROOT; for Debian's MPICH take the preset mpich.")
  endif()
endforeach()
