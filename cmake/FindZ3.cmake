# Z3 with its C++ interface. Debian's libz3-dev brings no CMake package, so look for the files.
# Target: z3::z3
find_path(Z3_INCLUDE_DIR z3++.h)
find_library(Z3_LIBRARY z3)
if(Z3_INCLUDE_DIR AND EXISTS "${Z3_INCLUDE_DIR}/z3_version.h")
  file(STRINGS "${Z3_INCLUDE_DIR}/z3_version.h" _z3_lines
    REGEX "^#define Z3_(MAJOR_VERSION|MINOR_VERSION|BUILD_NUMBER) ")
  string(REGEX REPLACE "[^0-9;]*Z3[^0-9]*" "" _z3_numbers "${_z3_lines}")
  list(JOIN _z3_numbers "." Z3_VERSION)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Z3
  REQUIRED_VARS Z3_LIBRARY Z3_INCLUDE_DIR VERSION_VAR Z3_VERSION)
if(Z3_FOUND AND NOT TARGET z3::z3)
  add_library(z3::z3 UNKNOWN IMPORTED)
  set_target_properties(z3::z3 PROPERTIES
    IMPORTED_LOCATION "${Z3_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${Z3_INCLUDE_DIR}")
endif()
mark_as_advanced(Z3_INCLUDE_DIR Z3_LIBRARY)
