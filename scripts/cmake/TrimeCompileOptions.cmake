# Options shared by the library, the program and the tests; never exported to users of the library.
#  -ffp-contract=off keeps a*b+c in two roundings on every processor: part of the promise "one config, one mesh".
add_library(trime_options INTERFACE)
target_compile_options(trime_options INTERFACE
  -ffp-contract=off -fno-math-errno
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual)
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

# trime_precompile(TARGET HEADER...): parses the headers that most sources include, and those given, once a target. Not
# in the builds of users and of preset ci: there a source that forgets an include must fail.
function(trime_precompile target)
  if(TRIME_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <fmt/format.h> <algorithm> <array> <cmath> <cstdint> <functional>
      <memory> <optional> <span> <string> <unordered_map> <vector> ${ARGN})
  endif()
endfunction()
