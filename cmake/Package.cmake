# `cmake --build build --target package`: a Debian package with the program, its specifications,
# manual page and completions, and the libraries. What the program prints of itself is made with it.
if(TARGET stormproof)
  set(_made "${PROJECT_BINARY_DIR}/share")
  set(_pages "")
  function(stormproof_printed file)
    add_custom_command(OUTPUT "${_made}/${file}"
      COMMAND stormproof ${ARGN} > "${_made}/${file}.new"
      COMMAND "${CMAKE_COMMAND}" -E rename "${_made}/${file}.new" "${_made}/${file}"
      DEPENDS stormproof
      COMMENT "stormproof ${ARGN}"
      VERBATIM)
    set(_pages ${_pages} "${_made}/${file}" PARENT_SCOPE)
  endfunction()
  file(MAKE_DIRECTORY "${_made}")
  stormproof_printed(stormproof.1 man)
  stormproof_printed(stormproof.bash completion bash)
  stormproof_printed(_stormproof completion zsh)
  stormproof_printed(stormproof.fish completion fish)
  add_custom_target(stormproof_pages DEPENDS ${_pages})
  install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" --build \"${PROJECT_BINARY_DIR}\" --target stormproof_pages COMMAND_ERROR_IS_FATAL ANY)")
  install(FILES "${_made}/stormproof.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
  install(FILES "${_made}/stormproof.bash"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME stormproof)
  install(FILES "${_made}/_stormproof"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions")
  install(FILES "${_made}/stormproof.fish"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
endif()

# The tests are no part of it; stormproof_pages builds what is.
set(CMAKE_SKIP_PACKAGE_ALL_DEPENDENCY ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME stormproof)
set(CPACK_PACKAGE_VENDOR "the stormproof authors")
set(CPACK_PACKAGE_CONTACT "the stormproof authors <stormproof@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "checks whether a ROS 2 / DDS system discovers itself in time")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION net)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cvc5, spin, graphviz")
# With the Python module, for the Python that it was compiled for.
if(STORMPROOF_PYTHON)
  math(EXPR _next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
    "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${_next_minor})")
  string(APPEND CPACK_DEBIAN_PACKAGE_SUGGESTS ", python3-numpy, python3-pandas")
endif()
include(CPack)
