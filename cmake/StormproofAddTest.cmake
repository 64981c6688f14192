# A robot's own test suite fails when a change of its profile makes discovery storm:
#
#   find_package(stormproof REQUIRED COMPONENTS test)
#   stormproof_add_test(NAME discovery SCENARIO fleet.yaml
#                       [REQUIRE observed|sampled|bounded|proved] [BASELINE known.yaml]
#                       [SET key=value …])
#
# adds a test that runs `stormproof check` on the scenario: it passes if discovery completes within
# its limits and without a storm, and nothing is violated (exit 0). REQUIRE is the least kind of
# verdict that will do, BASELINE what is known to fail, SET overrides. Paths are relative to the
# current source folder; a scenario may also be the name of a shipped one.
find_program(STORMPROOF_EXECUTABLE stormproof DOC "The stormproof program")

function(stormproof_add_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;SCENARIO;REQUIRE;BASELINE" "SET")
  foreach(needed IN ITEMS NAME SCENARIO)
    if(NOT arg_${needed})
      message(FATAL_ERROR "stormproof_add_test: ${needed} is missing")
    endif()
  endforeach()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "stormproof_add_test: unexpected ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT STORMPROOF_EXECUTABLE)
    message(FATAL_ERROR "stormproof_add_test: the program stormproof was not found; "
                        "set STORMPROOF_EXECUTABLE")
  endif()
  set(options "")
  if(arg_REQUIRE)
    list(APPEND options --require "${arg_REQUIRE}")
  endif()
  if(arg_BASELINE)
    list(APPEND options --baseline "${arg_BASELINE}")
  endif()
  foreach(change IN LISTS arg_SET)
    list(APPEND options --set "${change}")
  endforeach()
  add_test(NAME "${arg_NAME}"
    COMMAND "${STORMPROOF_EXECUTABLE}" check "${arg_SCENARIO}" ${options}
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}")
  set_tests_properties("${arg_NAME}" PROPERTIES LABELS stormproof)
endfunction()
