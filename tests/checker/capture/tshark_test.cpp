// Agreement with tshark, an independent dissector: for every datagram of the shipped captures the
// same submessages, and from them the same counts.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "checker/capture/capture_file.hpp"
#include "checker/capture/counting.hpp"
#include "checker/capture/decompress.hpp"

namespace stormproof::capture {

namespace {

namespace fs = std::filesystem;

/// One submessage as text, in words that both sides can say.
using Words = std::vector<std::string>;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in{text};
  for (std::string one; std::getline(in, one, separator);) parts.push_back(one);
  return parts;
}

/// The values of one field of a datagram, taken one after the other.
class Values {
 public:
  explicit Values(const std::string& field) : values_{split(field, ',')} {}
  std::string next() { return at_ < values_.size() ? values_[at_++] : "?"; }
  [[nodiscard]] bool used_up() const { return at_ == values_.size(); }

 private:
  std::vector<std::string> values_;
  std::size_t at_ = 0;
};

/// What tshark says about one datagram.
struct Dissected {
  std::string source{};
  std::string end{};  ///< destination address and port
  bool is_multicast = false;
  struct Submessage {
    std::string destination{};  ///< of INFO_DST; empty: none
    Words words{};
  };
  std::vector<Submessage> submessages{};
};

constexpr std::array fields{"frame.number",         "ip.dst",
                            "udp.dstport",          "rtps.guidPrefix.src",
                            "rtps.guidPrefix.dst",  "rtps.sm.id",
                            "rtps.sm.wrEntityId",   "rtps.sm.seqNumber",
                            "rtps.bitmap.num_bits", "rtps.heartbeat_count",
                            "rtps.acknack.count"};

Dissected dissect(const std::vector<std::string>& line) {
  Dissected result;
  result.end = line[1] + ":" + line[2];
  result.is_multicast = line[1].starts_with("239.");
  result.source = line[3];
  Values destinations{line[4]};
  Values ids{line[5]};
  Values writers{line[6]};
  Values numbers{line[7]};
  Values bits{line[8]};
  Values heartbeats{line[9]};
  Values acknacks{line[10]};
  std::string destination;
  while (!ids.used_up()) {
    const std::string id = ids.next();
    if (id == "0x0e") destination = destinations.next();
    if (id == "0x15") {
      const std::string writer = writers.next();
      result.submessages.push_back({destination, {"DATA", writer, numbers.next()}});
    } else if (id == "0x07") {
      const std::string writer = writers.next();
      const std::string first = numbers.next();
      result.submessages.push_back(
          {destination, {"HEARTBEAT", writer, first, numbers.next(), heartbeats.next()}});
    } else if (id == "0x06") {
      const std::string writer = writers.next();
      const std::string base = numbers.next();
      result.submessages.push_back(
          {destination, {"ACKNACK", writer, base, bits.next(), acknacks.next()}});
    }
  }
  EXPECT_TRUE(destinations.used_up() && writers.used_up() && numbers.used_up());
  return result;
}

/// By frame number. tshark does not read .xz, so it gets an unpacked copy.
std::map<std::uint64_t, Dissected> dissect_capture(const fs::path& capture) {
  std::ifstream in{capture, std::ios::binary};
  const std::vector<std::uint8_t> packed{std::istreambuf_iterator<char>{in}, {}};
  const auto plain = unpack(packed, compression_of(packed), unpack_limit);
  EXPECT_TRUE(plain);
  const fs::path copy =
      fs::temp_directory_path() / (capture.stem().string() + "." + std::to_string(getpid()));
  std::ofstream{copy, std::ios::binary}.write(reinterpret_cast<const char*>(plain->bytes.data()),
                                              static_cast<std::streamsize>(plain->bytes.size()));
  std::string command = "tshark -n -r '" + copy.string() + "' -Y rtps -T fields";
  for (const char* field : fields) command += std::string{" -e "} + field;
  std::map<std::uint64_t, Dissected> result;
  std::FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  std::string output;
  std::array<char, 1U << 16U> room{};
  while (const std::size_t read = std::fread(room.data(), 1, room.size(), pipe)) {
    output.append(room.data(), read);
  }
  EXPECT_EQ(pclose(pipe), 0);
  fs::remove(copy);
  for (const std::string& text : split(output, '\n')) {
    auto line = split(text, '\t');
    line.resize(fields.size());
    result[std::stoull(line[0])] = dissect(line);
  }
  return result;
}

std::string hex(const GuidPrefix& prefix) {
  std::string text = to_string(prefix);
  std::erase(text, '.');
  return text;
}

std::string hex(EntityId entity) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "0x%08x", entity);
  return text.data();
}

