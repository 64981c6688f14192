// A capture that is cut off or altered anywhere gives an error, a remark or other counts, and never
// a crash (which is why this also runs under sanitizers).
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>
#include <lzma.h>

#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/decompress.hpp"
#include "tests/checker/evidence/capture/gzip.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture {

namespace damage_test {

using testing::Buffer;
using testing::gzip;

constexpr std::int64_t always = std::numeric_limits<std::int64_t>::max();
constexpr std::size_t limit = 1U << 20U;

Buffer packed_capture() {
  const std::filesystem::path folder = STORMPROOF_CAPTURES_DIR;
  std::ifstream in{folder / "fastdds291_veth_np1_ne2_r0.pcap.xz", std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

Buffer plain_capture() {
  auto unpacked = unpack(packed_capture(), Compression::xz, limit);
  return unpacked ? unpacked->bytes : Buffer{};
}

/// Total of the counts; nothing if the capture is refused.
std::optional<std::uint64_t> total_of(Bytes content) {
  const std::vector<MemoryCapture> captures{{"damaged", content, limit}};
  const auto conversation = read_conversation(captures);
  if (!conversation) {
    EXPECT_FALSE(conversation.error().message.empty());
    return std::nullopt;
  }
  return count(*conversation, always).counts.total();
}

/// Whether reading it is refused, or leaves a remark.
bool error_or_remark(Bytes content) {
  const std::vector<MemoryCapture> captures{{"damaged", content, limit}};
  const auto conversation = read_conversation(captures);
  return !conversation || !conversation->remarks.empty();
}

/// Frames with a datagram in fragments and every kind of submessage, each with its time in µs.
std::vector<std::pair<std::int64_t, Buffer>> small_frames() {
  using namespace testing;
  constexpr EntityId pub = entity::publications_writer;
  const Route route{at(1, 7410), at(2, 7410), 3};
  std::vector<std::pair<std::int64_t, Buffer>> frames;
  for (const std::uint8_t host : {std::uint8_t{1}, std::uint8_t{2}}) {
    const Message announcement = Message{prefix(host)}.announcement({at(host, 7410)});
    frames.emplace_back(host, ethernet(ipv4({at(host, 7410), multicast()}, announcement.buffer())));
  }
  Message message{prefix(1)};
  message.to(prefix(2)).timestamp().descriptor(pub, 1).vendor_specific().descriptor(pub, 2);
  message.heartbeat(pub, 1, 2, 1).gap(pub, 3, 5).from(prefix(1));
  const Buffer datagram = udp(route, message.buffer());
  frames.emplace_back(5, ethernet(ipv4_fragment(route, datagram, 0, 160, true)));
  const std::size_t rest = datagram.size() - 160;
  frames.emplace_back(6, ethernet(ipv4_fragment(route, datagram, 160, rest, false)));
  const Message reply = Message{prefix(2), ByteOrder::big}.acknack(pub, 1, 40, 1U << 31U, false);
  frames.emplace_back(7, ethernet(ipv4({at(2, 7410), at(1, 7410)}, reply.buffer())));
  return frames;
}

Buffer small_capture(ByteOrder order = ByteOrder::little, bool in_nanoseconds = false) {
  testing::PcapFile file{1, order, in_nanoseconds};
  for (const auto& [time, frame] : small_frames()) file.frame(time, frame);
  return file.buffer();
}

Buffer small_pcapng(ByteOrder order) {
  testing::PcapngFile file{order};
  file.interface(1);
  for (const auto& [time, frame] : small_frames()) {
    file.packet(0, static_cast<std::uint64_t>(testing::time_of(time)) / 1000, frame);
  }
  return file.buffer();
}

Buffer xz(const Buffer& plain) {
  Buffer packed(plain.size() + 1024);
  std::size_t length = 0;
  EXPECT_EQ(lzma_easy_buffer_encode(6, LZMA_CHECK_CRC64, nullptr, plain.data(), plain.size(),
                                    packed.data(), &length, packed.size()),
            LZMA_OK);
  packed.resize(length);
  return packed;
}

/// The small capture in a format.
struct Format {
  const char* name;
  Buffer (*capture)();
};

/// Feeds the first 0, `step`, … bytes, and checks that a longer part has no fewer messages.
void cut_everywhere(const Buffer& whole, std::size_t step) {
  std::uint64_t last = 0;
  std::size_t refused = 0;
  for (std::size_t length = 0; length < whole.size(); length += step) {
    const auto total = total_of(Bytes{whole}.first(length));
    if (!total) ++refused;
    EXPECT_GE(total.value_or(0), last);
    last = total.value_or(0);
  }
  EXPECT_EQ(last + 1, total_of(whole));
  EXPECT_LT(refused, 700 / step) << "only what ends within the first packet";
}

class Formats : public ::testing::TestWithParam<Format> {};

TEST_P(Formats, CutOffAnywhereGiveAnErrorOrFewerMessages) {
  const Buffer whole = GetParam().capture();
  EXPECT_EQ(total_of(whole), 6U);
  cut_everywhere(whole, 1);
}

TEST_P(Formats, SurviveEveryAlteredByte) {
  Buffer bytes = GetParam().capture();
  std::size_t noticed = 0;
  for (std::uint8_t& byte : bytes) {
    const std::uint8_t original = byte;
    for (const int change : {0x01, 0x80, 0xff}) {
      byte = static_cast<std::uint8_t>(original ^ change);
      if (total_of(bytes) != 6U) ++noticed;
    }
    byte = original;
  }
  EXPECT_GT(noticed, 100U);
}

/// Alters, inserts, removes and repeats bytes, the same ones in every run.
TEST_P(Formats, SurviveRandomDamage) {
  const Buffer whole = GetParam().capture();
  std::mt19937 random{2022};
  const auto below = [&random](std::size_t end) { return random() % end; };
  std::size_t noticed = 0;
  for (int round = 0; round < 3'000; ++round) {
    Buffer bytes = whole;
    for (std::size_t changes = 1 + below(8); changes > 0; --changes) {
      const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size()));
      const std::size_t length =
          1 + below(std::min<std::size_t>(16, static_cast<std::size_t>(bytes.end() - at)));
      const Buffer some{at, at + static_cast<std::ptrdiff_t>(length)};
      switch (below(4)) {
        case 0:
          *at = static_cast<std::uint8_t>(random());
          break;
        case 1:
          std::fill_n(at, length, static_cast<std::uint8_t>(below(2) * 255));
          break;
        case 2:
          bytes.insert(at, some.begin(), some.end());
          break;
        default:
          if (bytes.size() > length) bytes.erase(at, at + static_cast<std::ptrdiff_t>(length));
      }
    }
    if (total_of(bytes) != 6U) ++noticed;
  }
  EXPECT_GT(noticed, 1'000U);
}

INSTANTIATE_TEST_SUITE_P(
    Damage, Formats,
    ::testing::Values(
        Format{"pcap", [] { return small_capture(); }},
        Format{"pcap_of_the_other_byte_order", [] { return small_capture(ByteOrder::big); }},
        Format{"pcap_in_nanoseconds", [] { return small_capture(ByteOrder::little, true); }},
        Format{"pcap_in_nanoseconds_of_the_other_byte_order",
               [] { return small_capture(ByteOrder::big, true); }},
        Format{"pcapng", [] { return small_pcapng(ByteOrder::little); }},
        Format{"pcapng_of_the_other_byte_order", [] { return small_pcapng(ByteOrder::big); }}),
    [](const auto& format) { return std::string{format.param.name}; });

TEST(Damage, ARealCaptureCutOffAnywhereGivesAnErrorOrFewerMessages) {
  const Buffer whole = plain_capture();
  ASSERT_GT(whole.size(), 20'000U);
  cut_everywhere(whole, 29);
}

/// Whether each part, and each altered copy, of something compressed gives an error or at most as
/// many messages.
void damage_compressed(const Buffer& whole) {
  ASSERT_EQ(total_of(whole), 6U);
  std::size_t noticed = 0;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_LE(total_of(Bytes{whole}.first(length)).value_or(0), 6U);
    Buffer altered = whole;
    altered[length] ^= 0x10U;
    if (error_or_remark(altered)) ++noticed;
  }
  EXPECT_GT(noticed, whole.size() * 3 / 4);
}

TEST(Damage, CompressedCapturesCutOffOrAlteredAnywhere) {
  damage_compressed(xz(small_capture()));
  damage_compressed(gzip(small_capture()));
  damage_compressed(xz(small_pcapng(ByteOrder::big)));
}

TEST(Damage, ARealCompressedCaptureCutOffAnywhere) {
  const Buffer whole = packed_capture();
  const auto complete = total_of(whole);
  ASSERT_TRUE(complete.has_value());
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    EXPECT_LE(total_of(Bytes{whole}.first(length)).value_or(0), *complete);
  }
}

}  // namespace damage_test
}  // namespace stormproof::capture
