# What the Python module that meshes in place needs: the headers of Python and of pybind11. Where they are missing, it is
# not built. The Python is the one of the system, since mpi4py and dolfinx are packages of the system; another one:
# -DTRIME_PYTHON=/path/to/python3 in a new build directory.
find_program(TRIME_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH DOC "The Python for which the module is built")
find_program(TRIME_PYTHON NAMES python3)
set(trime_python_found OFF)
if(TRIME_PYTHON AND NOT TRIME_SIMULATE AND NOT TRIME_SANITIZE)
  execute_process(COMMAND "${TRIME_PYTHON}" -c
    "import sysconfig as s; print(s.get_path('include') + ';' + (s.get_config_var('EXT_SUFFIX') or ''))"
    OUTPUT_VARIABLE trime_python_facts OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(trime_python_facts)
    list(GET trime_python_facts 0 trime_python_include)
    list(GET trime_python_facts 1 trime_python_suffix)
    find_path(TRIME_PYBIND11_INCLUDE pybind11/pybind11.h HINTS "${trime_python_include}")
    if(EXISTS "${trime_python_include}/Python.h" AND TRIME_PYBIND11_INCLUDE)
      set(trime_python_found ON)
    endif()
  endif()
endif()
option(TRIME_BUILD_PYTHON "Build the Python module that meshes in place (needs pybind11 and Python's headers)"
       ${trime_python_found})
if(TRIME_BUILD_PYTHON AND NOT trime_python_found)
  message(FATAL_ERROR "TRIME_BUILD_PYTHON needs Python's headers and pybind11, and neither a simulation nor sanitizers "
    "(Debian: python3-dev pybind11-dev). Found for ${TRIME_PYTHON}: '${trime_python_include}', "
    "'${TRIME_PYBIND11_INCLUDE}'.")
endif()
# g++ may then still inline functions of the same source, as in a program.
set(trime_shared_code $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
