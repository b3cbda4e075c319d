# Options shared by the library, the program and the tests; never exported to users of the library.
#  -ffp-contract=off keeps a*b+c in two roundings on every processor: part of the promise "one config, one mesh".
add_library(trime_options INTERFACE)
target_compile_options(trime_options INTERFACE
  -ffp-contract=off -fno-math-errno
  -Wall -Wextra -Wpedantic
  $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow> # in a group of sources a header may shadow names of the sources before it
  -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
  # g++ takes a source of a group for a header, whose types must not have members without linkage.
  $<$<AND:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>)
if(TRIME_WARNINGS_AS_ERRORS)
  target_compile_options(trime_options INTERFACE -Werror)
endif()
if(TRIME_NATIVE)
  target_compile_options(trime_options INTERFACE -march=native)
endif()
if(TRIME_SANITIZE)
  list(JOIN TRIME_SANITIZE "," sanitizers)
  add_compile_options(-fsanitize=${sanitizers} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${sanitizers})
endif()
if(TRIME_FUZZ) # all code tells libFuzzer where it has been
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -g1 -DNDEBUG")

# trime_test_options(TARGET): compiles the sources of a test faster: they call the code whose speed matters, and hold
# little of it. -O1 takes two thirds of the time of -O3; under sanitizers, -O0 takes half of the time of -O1.
function(trime_test_options target)
  if(TRIME_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  elseif(CMAKE_BUILD_TYPE STREQUAL Release)
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# trime_unite(TARGET): compiles up to twelve sources as one, which parses their headers once, where TRIME_UNITY is on.
# scripts/check_includes.py finds includes that such a build does not miss.
function(trime_unite target)
  if(NOT TRIME_UNITY)
    return()
  endif()
  find_package(Python3 COMPONENTS Interpreter)
  if(NOT Python3_FOUND)
    message(STATUS "TRIME_UNITY needs Python 3, which was not found: ${target} is compiled source by source")
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_avx(2|512)\\.cpp$") # with options of their own
  list(TRANSFORM sources PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" REGEX "^[^/]")
  execute_process(COMMAND ${Python3_EXECUTABLE} "${PROJECT_SOURCE_DIR}/scripts/cmake/unity_groups.py" 12 ${sources}
    OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE "\n" ";" lines "${lines}")
  foreach(line IN LISTS lines)
    string(REGEX MATCH "^(.*)\t(.*)$" line "${line}")
    set_source_files_properties("${CMAKE_MATCH_2}" PROPERTIES UNITY_GROUP "${CMAKE_MATCH_1}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
