# Installation: the program, the two libraries with their headers, the shipped specifications, and
# the CMake package `stormproof`: the targets stormproof::fsm and stormproof::model, and
# stormproof_add_test.
include(CMakePackageConfigHelpers)

set(_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/stormproof")

set_target_properties(stormproof_fsm PROPERTIES EXPORT_NAME fsm)
set_target_properties(stormproof_model PROPERTIES EXPORT_NAME model)
install(TARGETS stormproof_fsm stormproof_model EXPORT stormproofTargets)
if(TARGET stormproof)
  install(TARGETS stormproof)
endif()
install(EXPORT stormproofTargets NAMESPACE stormproof:: DESTINATION "${_package_dir}")

# Headers keep their folders: #include "model/scenario.hpp" reads the same in the tree and
# installed.
install(DIRECTORY fsm model DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/stormproof"
        FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY specs/ DESTINATION "${CMAKE_INSTALL_DATADIR}/stormproof/specs")
install(FILES LICENSE NOTICE DESTINATION "${CMAKE_INSTALL_DOCDIR}")

configure_package_config_file(cmake/stormproofConfig.cmake.in
  "${PROJECT_BINARY_DIR}/stormproofConfig.cmake"
  INSTALL_DESTINATION "${_package_dir}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/stormproofConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  cmake/StormproofAddTest.cmake
  "${PROJECT_BINARY_DIR}/stormproofConfig.cmake"
  "${PROJECT_BINARY_DIR}/stormproofConfigVersion.cmake"
  DESTINATION "${_package_dir}")
