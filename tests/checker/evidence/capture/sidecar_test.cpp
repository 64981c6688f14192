// Every shipped capture of real discovery gives exactly the figures of its sidecar, which somebody
// else counted; and a capture that lacks something does not.
#include "tests/checker/evidence/capture/sidecar.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "checker/evidence/capture/decompress.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture {

namespace sidecar_test {

namespace fs = std::filesystem;
using testing::Buffer;

/// The shipped captures, or others with their sidecars.
fs::path captures_folder() {
  const char* other = std::getenv("STORMPROOF_CAPTURES");
  return other == nullptr ? STORMPROOF_CAPTURES_DIR : other;
}

const fs::path folder = captures_folder();

/// Those of Fast DDS 3 have a folder of their own.
std::vector<std::string> all_names() {
  std::vector<std::string> found;
  for (const fs::path where : {"", "fastdds-3"}) {
    if (!fs::exists(folder / where)) continue;
    for (const auto& entry : fs::directory_iterator{folder / where}) {
      if (entry.path().extension() == ".json") {
        found.push_back((where / entry.path().stem()).string());
      }
    }
  }
  return found;
}

std::string capture_of(const std::string& name) { return folder / (name + ".pcap.xz"); }

Sidecar sidecar_of(const std::string& name) { return read_sidecar(folder / (name + ".json")); }

/// Those in which everybody found everybody, without a server.
std::vector<std::string> names() {
  std::vector<std::string> found = all_names();
  std::erase_if(found, [](const std::string& name) {
    const Sidecar sidecar = sidecar_of(name);
    return !sidecar.completed || sidecar.discovery != "simple";
  });
  return found;
}

Conversation read(const std::string& name) {
  const std::vector<std::string> files{capture_of(name)};
  auto conversation = read_conversation(files);
  if (!conversation) {
    ADD_FAILURE() << to_string(conversation.error());
    return {};
  }
  return std::move(*conversation);
}

std::string test_name(const ::testing::TestParamInfo<std::string>& name) {
  std::string text = name.param;
  std::ranges::replace_if(
      text, [](char c) { return c == '/' || c == '-'; }, '_');
  return text;
}

class Figures : public ::testing::TestWithParam<std::string> {};
class Captures : public ::testing::TestWithParam<std::string> {};

TEST_P(Figures, OfTheirSidecarsAreGiven) {
  const Sidecar sidecar = sidecar_of(GetParam());
  const Counting counting = count(read(GetParam()), sidecar.cutoff_ns);
  const auto figures = figures_of(counting, sidecar.counts_same_host);
  EXPECT_GE(sidecar.figures.size(), 6U);
  for (const auto& [name, value] : sidecar.figures) {
    ASSERT_TRUE(figures.contains(name)) << name;
    EXPECT_EQ(figures.at(name), value) << name;
  }
}

/// What asks for types goes on until endpoints that nobody uses are known.
TEST_P(Figures, OfLookupsAreGiven) {
  const Sidecar sidecar = sidecar_of(GetParam());
  if (sidecar.lookups.empty()) return;  // the run did not count them
  EXPECT_EQ(lookups_of(count(read(GetParam()), sidecar.matched_ns)), sidecar.lookups);
}

TEST_P(Captures, HaveTheTopologyOfTheirSidecars) {
  const Sidecar sidecar = sidecar_of(GetParam());
  const Conversation conversation = read(GetParam());
  const Topology& topology = conversation.topology;
  EXPECT_EQ(topology.hosts, sidecar.hosts);
  ASSERT_EQ(topology.participants.size(), sidecar.hosts * sidecar.participants_per_host);
  for (std::size_t k = 0; k < topology.participants.size(); ++k) {
    const Participant& one = topology.participants[k];
    EXPECT_EQ(one.host, k / sidecar.participants_per_host);
    // 17 endpoints of every ROS 2 node, and those of the experiment.
    EXPECT_EQ(
        one.announced(entity::publications_writer) + one.announced(entity::subscriptions_writer),
        17 + sidecar.endpoints_per_participant);
    EXPECT_FALSE(one.locators.empty());
  }
  EXPECT_TRUE(conversation.remarks.empty());
}

TEST_P(Captures, HaveEveryRequiredKey) {
  const Sidecar sidecar = sidecar_of(GetParam());
  const Counting counting = count(read(GetParam()), sidecar.cutoff_ns);
  const std::size_t each = sidecar.participants_per_host;
  // Ordered pairs on two hosts, times endpoints.
  EXPECT_EQ(counting.required, 2 * each * each * (17 + sidecar.endpoints_per_participant));
  EXPECT_TRUE(counting.missing.empty());
  ASSERT_TRUE(counting.last_initial_ns.has_value());
  EXPECT_LE(*counting.last_initial_ns, sidecar.cutoff_ns);
}

TEST_P(Captures, LackKeysOneNanosecondBeforeTheLastOneIsSent) {
  const Conversation conversation = read(GetParam());
  const Counting whole = count(conversation, sidecar_of(GetParam()).cutoff_ns);
  const Counting cut = count(conversation, *whole.last_initial_ns - 1);
  EXPECT_LT(cut.required - cut.missing.size(), whole.required);
  EXPECT_LT(cut.counts.total(), whole.counts.total());
  // With one receiver, what it lacks may be something that nobody knows of.
  if (conversation.topology.participants.size() > 2) {
    EXPECT_FALSE(cut.missing.empty());
    EXPECT_FALSE(cut.last_initial_ns.has_value());
  }
}

INSTANTIATE_TEST_SUITE_P(Capture, Figures, ::testing::ValuesIn(all_names()), test_name);
INSTANTIATE_TEST_SUITE_P(Capture, Captures, ::testing::ValuesIn(names()), test_name);

TEST(Sidecars, ThereAreThoseOfThreeImplementations) { EXPECT_GE(names().size(), 18U); }

TEST(Sidecars, LookupsAreCountedInThreeOfThem) {
  const auto all = all_names();
  EXPECT_GE(std::ranges::count_if(
                all, [](const std::string& name) { return !sidecar_of(name).lookups.empty(); }),
            3);
}

TEST(Sidecars, NoticeACaptureWithoutItsLastPacket) {
  const std::string name = "fastdds291_veth_np1_ne2_r0";
  std::ifstream in{capture_of(name), std::ios::binary};
  const Buffer packed{std::istreambuf_iterator<char>{in}, {}};
  auto plain = unpack(packed, Compression::xz, 1U << 20U);
  ASSERT_TRUE(plain);
  plain->bytes.pop_back();
  const Conversation conversation = testing::conversation_of({plain->bytes});
  ASSERT_EQ(conversation.remarks.size(), 1U);
  EXPECT_NE(conversation.remarks[0].first.find("after packet 28"), std::string::npos)
      << conversation.remarks[0].first;
  const Sidecar sidecar = sidecar_of(name);
  const Counting counting = count(conversation, sidecar.cutoff_ns);
  EXPECT_EQ(counting.counts.initial_data + 1, sidecar.figures.at("counts.initial"));
  EXPECT_EQ(counting.required - counting.missing.size() + 1, 2U * (17 + 2));
}

TEST(Sidecars, DataToTheOwnHostIsToldApart) {
  const std::string name = "fastdds2611like_pre_ap_np3_ne20_r0";
  const Counting counting = count(read(name), sidecar_of(name).cutoff_ns);
  EXPECT_EQ(counting.same_host.initial_data, 1U);
  EXPECT_EQ(counting.same_host.repair_data, 1U);
  EXPECT_EQ(counting.counts.initial_data, counting.required);
}

TEST(Sidecars, ACaptureTogetherWithItselfCountsOnce) {
  const std::string name = "fastdds291_veth_np2_ne20_r0";
  const std::vector<std::string> twice{capture_of(name), capture_of(name)};
  const auto both = read_conversation(twice);
  ASSERT_TRUE(both);
  EXPECT_EQ(both->captures[1].merged, both->captures[1].datagrams);
  const std::int64_t cutoff_ns = sidecar_of(name).cutoff_ns;
  EXPECT_EQ(count(*both, cutoff_ns).counts, count(read(name), cutoff_ns).counts);
}

}  // namespace sidecar_test
}  // namespace stormproof::capture
