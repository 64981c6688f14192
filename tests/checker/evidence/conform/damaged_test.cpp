// `conform` decides about captures with mistakes in single fields: it says what is wrong or what is
// there, and neither a sequence number from nowhere nor a huge bitmap costs memory or time.
#include <array>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "checker/evidence/conform/conform.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/fuzzing/shipped_capture.hpp"

namespace stormproof::conform::testing {
namespace damaged_test {

using fuzzing::CaptureBytes;

void expect_decisions(const char* name, const char* dds) {
  const CaptureBytes capture = fuzzing::shipped_capture(name);
  const auto profile =
      model::config::read_dds_profile(dds, {}, model::config::SpecPath::standard());
  ASSERT_TRUE(profile);
  std::set<Verdict> verdicts;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const CaptureBytes changed = fuzzing::with_mistakes(capture, seed);
    const std::array files{capture::MemoryCapture{"changed", changed, fuzzing::unpack_limit}};
    const auto conversation = capture::read_conversation(files);
    if (!conversation) {
      EXPECT_FALSE(conversation.error().message.empty()) << seed;
      continue;
    }
    const auto result =
        conform({*conversation, std::numeric_limits<std::int64_t>::max(), *profile, {}, {}, {}});
    if (!result) {
      EXPECT_FALSE(result.error().message.empty()) << seed;
      continue;
    }
    verdicts.insert(result->verdict);
    EXPECT_LE(result->explained, result->checked) << seed;
  }
  EXPECT_GE(verdicts.size(), 2U) << "some mistakes matter, some do not";
}
TEST(DamagedCapture, ConformDecidesWhateverANumberClaims) {
  expect_decisions("fastdds291_ap_np1_ne2_r0", "fastdds-2.9.1");
}
TEST(DamagedCapture, ConformDecidesWithAServerWhateverANumberClaims) {
  expect_decisions("discovery-server/fastdds291_ap150_client_np1_ne2_r0", "fastdds-server-2.6.11");
}

}  // namespace damaged_test
}  // namespace stormproof::conform::testing
