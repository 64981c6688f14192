// Captures of specs/captures/, unpacked, for tests that damage them.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "checker/evidence/capture/decompress.hpp"
#include "tests/fuzzing/capture_mutator.hpp"

namespace stormproof::fuzzing {

inline constexpr std::size_t unpack_limit = 1U << 22U;  ///< bytes

/// The capture of this name, without .pcap.xz.
inline CaptureBytes shipped_capture(const std::string& name) {
  std::ifstream in{STORMPROOF_SPECS_DIR "/captures/" + name + ".pcap.xz", std::ios::binary};
  const CaptureBytes packed{std::istreambuf_iterator<char>{in}, {}};
  const auto plain = capture::unpack(packed, capture::Compression::xz, unpack_limit);
  EXPECT_TRUE(plain);
  return plain ? plain->bytes : CaptureBytes{};
}

}  // namespace stormproof::fuzzing
