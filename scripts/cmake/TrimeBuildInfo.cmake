# Header app/build_info.hpp with the git commit, renewed at each build but only touched when it changes.
#  Included by CMakeLists.txt, and run by itself (cmake -P) with OUTPUT and SOURCE set.
if(CMAKE_SCRIPT_MODE_FILE)
  execute_process(COMMAND git -C "${SOURCE}" describe --always --dirty=-changed --abbrev=12
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT commit)
    set(commit "unknown")
  endif()
  file(WRITE "${OUTPUT}.new" "#pragma once\n#define TRIME_GIT_COMMIT \"${commit}\"\n")
  execute_process(COMMAND "${CMAKE_COMMAND}" -E copy_if_different "${OUTPUT}.new" "${OUTPUT}")
  return()
endif()

set(trime_generated_dir "${CMAKE_CURRENT_BINARY_DIR}/generated")
add_custom_target(trime_build_info
  COMMAND "${CMAKE_COMMAND}" -E make_directory "${trime_generated_dir}/app"
  COMMAND "${CMAKE_COMMAND}" -DOUTPUT=${trime_generated_dir}/app/build_info.hpp -DSOURCE=${PROJECT_SOURCE_DIR}
          -P "${CMAKE_CURRENT_LIST_FILE}"
  BYPRODUCTS "${trime_generated_dir}/app/build_info.hpp"
  COMMENT "Noting the git commit")