/// An event in the words of `dissect`; empty for those that are not compared.
Words words_of(const Event& event) {
  const std::string writer = hex(event.writer);
  if (const DataEvent* data = event.data(); data != nullptr && data->fragment == 0) {
    return {"DATA", writer, std::to_string(data->sequence_number)};
  }
  if (const HeartbeatEvent* heartbeat = event.heartbeat()) {
    return {"HEARTBEAT", writer, std::to_string(heartbeat->first), std::to_string(heartbeat->last),
            std::to_string(heartbeat->count)};
  }
  if (const AcknackEvent* acknack = event.acknack()) {
    return {"ACKNACK", writer, std::to_string(acknack->missing.base),
            std::to_string(acknack->missing.num_bits), std::to_string(acknack->count)};
  }
  return {};
}

/// The paper's counts from tshark's dissection. Whose address it is, is learnt from datagrams with
/// INFO_DST instead of SPDP.
model::Counts counts_of(const std::map<std::uint64_t, Dissected>& datagrams) {
  std::map<std::string, std::string> owner;
  for (const auto& [frame, one] : datagrams) {
    for (const auto& submessage : one.submessages) {
      if (!submessage.destination.empty()) owner[one.end] = submessage.destination;
    }
  }
  model::Counts counts;
  std::set<std::tuple<std::string, std::string, std::string, std::string>> keys;
  for (const auto& [frame, one] : datagrams) {
    for (const auto& [info_dst, words] : one.submessages) {
      const bool is_sedp = words[1] == "0x000003c2" || words[1] == "0x000004c2";
      if (words[0] == "DATA" && words[1] == "0x000100c2") {
        ++(one.is_multicast ? counts.spdp_multicast : counts.spdp_unicast);
      } else if (words[0] == "DATA" && is_sedp) {
        const std::string to = !info_dst.empty()  ? info_dst
                               : one.is_multicast ? "all"
                                                  : owner[one.end];
        const bool is_new = keys.insert({one.source, to, words[1], words[2]}).second;
        ++(is_new ? counts.initial_data : counts.repair_data);
      } else if (is_sedp) {
        ++(words[0] == "HEARTBEAT" ? counts.heartbeat : counts.acknack);
      }
    }
  }
  return counts;
}

class Tshark : public ::testing::TestWithParam<const char*> {};

bool tshark_is_available() { return std::system("command -v tshark >/dev/null 2>&1") == 0; }

TEST_P(Tshark, SeesTheSameSubmessagesAndTheSameCounts) {
  if (!tshark_is_available()) GTEST_SKIP() << "tshark is not installed";
  const fs::path capture =
      fs::path{STORMPROOF_CAPTURES_DIR} / (std::string{GetParam()} + ".pcap.xz");
  const auto dissected = dissect_capture(capture);
  const std::vector<std::string> files{capture};
  const auto conversation = read_conversation(files);
  ASSERT_TRUE(conversation);
  ASSERT_EQ(conversation->datagrams.size(), dissected.size());
  std::map<std::uint64_t, std::vector<Words>> ours;
  for (const Event& event : conversation->events) {
    const std::uint64_t frame = conversation->datagrams[event.datagram].packet;
    if (Words words = words_of(event); !words.empty()) ours[frame].push_back(std::move(words));
    if (!event.has_info_dst) continue;
    ASSERT_TRUE(dissected.contains(frame));
    EXPECT_EQ(dissected.at(frame).source, hex(event.source));
    EXPECT_EQ(dissected.at(frame).submessages[ours[frame].size() - 1].destination,
              hex(*event.destination));
  }
  std::uint64_t different = 0;
  for (const auto& [frame, one] : dissected) {
    std::vector<Words> theirs;
    for (const auto& submessage : one.submessages) theirs.push_back(submessage.words);
    if (theirs != ours[frame]) ++different;
  }
  EXPECT_EQ(different, 0U);
  const Counting counting = count(*conversation, std::numeric_limits<std::int64_t>::max());
  EXPECT_GT(counting.counts.total(), 0U);
  EXPECT_EQ(counting.counts, counts_of(dissected));
}

INSTANTIATE_TEST_SUITE_P(Capture, Tshark,
                         ::testing::Values("cyclone0102_veth_np2_ne20_r0",
                                           "cyclone0102uni_veth_np2_ne20_r0",
                                           "fastdds2611_ap150_np3_ne30_r0",
                                           "fastdds2611_veth_np3_ne10_r0",
                                           "fastdds291_veth_np2_ne20_r0"),
                         [](const auto& name) { return std::string{name.param}; });

}  // namespace
}  // namespace stormproof::capture
