// The entry point that libFuzzer calls, compiled once for each target of targets.hpp.
#include <cstddef>
#include <cstdint>

#include "tests/fuzzing/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const char* text = reinterpret_cast<const char*>(data);
  static_cast<void>(stormproof::fuzzing::STORMPROOF_FUZZ_TARGET({text, size}));
  return 0;
}
