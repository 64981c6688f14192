# Compiler flags of the project's own targets, as one interface target. Third-party headers are
# system headers and are not affected. Trajectories are integer arithmetic; where doubles are
# printed, forbid the contraction of a*b+c as well, so that every platform prints the same digits.
add_library(stormproof_flags INTERFACE)
target_compile_features(stormproof_flags INTERFACE cxx_std_20)
target_compile_options(stormproof_flags INTERFACE
  -ffp-contract=off
  -Wall
  -Wextra
  -Wpedantic
  -Wconversion
  -Wsign-conversion
  -Wold-style-cast
  -Wnon-virtual-dtor
  -Woverloaded-virtual
  -Wcast-align
  -Wcast-qual
  -Wextra-semi
  -Wformat=2
  -Wimplicit-fallthrough
  -Wundef
  # In a batch, names of one file would shadow those of another.
  $<$<NOT:$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wshadow>
  # It takes the files of a batch for headers, in which no type may be of one file alone.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond>
  $<$<CXX_COMPILER_ID:GNU>:-Wlogical-op>
  # GCC 12 reports overlapping copies in std::string that cannot happen (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${STORMPROOF_WERROR}>:-Werror>)

# The instrumentation of the sanitizers hides initialisations from GCC's flow analysis.
if(STORMPROOF_SANITIZE)
  target_compile_options(stormproof_flags INTERFACE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()
