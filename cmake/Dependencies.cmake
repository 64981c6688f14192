# The libraries stormproof is built on. All of them are Debian packages; debian-packages.txt names
# them.

# Boost.MSM before 1.77 does not compile as C++20, and Debian 12's default Boost is 1.74. Say so
# here, because the compiler's own message is a thousand lines long.
find_package(Boost 1.77 QUIET)
if(NOT Boost_FOUND)
  unset(Boost_DIR CACHE)
  find_package(Boost QUIET)
  if(Boost_VERSION_STRING)
    set(_stormproof_boost_found
      "found only Boost ${Boost_VERSION_STRING} (in ${Boost_INCLUDE_DIRS})")
  else()
    set(_stormproof_boost_found "found no Boost")
  endif()
  message(FATAL_ERROR
    "stormproof needs the headers of Boost 1.77 or newer, but ${_stormproof_boost_found}. "
    "Older releases of Boost.MSM do not compile as C++20. "
    "On Debian 12: apt-get install libboost1.81-dev (it replaces libboost1.74-dev). "
    "Elsewhere: unpack a newer Boost and pass -DBoost_ROOT=<folder>.")
endif()

find_package(fmt REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json 3.10 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Threads REQUIRED)
find_package(EXPAT REQUIRED)
find_package(Z3 4.8.12 REQUIRED)
find_package(rapidcheck REQUIRED)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(SQLite3 REQUIRED)
find_package(PCAP REQUIRED)
set(CURSES_NEED_WIDE TRUE)
find_package(Curses REQUIRED)
find_package(LibLZMA REQUIRED)
find_package(ZLIB REQUIRED)

# Open MPI spreads a sweep over machines. A program without it sweeps on one machine; the tests need
# it, and read drawings and JUnit with tinyxml2.
if(STORMPROOF_BUILD_TESTS)
  find_package(tinyxml2 REQUIRED)
  find_package(MPI REQUIRED COMPONENTS CXX)
else()
  find_package(MPI QUIET COMPONENTS CXX)
endif()

if(STORMPROOF_PYTHON)
  set(PYBIND11_FINDPYTHON ON)
  find_package(Python REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 REQUIRED)
endif()

# yaml-cpp 0.8 put its target into a namespace; give 0.7's the same name.
if(NOT TARGET yaml-cpp::yaml-cpp)
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()
