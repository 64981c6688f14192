// Comments on packets: as many as the doctor counts, on packets that stay as they are, and where
// the filters of the shipped Wireshark profile find them.
#include "checker/evidence/doctor/annotations.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <regex>
#include <string>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "checker/evidence/capture/capture_file.hpp"
#include "checker/evidence/capture/write/byte_writer.hpp"
#include "checker/evidence/capture/write/pcapng_writer.hpp"
#include "checker/evidence/doctor/repairs.hpp"
#include "tests/checker/evidence/capture/dissection.hpp"
#include "tests/checker/evidence/conform/captures.hpp"
#include "tests/files.hpp"

namespace stormproof::doctor {
namespace annotations_test {

using capture::CaptureFile;
using capture::write::Buffer;

constexpr const char* storm = "fastdds2611_ap150_np4_ne30_r1";
constexpr const char* lossy = "fastdds2611_ap150_loss5_np3_ne20_r0";

struct Annotated {
  capture::Conversation conversation;
  capture::Counting counting;
  Annotations comments;
};

Annotated annotated(const std::string& name) {
  Annotated result{conform::testing::shipped(name), {}, {}};
  result.counting = capture::count(result.conversation, std::numeric_limits<std::int64_t>::max());
  result.comments = annotations(result.conversation, result.counting);
  return result;
}

/// How many messages the comments put down to this cause.
std::uint64_t said(const Annotations& comments, const std::string& cause) {
  const std::regex remark{"(?:stormproof: |; )" + cause + ",[^;(]*(?:\\((\\d+) times\\))?"};
  std::uint64_t sum = 0;
  for (const auto& [packet, comment] : comments) {
    for (std::sregex_iterator one{comment.begin(), comment.end(), remark}, end; one != end; ++one) {
      sum += (*one)[1].matched ? std::stoull((*one)[1]) : 1;
    }
  }
  return sum;
}

TEST(Annotations, AreAsManyAsTheDoctorCounts) {
  for (const char* name : {storm, lossy}) {
    const Annotated all = annotated(name);
    const Repairs repairs = find_repairs(all.conversation, all.counting, all.counting.until_ns);
    ASSERT_GT(repairs.needless() + repairs.needed(), 0U);
    EXPECT_EQ(said(all.comments, "needless_repairs"), repairs.needless()) << name;
    EXPECT_EQ(said(all.comments, "loss"), repairs.lost) << name;
    EXPECT_EQ(said(all.comments, "forgotten"), repairs.forgotten) << name;
    EXPECT_EQ(repairs.kinds.size(), all.counting.counts.repair_data) << name;
    const auto of = [&](capture::HeartbeatKind kind) { return all.counting.heartbeats.of(kind); };
    EXPECT_EQ(said(all.comments, "piggyback"), of(capture::HeartbeatKind::fan_out_piggyback) +
                                                   of(capture::HeartbeatKind::directed_piggyback))
        << name;
  }
  EXPECT_GT(said(annotated(storm).comments, "needless_repairs"), 1000U);
  EXPECT_GT(said(annotated(lossy).comments, "loss"), 0U);
}

/// The capture with its comments, as a file would hold it.
Buffer pcapng(const std::string& name, const Annotations& comments) {
  auto file = CaptureFile::open(fmt::format("{}/captures/{}.pcap.xz", STORMPROOF_SPECS_DIR, name));
  EXPECT_TRUE(file);
  Buffer written;
  capture::write::PcapngWriter writer{[&written](capture::Bytes bytes) {
                                        written.insert(written.end(), bytes.begin(), bytes.end());
                                      },
                                      file->link_type()};
  while (const auto packet = file->next()) {
    const auto comment = comments.find(packet->number);
    writer.packet(*packet, comment == comments.end() ? std::string{} : comment->second);
  }
  return written;
}

TEST(Annotations, LeaveThePacketsAsTheyAre) {
  const Buffer written = pcapng(storm, annotated(storm).comments);
  auto before =
      CaptureFile::open(fmt::format("{}/captures/{}.pcap.xz", STORMPROOF_SPECS_DIR, storm));
  auto after = CaptureFile::from_memory("annotated", written, written.size());
  ASSERT_TRUE(before && after);
  EXPECT_EQ(before->link_type(), after->link_type());
  std::uint64_t packets = 0;
  while (const auto one = before->next()) {
    const auto other = after->next();
    ASSERT_TRUE(other);
    ++packets;
    EXPECT_EQ(one->time_ns, other->time_ns);
    EXPECT_EQ(one->original_length, other->original_length);
    ASSERT_TRUE(std::ranges::equal(one->bytes, other->bytes)) << packets;
  }
  EXPECT_FALSE(after->next());
  EXPECT_EQ(after->damage(), "");
  EXPECT_GT(packets, 1000U);
}

/// Packets that a filter shows, with the shipped profile.
std::uint64_t shown(const std::filesystem::path& folder, const std::string& filter) {
  const std::string count = files::output_of(fmt::format(
      "HOME='{0}' XDG_CONFIG_HOME='{0}/.config' tshark -C stormproof -r '{0}/a.pcapng' -Y "
      "'{1}' 2>'{0}/said' | wc -l",
      folder.string(), filter));
  EXPECT_EQ(files::content(folder / "said").find("tshark:"), std::string::npos)
      << filter << "\n"
      << files::content(folder / "said");
  return std::stoull(count);
}

TEST(Annotations, AreWhatTheFiltersOfTheProfileShow) {
  if (!capture::testing::tshark_is_available()) GTEST_SKIP() << "tshark is not installed";
  const files::Folder own;
  const std::filesystem::path profiles = own.path() / ".config/wireshark/profiles";
  std::filesystem::create_directories(profiles);
  std::filesystem::copy(STORMPROOF_SPECS_DIR "/wireshark/stormproof", profiles / "stormproof");
  const Annotations comments = annotated(lossy).comments;
  const Buffer written = pcapng(lossy, comments);
  std::ofstream{own.path() / "a.pcapng", std::ios::binary}.write(
      reinterpret_cast<const char*>(written.data()), static_cast<std::streamsize>(written.size()));
  EXPECT_EQ(shown(own.path(), "frame.comment"), comments.size());
  const auto with = [&](const std::string& cause) {
    return static_cast<std::uint64_t>(std::ranges::count_if(comments, [&](const auto& one) {
      return one.second.find(" " + cause + ",") != std::string::npos;
    }));
  };
  std::ifstream rules{profiles / "stormproof/colorfilters"};
  std::size_t read = 0;
  for (std::string line; std::getline(rules, line);) {
    if (line.starts_with("#")) continue;
    const std::size_t begin = line.find('@', 1) + 1;
    const std::string filter = line.substr(begin, line.find('@', begin) - begin);
    const std::uint64_t packets = shown(own.path(), filter);
    ++read;
    for (const char* cause : {"needless_repairs", "loss", "forgotten"}) {
      if (filter.find(cause) == std::string::npos) continue;
      EXPECT_EQ(packets, with(cause)) << filter;
    }
    if (filter.find("0x000003c2") != std::string::npos) {
      EXPECT_GT(packets, 0U) << filter;
    }
  }
  EXPECT_EQ(read, 9U);
}

}  // namespace annotations_test
}  // namespace stormproof::doctor
