// What captures say about changed knobs: the table in specs/captures/changes.md is that of the
// program, and every change of a knob is rejected by some shipped capture. (All of it in one go:
// `stormproof conform specs/captures/fastdds*.pcap.xz --changes`.)
#include "checker/evidence/conform/changes.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "model/config/tree/file_text.hpp"
#include "tests/checker/evidence/conform/captures.hpp"

namespace stormproof::conform::testing {
namespace changes_test {

namespace fs = std::filesystem;

/// The cells of the rows of changes.md, by their first one.
std::map<std::string, std::vector<std::string>> table() {
  std::string text = *model::config::file_text(STORMPROOF_CAPTURES_DIR "/changes.md", 1U << 20U);
  std::erase(text, '\\');
  std::erase(text, '`');
  std::map<std::string, std::vector<std::string>> rows;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    at = end + 1;
    if (!line.starts_with("| ")) continue;
    std::vector<std::string> cells;
    for (std::size_t from = 2; from < line.size();) {
      const std::size_t to = std::min(line.find(" |", from), line.size());
      cells.push_back(line.substr(from, to - from));
      from = to + 3;
    }
    rows[cells.front()] = cells;
  }
  return rows;
}

Sensitivity tried(const std::string& capture) {
  const std::string file = STORMPROOF_CAPTURES_DIR "/" + capture + ".pcap.xz";
  const std::string dds = *profile_of_capture(file);
  return *try_changes({shipped(capture), capture, dds, profile(dds), Bounds{}, {}, {}});
}

std::string changes_with(const Sensitivity& capture, Notice notice) {
  std::vector<std::string> names;
  for (const Tried& one : capture.tried) {
    if (one.notice == notice) names.push_back(one.change);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

class SmallCapture : public ::testing::TestWithParam<const char*> {};
TEST_P(SmallCapture, RejectsWhatTheTableSays) {
  const Sensitivity capture = tried(GetParam());
  const auto rows = table();
  ASSERT_TRUE(rows.contains(GetParam()));
  const std::vector<std::string>& row = rows.at(GetParam());
  EXPECT_EQ(name_of(capture.verdict), row.at(2));
  EXPECT_EQ(changes_with(capture, Notice::rejected), row.at(3));
  EXPECT_EQ(changes_with(capture, Notice::explained), row.at(4));
}
INSTANTIATE_TEST_SUITE_P(Shipped, SmallCapture,
                         ::testing::Values("fastdds2611_ap150_np1_ne2_r0",
                                           "fastdds2611_ap150_np2_ne20_r0",
                                           "fastdds2611_ap150_np2_ne30_r0",
                                           "fastdds291_ap_np3_ne10_r0",
                                           "fastdds291_veth_np1_ne2_r0"));

TEST(Changes, EveryOneIsRejectedByAShippedCapture) {
  const auto rows = table();
  for (const char* name : {"fastdds-2.6.11", "fastdds-2.9.1"}) {
    for (const Change& change : changes_of(profile(name))) {
      ASSERT_TRUE(rows.contains(change.name)) << change.name;
      EXPECT_NE(rows.at(change.name).at(1), "0") << change.name;
    }
  }
  for (const NoKnob& one : changes_without_knob()) {
    EXPECT_TRUE(rows.contains(std::string{one.change})) << one.change;
  }
}

TEST(Changes, EveryShippedCaptureOfFastDdsHasItsProfileAndItsRow) {
  const auto rows = table();
  for (const auto& entry : fs::directory_iterator{STORMPROOF_CAPTURES_DIR}) {
    const std::string name = entry.path().stem().stem().string();
    if (entry.path().extension() != ".xz" || !name.starts_with("fastdds")) continue;
    EXPECT_TRUE(profile_of_capture(entry.path().string())) << name;
    EXPECT_TRUE(rows.contains(name)) << name;
  }
}

TEST(Changes, OfAnUnknownCaptureTheProfileIsAskedFor) {
  const auto unknown = profile_of_capture(STORMPROOF_CAPTURES_DIR "/another.pcap");
  ASSERT_FALSE(unknown);
  EXPECT_NE(to_string(unknown.error()).find("another: PROFILE"), std::string::npos);
  EXPECT_FALSE(profile_of_capture("/nowhere/a.pcap"));
}

TEST(Changes, DifferFromTheirProfileInOneKnob) {
  const model::DdsProfile dds = profile("fastdds-2.6.11");
  const std::vector<Change> all = changes_of(dds);
  EXPECT_GE(all.size(), 14U);
  for (const Change& change : all) {
    EXPECT_NE(change.dds, dds) << change.name;
    EXPECT_FALSE(change.rules.empty()) << change.name;
    EXPECT_FALSE(refuse_profile(change.dds)) << change.name;
  }
}

}  // namespace changes_test
}  // namespace stormproof::conform::testing
