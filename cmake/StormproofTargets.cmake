# One place for what the targets of the project have in common.

# stormproof_target(<target>): C++20 and include paths that start at the project's root.
# stormproof_target(<target> PUBLIC <name>): the same for a library that is installed and exported;
# it is known as stormproof::<name> in this build and to consumers of the installed package.
function(stormproof_target target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PUBLIC" "")
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    set(scope INTERFACE)
  else()
    set(scope PUBLIC)
  endif()
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/stormproof>)
  if(arg_PUBLIC)
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${arg_PUBLIC})
    if(NOT TARGET stormproof::${arg_PUBLIC})
      add_library(stormproof::${arg_PUBLIC} ALIAS ${target})
    endif()
  endif()
endfunction()
