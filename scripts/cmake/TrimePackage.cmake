# What a package holds beside program, library and headers, and the Debian package: cpack -G DEB in the build directory.
install(DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/configs" "${CMAKE_CURRENT_SOURCE_DIR}/jobs"
        DESTINATION ${CMAKE_INSTALL_DATADIR}/trime_mpi)
install(DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/src/examples" DESTINATION ${CMAKE_INSTALL_DATADIR}/trime_mpi)
install(PROGRAMS "${CMAKE_CURRENT_SOURCE_DIR}/scripts/plot_mesh.py" DESTINATION ${CMAKE_INSTALL_DATADIR}/trime_mpi/scripts)
# Where Debian's Python looks under /usr; elsewhere: PYTHONPATH. plot_mesh.py finds it by itself.
install(DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/scripts/python/trime_mpi" DESTINATION lib/python3/dist-packages
        FILES_MATCHING PATTERN "*.py")
if(TARGET trime_python)
  install(TARGETS trime_python LIBRARY DESTINATION lib/python3/dist-packages/trime_mpi)
endif()
install(FILES "${CMAKE_CURRENT_SOURCE_DIR}/LICENSE" DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/trime-mpi RENAME copyright)

find_program(TRIME_GZIP gzip)
if(TRIME_GZIP)
  set(trime_changes "${CMAKE_CURRENT_BINARY_DIR}/changelog.gz")
  execute_process(COMMAND "${TRIME_GZIP}" -9nc "${CMAKE_CURRENT_SOURCE_DIR}/CHANGELOG.md" OUTPUT_FILE "${trime_changes}")
  install(FILES "${trime_changes}" DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/trime-mpi)
endif()

# The man page tells what the program says of itself, so it is made when the program is there.
find_package(Python3 QUIET COMPONENTS Interpreter)
if(Python3_FOUND)
  set(trime_man "${CMAKE_CURRENT_BINARY_DIR}/trime_mpi.1.gz")
  install(CODE "execute_process(COMMAND \"${Python3_EXECUTABLE}\"
    \"${CMAKE_CURRENT_SOURCE_DIR}/scripts/packaging/man_page.py\" \"$<TARGET_FILE:trime_mpi>\" \"${trime_man}\"
    RESULT_VARIABLE man_failed)
  if(man_failed)
    message(WARNING \"No man page: trime_mpi does not run here.\")
  endif()")
  install(FILES "${trime_man}" DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME trime-mpi)
set(CPACK_PACKAGE_VENDOR "TriMe-MPI")
set(CPACK_PACKAGE_CONTACT "TriMe-MPI <trime-mpi@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_RESOURCE_FILE_LICENSE "${CMAKE_CURRENT_SOURCE_DIR}/LICENSE")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)             # the shared libraries, as dpkg-shlibdeps finds them
if(TRIME_HAS_OPEN_MPI)
  set(trime_launcher openmpi-bin)
  set(trime_mpi_headers "libopenmpi-dev, libhdf5-openmpi-dev")
else()
  set(trime_launcher mpich)
  set(trime_mpi_headers "libmpich-dev, libhdf5-mpich-dev")
endif()
set(CPACK_DEBIAN_PACKAGE_DEPENDS "${trime_launcher}, python3") # mpirun, plot_mesh.py
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-h5py, python3-numpy, python3-matplotlib, python3-mpi4py") # the Python package
set(CPACK_DEBIAN_PACKAGE_SUGGESTS                  # to build with the library
    "g++, cmake, ${trime_mpi_headers}, libfmt-dev, libmuparser-dev, libproj-dev, libshp-dev")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION               # behind the line of the project; CPack indents it
"trime_mpi reads a shape and an element size from a config file, and writes one
HDF5 file that ParaView, VTK, FEniCS, PETSc and meshio open. It runs with MPI
ranks and OpenMP threads, and the mesh does not depend on their numbers. The
C++20 library and its headers are part of this package.")
include(CPack)
