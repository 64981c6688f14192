# Sanitizers apply to every target of the build. A finding ends the program, so that no test can
# pass over it. Three checks of UBSan are left out, because they double the time of compilation: a
# null pointer and an object that is too small show as invalid accesses under AddressSanitizer, and
# the sources have no cast that could misalign a pointer.
if(STORMPROOF_SANITIZE)
  set(STORMPROOF_SANITIZE_FLAGS
    -fsanitize=${STORMPROOF_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  if(STORMPROOF_SANITIZE MATCHES undefined)
    list(APPEND STORMPROOF_SANITIZE_FLAGS -fno-sanitize=null,alignment,object-size)
  endif()
  add_compile_options(${STORMPROOF_SANITIZE_FLAGS})
  add_link_options(${STORMPROOF_SANITIZE_FLAGS})
  # Programs of 300 MB each: lld links one in a seventh of the time.
  find_program(STORMPROOF_LLD ld.lld)
  if(STORMPROOF_LLD AND CMAKE_CXX_COMPILER_ID MATCHES Clang)
    add_link_options(-fuse-ld=lld)
  endif()
endif()
