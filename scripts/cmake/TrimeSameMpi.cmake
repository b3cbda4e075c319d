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
  set(hdf5_mpi "not Open MPI")
  set(our_mpi "not Open MPI")
  if(uses MATCHES " ompi_")
    set(hdf5_mpi "Open MPI")
  endif()
  if(TRIME_HAS_OPEN_MPI)
    set(our_mpi "Open MPI")
  endif()
  if(uses MATCHES " MPI_" AND NOT hdf5_mpi STREQUAL our_mpi)
    message(FATAL_ERROR "Expected an HDF5 of the same MPI as ${MPI_CXX_COMPILER}, which is ${our_mpi}. Found ${library}, "
      "whose MPI is ${hdf5_mpi}. Set HDF5_C_COMPILER_EXECUTABLE to the right h5pcc or HDF5_ROOT to the right place, in a "
      "new build directory; or take the preset mpich for Debian's MPICH.")
  endif()
endforeach()
