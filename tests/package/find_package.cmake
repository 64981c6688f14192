# The steps of the test package.find_package; see CMakeLists.txt for the variables.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

list(JOIN sanitize " " cxx_flags)
set(prefix "${work}/prefix")
file(REMOVE_RECURSE "${work}")

run("${CMAKE_COMMAND}" --install "${build}" --prefix "${prefix}")
run("${CMAKE_COMMAND}" -G "${generator}" -S "${consumer}" -B "${work}/build"
  "-DCMAKE_PREFIX_PATH=${prefix}"
  "-DCMAKE_CXX_COMPILER=${compiler}"
  "-DCMAKE_BUILD_TYPE=${build_type}"
  "-DCMAKE_CXX_FLAGS=${cxx_flags}"
  "-DBoost_DIR=${boost}"
  "-DSTORMPROOF_EXPECTED_VERSION=${version}")
run("${CMAKE_COMMAND}" --build "${work}/build")

execute_process(COMMAND "${work}/build/consumer" OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
if(NOT output STREQUAL "2 participants\n")
  message(FATAL_ERROR "the consumer printed '${output}' instead of '2 participants'")
endif()

# What was installed must not mention the source or build tree, except as text inside the binaries.
file(GLOB_RECURSE package_files "${prefix}/*.cmake")
foreach(file IN LISTS package_files)
  file(READ "${file}" text)
  string(FIND "${text}" "${build}" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${file} refers to the build tree ${build}")
  endif()
endforeach()
