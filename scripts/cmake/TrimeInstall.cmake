# Installs the program, the library, its headers and a package for find_package(trime_mpi).
include(CMakePackageConfigHelpers)
set(trime_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/trime_mpi")
install(TARGETS trime trime_options trime_hdf5 EXPORT trime_mpiTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS trime_mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/include/trime" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT trime_mpiTargets NAMESPACE trime:: DESTINATION ${trime_package_dir})
configure_package_config_file("${CMAKE_CURRENT_SOURCE_DIR}/scripts/cmake/trime_mpiConfig.cmake.in"
  "${CMAKE_CURRENT_BINARY_DIR}/trime_mpiConfig.cmake" INSTALL_DESTINATION ${trime_package_dir})
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/trime_mpiConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/trime_mpiConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/trime_mpiConfigVersion.cmake" DESTINATION ${trime_package_dir})
