// Captures with mistakes in single fields: whoever reads them says what is wrong or what is there,
// and neither a sequence number from nowhere nor a huge bitmap costs memory or time.
#include "tests/fuzzing/capture_mutator.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "checker/evidence/capture/decompress.hpp"
#include "checker/evidence/conform/conform.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/fuzzing/targets.hpp"

namespace stormproof::fuzzing {
namespace capture_mutator_test {

constexpr std::size_t unpack_limit = 1U << 22U;

CaptureBytes shipped(const std::string& name) {
  std::ifstream in{STORMPROOF_SPECS_DIR "/captures/" + name + ".pcap.xz", std::ios::binary};
  const CaptureBytes packed{std::istreambuf_iterator<char>{in}, {}};
  const auto plain = capture::unpack(packed, capture::Compression::xz, unpack_limit);
  EXPECT_TRUE(plain);
  return plain ? plain->bytes : CaptureBytes{};
}

TEST(CaptureMutator, MakesMistakesThatLeaveTheFileReadable) {
  const CaptureBytes capture = shipped("fastdds291_veth_np1_ne2_r0");
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

void expect_decisions(const char* name, const char* dds) {
  const CaptureBytes capture = shipped(name);
  const auto profile =
      model::config::read_dds_profile(dds, {}, model::config::SpecPath::standard());
  ASSERT_TRUE(profile);
  std::set<conform::Verdict> verdicts;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const CaptureBytes changed = with_mistakes(capture, seed);
    const std::array files{capture::MemoryCapture{"changed", changed, unpack_limit}};
    const auto conversation = capture::read_conversation(files);
    if (!conversation) {
      EXPECT_FALSE(conversation.error().message.empty()) << seed;
      continue;
    }
    const auto result = conform::conform(
        {*conversation, std::numeric_limits<std::int64_t>::max(), *profile, {}, {}, {}});
    if (!result) {
      EXPECT_FALSE(result.error().message.empty()) << seed;
      continue;
    }
    verdicts.insert(result->verdict);
    EXPECT_LE(result->explained, result->checked) << seed;
  }
  EXPECT_GE(verdicts.size(), 2U) << "some mistakes matter, some do not";
}
TEST(CaptureMutator, ConformDecidesWhateverANumberClaims) {
  expect_decisions("fastdds291_ap_np1_ne2_r0", "fastdds-2.9.1");
}
TEST(CaptureMutator, ConformDecidesWithAServerWhateverANumberClaims) {
  expect_decisions("discovery-server/fastdds291_ap150_client_np1_ne2_r0", "fastdds-server-2.6.11");
}

}  // namespace capture_mutator_test
}  // namespace stormproof::fuzzing
