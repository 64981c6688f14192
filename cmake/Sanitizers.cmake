# Sanitizers apply to every target of the build. A finding ends the program, so that no test can
# pass over it.
if(STORMPROOF_SANITIZE)
  set(STORMPROOF_SANITIZE_FLAGS
    -fsanitize=${STORMPROOF_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_compile_options(${STORMPROOF_SANITIZE_FLAGS})
  add_link_options(${STORMPROOF_SANITIZE_FLAGS})
endif()
