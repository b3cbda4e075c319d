# Every dependency of the program, with a hint where one is missing.
set(MPI_CXX_SKIP_MPICXX ON) # the C++ bindings of old MPI headers warn, and nobody uses them
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)

set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
if(NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "This HDF5 has no MPI support; install the parallel one (Debian: libhdf5-openmpi-dev).")
endif()
add_library(trime_hdf5 INTERFACE)
target_include_directories(trime_hdf5 SYSTEM INTERFACE ${HDF5_C_INCLUDE_DIRS})
target_compile_definitions(trime_hdf5 INTERFACE ${HDF5_C_DEFINITIONS})
target_link_libraries(trime_hdf5 INTERFACE ${HDF5_C_LIBRARIES} MPI::MPI_CXX)
