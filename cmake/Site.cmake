# `cmake --build build --target site`: all pages, drawings and the API as a site in build/site, by
# MkDocs and Doxygen (cmake/debian-packages.txt, site). specs/site/build.py says what it contains. With the
# page that simulates where that can be built (Play.cmake).
find_package(Python3 COMPONENTS Interpreter QUIET)
if(TARGET stormproof AND Python3_FOUND)
  set(with_play)
  if(TARGET play)
    set(with_play --engine "${PROJECT_BINARY_DIR}/play/engine" --node "${STORMPROOF_NODE}")
  endif()
  add_custom_target(site
    COMMAND "${Python3_EXECUTABLE}" "${PROJECT_SOURCE_DIR}/specs/site/build.py"
            --source "${PROJECT_SOURCE_DIR}" --program "$<TARGET_FILE:stormproof>"
            --output "${PROJECT_BINARY_DIR}/site" ${with_play}
    DEPENDS stormproof
    USES_TERMINAL VERBATIM)
  if(TARGET play)
    add_dependencies(site play)
  endif()
endif()
