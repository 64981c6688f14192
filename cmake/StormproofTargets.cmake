# One place for what the targets of the project have in common.
#
# Most of what a small source file costs is its headers. So sources are compiled in batches (CMake's
# unity build), and each batch starts with a precompiled header of the standard library. Names in
# anonymous namespaces therefore differ within a folder. -DCMAKE_UNITY_BUILD=OFF compiles file by
# file, which shows includes that are missing.

# stormproof_target(<target>): C++20 and include paths that start at the project's root.
# stormproof_target(<target> PUBLIC <name>): the same for a library that is installed and exported;
# it is known as stormproof::<name> in this build and to consumers of the installed package.
function(stormproof_target target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PUBLIC" "")
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/stormproof>)
  if(arg_PUBLIC)
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${arg_PUBLIC})
    add_library(stormproof::${arg_PUBLIC} ALIAS ${target})
  endif()
endfunction()

# stormproof_batches(<target> [<sources>]): at most so many of its sources are compiled as one, unless
# nothing is optimised, which takes less memory
function(stormproof_batches target)
  if(ARGC GREATER 1 AND ARGV1 LESS STORMPROOF_BATCH AND NOT STORMPROOF_SANITIZE)
    set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE ${ARGV1})
  endif()
endfunction()

# stormproof_sources(<variable> [FOLDERS <folders>] [EXCEPT <paths>]): the sources in and below the
# folders, without those files and folders; "." is the current folder without those below it. Without
# FOLDERS: all of the current one.
function(stormproof_sources variable)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FOLDERS;EXCEPT")
  if(NOT arg_FOLDERS)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  endif()
  foreach(folder IN LISTS arg_FOLDERS)
    if(folder STREQUAL ".")
      file(GLOB found CONFIGURE_DEPENDS *.cpp)
    else()
      file(GLOB_RECURSE found CONFIGURE_DEPENDS ${folder}/*.cpp)
    endif()
    list(APPEND sources ${found})
  endforeach()
  foreach(path IN LISTS arg_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "^${CMAKE_CURRENT_SOURCE_DIR}/${path}(/|$)")
  endforeach()
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

# GCC collects garbage while it compiles, early and often after a precompiled header; with a heap of
# 400 MB before it does, and again when that has doubled, it is quicker.
add_compile_options(
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-expand=100>
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=400000>)

# What runs long is optimised; a folder may compile the rest quickly (STORMPROOF_QUICKLY). The
# precompiled header is made once for each.
function(stormproof_optimised target runs_long)
  get_directory_property(options COMPILE_OPTIONS)
  set(headers stormproof_headers)
  if(runs_long)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3>)
  elseif(STORMPROOF_QUICKLY IN_LIST options)
    set(headers stormproof_quick_headers)
  endif()
  if(NOT TARGET ${headers})
    add_library(${headers} OBJECT "${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp")
    stormproof_target(${headers})
    target_link_libraries(${headers} PRIVATE fmt::fmt)
    target_precompile_headers(${headers} PRIVATE "${PROJECT_SOURCE_DIR}/cmake/standard_library.hpp")
  endif()
  target_precompile_headers(${target} REUSE_FROM ${headers})
  # GCC takes it only where the same is defined, also in a library that formats nothing.
  target_compile_definitions(${target} PRIVATE
    $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
endfunction()

# stormproof_library(<target> [PUBLIC <name>] [BATCH <sources>] [RUNS_LONG] [FOLDERS …] [EXCEPT …]): a
# static library; BATCH where sources are so large that fewer than STORMPROOF_BATCH are compiled as one
function(stormproof_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "RUNS_LONG" "PUBLIC;BATCH" "FOLDERS;EXCEPT")
  stormproof_sources(sources FOLDERS ${arg_FOLDERS} EXCEPT ${arg_EXCEPT})
  add_library(${target} STATIC ${sources})
  stormproof_target(${target} PUBLIC ${arg_PUBLIC})
  stormproof_optimised(${target} ${arg_RUNS_LONG})
  stormproof_batches(${target} ${arg_BATCH})
endfunction()

# stormproof_program(<target> <sources>)
function(stormproof_program target)
  add_executable(${target} ${ARGN})
  stormproof_target(${target})
  stormproof_optimised(${target} FALSE)
endfunction()
