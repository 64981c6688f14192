// One run of tshark, whose fields are lists of values: each submessage takes as many as its kind
// has.
#include "tests/checker/evidence/capture/dissection.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace stormproof::capture::testing {

namespace {

namespace fs = std::filesystem;

constexpr std::array fields{"frame.number",
                            "frame.len",
                            "ip.fragment",
                            "ip.src",
                            "ip.dst",
                            "udp.dstport",
                            "udp.length",
                            "rtps.guidPrefix.src",
                            "rtps.guidPrefix.dst",
                            "rtps.sm.id",
                            "rtps.sm.flags",
                            "rtps.sm.octetsToNextHeader",
                            "rtps.sm.rdEntityId",
                            "rtps.sm.wrEntityId",
                            "rtps.sm.seqNumber",
                            "rtps.bitmap.num_bits",
                            "rtps.bitmap",
                            "rtps.heartbeat_count",
                            "rtps.acknack.count"};

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
  std::string next() { return at_ < values_.size() ? values_[at_++] : "0"; }
  std::int64_t number() { return static_cast<std::int64_t>(std::stoll(next(), nullptr, 0)); }
  std::uint32_t small() { return static_cast<std::uint32_t>(number()); }
  [[nodiscard]] bool used_up() const { return at_ == values_.size(); }

 private:
  std::vector<std::string> values_;
  std::size_t at_ = 0;
};

/// The first `count` digits of a bitmap, of which tshark shows the bytes as they are in the
/// message.
std::string digits(const std::string& hex, std::uint32_t count, bool little_endian) {
  std::string bytes;
  for (std::size_t k = 0; k + 8 <= hex.size(); k += 8) {
    for (std::size_t byte = 0; byte < 8; byte += 2) {
      bytes += hex.substr(k + (little_endian ? 6 - byte : byte), 2);
    }
  }
  std::string result;
  for (std::uint32_t k = 0; k < count && k / 4 < bytes.size(); ++k) {
    const int digit = std::stoi(bytes.substr(k / 4, 1), nullptr, 16);
    result += (digit >> (3 - k % 4) & 1) != 0 ? '1' : '0';
  }
  return result;
}

/// Takes the submessages of a datagram out of their fields.
void add_submessages(const std::vector<std::string>& line, DissectedDatagram& datagram) {
  Values sources{line[7]};
  Values destinations{line[8]};
  Values ids{line[9]};
  Values flags{line[10]};
  Values sizes{line[11]};
  Values readers{line[12]};
  Values writers{line[13]};
  Values numbers{line[14]};
  Values num_bits{line[15]};
  Values bits{line[16]};
  Values heartbeats{line[17]};
  Values acknacks{line[18]};
  DissectedSubmessage common;
  common.source = sources.next();
  std::uint32_t before = 20;  // bytes, without submessages of vendors
  while (!ids.used_up()) {
    DissectedSubmessage one = common;
    one.id = ids.small();
    if (one.id >= 0x80) continue;  // of a vendor: tshark shows nothing of it
    one.flags = flags.small();
    const std::uint32_t length = sizes.small();
    one.bytes = length == 0 ? datagram.payload_bytes - before : length + 4;  // 0: until the end
    before += one.bytes;
    const bool is_bitmap = one.id == 0x06 || one.id == 0x08;
    if (one.id == 0x0c) common.source = sources.next();
    if (one.id == 0x0e) {
      common.destination = destinations.next();
      ++datagram.info_dst;
    }
    if (one.id != 0x15 && one.id != 0x16 && one.id != 0x07 && !is_bitmap) continue;
    one.reader = readers.next();
    one.writer = writers.next();
    one.numbers.push_back(numbers.number());
    if (one.id == 0x07 || one.id == 0x08) one.numbers.push_back(numbers.number());
    if (is_bitmap) one.num_bits = num_bits.small();
    if (one.num_bits > 0) one.bits = digits(bits.next(), one.num_bits, (one.flags & 1U) != 0);
    if (one.id == 0x06) one.count = acknacks.small();
    if (one.id == 0x07) one.count = heartbeats.small();
    datagram.submessages.push_back(std::move(one));
  }
  for (const Values& values : {sources, destinations, readers, writers, numbers, num_bits, bits,
                               heartbeats, acknacks, flags, sizes}) {
    EXPECT_TRUE(values.used_up()) << line[0];
  }
}

std::string run_tshark(const fs::path& capture) {
  // RTPS has no port of its own: look for it before what is usual on a port.
  std::string command =
      "tshark -n -o udp.try_heuristic_first:TRUE -r '" + capture.string() + "' -T fields";
  for (const char* field : fields) command += std::string{" -e "} + field;
  std::FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  std::string output;
  std::array<char, 1U << 16U> room{};
  while (const std::size_t read = std::fread(room.data(), 1, room.size(), pipe)) {
    output.append(room.data(), read);
  }
  EXPECT_EQ(pclose(pipe), 0);
  return output;
}

}  // namespace

bool tshark_is_available() { return std::system("command -v tshark >/dev/null 2>&1") == 0; }

Dissection dissect(Bytes capture) {
  const fs::path copy =
      fs::temp_directory_path() / ("stormproof-dissection-" + std::to_string(getpid()));
  std::ofstream{copy, std::ios::binary}.write(reinterpret_cast<const char*>(capture.data()),
                                              static_cast<std::streamsize>(capture.size()));
  const std::string output = run_tshark(copy);
  fs::remove(copy);
  Dissection result;
  std::map<std::string, std::uint64_t> lengths;  // of each frame
  for (const std::string& text : split(output, '\n')) {
    auto line = split(text, '\t');
    line.resize(fields.size());
    lengths[line[0]] = std::stoull(line[1]);
    if (line[9].empty()) continue;  // no submessage: another fragment
    DissectedDatagram& datagram = result[std::stoull(line[0])];
    datagram.from = line[3];
    datagram.to = line[4];
    datagram.port = line[5];
    datagram.payload_bytes = static_cast<std::uint32_t>(std::stoul(line[6])) - 8;
    const auto frames = line[2].empty() ? std::vector{line[0]} : split(line[2], ',');
    datagram.frames = static_cast<std::uint32_t>(frames.size());
    for (const std::string& frame : frames) datagram.wire_bytes += lengths[frame];
    add_submessages(line, datagram);
  }
  return result;
}

}  // namespace stormproof::capture::testing
