# `cmake --build build --target play`: the page that simulates as build/play/play.html, one file that needs nothing else,
# if emscripten and node are there (cmake/debian-packages.txt, play). Its engine has a compiler and a build of its own
# (checker/page/CMakeLists.txt); specs/site/play/pack.mjs puts the page together.
find_program(STORMPROOF_NODE NAMES node nodejs)
find_file(STORMPROOF_EMSCRIPTEN Emscripten.cmake
  HINTS /usr/share/emscripten/cmake/Modules/Platform
        "$ENV{EMSDK}/upstream/emscripten/cmake/Modules/Platform")
if(STORMPROOF_NODE AND STORMPROOF_EMSCRIPTEN)
  # Debian's emscripten asks for Debian's acorn, which another node does not find by itself.
  set(with_acorn "${CMAKE_COMMAND}" -E env NODE_PATH=/usr/share/nodejs --unset=CMAKE_CXX_COMPILER_LAUNCHER)
  add_custom_target(play
    COMMAND ${with_acorn} "${CMAKE_COMMAND}" -S "${PROJECT_SOURCE_DIR}/checker/page"
            -B "${PROJECT_BINARY_DIR}/play/engine" -G "${CMAKE_GENERATOR}" --log-level=WARNING
            -DCMAKE_TOOLCHAIN_FILE=${STORMPROOF_EMSCRIPTEN} -DCMAKE_BUILD_TYPE=Release
            "-DSTORMPROOF_HEADERS=${Boost_INCLUDE_DIRS}"
    COMMAND ${with_acorn} "${CMAKE_COMMAND}" --build "${PROJECT_BINARY_DIR}/play/engine" --target play
    COMMAND "${STORMPROOF_NODE}" "${PROJECT_SOURCE_DIR}/specs/site/play/pack.mjs"
            --source "${PROJECT_SOURCE_DIR}" --engine "${PROJECT_BINARY_DIR}/play/engine"
            --output "${PROJECT_BINARY_DIR}/play"
    USES_TERMINAL VERBATIM)
endif()
