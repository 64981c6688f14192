// Captures with mistakes in single fields stay readable.
#include "tests/fuzzing/capture_mutator.hpp"

#include <gtest/gtest.h>

#include "tests/fuzzing/shipped_capture.hpp"
#include "tests/fuzzing/targets.hpp"

namespace stormproof::fuzzing {
namespace capture_mutator_test {

TEST(CaptureMutator, MakesMistakesThatLeaveTheFileReadable) {
  const CaptureBytes capture = shipped_capture("fastdds291_veth_np1_ne2_r0");
  std::size_t accepted = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const CaptureBytes changed = with_mistakes(capture, seed);
    EXPECT_EQ(changed, with_mistakes(capture, seed));
    EXPECT_NE(changed, CaptureBytes{});
    const std::string_view text{reinterpret_cast<const char*>(changed.data()), changed.size()};
    if (fuzzing::capture(text) == Outcome::accepted) ++accepted;
  }
  EXPECT_EQ(accepted, 300U);
  EXPECT_EQ(with_mistakes({1, 2, 3}, 7), (CaptureBytes{1, 2, 3}));
}

}  // namespace capture_mutator_test
}  // namespace stormproof::fuzzing
