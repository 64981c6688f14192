# Targets that check or repair the source text: format, format-check, tidy. They are never part of
# `all`.
add_custom_target(format
  COMMAND "${PROJECT_SOURCE_DIR}/cmake/format.sh" --fix
  USES_TERMINAL VERBATIM)
add_custom_target(format-check
  COMMAND "${PROJECT_SOURCE_DIR}/cmake/format.sh"
  USES_TERMINAL VERBATIM)

find_program(STORMPROOF_RUN_CLANG_TIDY NAMES run-clang-tidy-14 run-clang-tidy)
if(STORMPROOF_RUN_CLANG_TIDY)
  add_custom_target(tidy
    COMMAND "${STORMPROOF_RUN_CLANG_TIDY}" -quiet -p "${PROJECT_BINARY_DIR}"
            "${PROJECT_SOURCE_DIR}/(fsm|model|props|checker|tests)/.*"
    USES_TERMINAL VERBATIM)
endif()
