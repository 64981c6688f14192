// A capture that is cut off or altered anywhere gives an error, a remark or other counts, and never
// a crash (which is why this also runs under sanitizers).
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "checker/capture/counting.hpp"
#include "checker/capture/decompress.hpp"
#include "tests/checker/capture/packets.hpp"

namespace stormproof::capture {

namespace {

using testing::Buffer;

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

/// A small capture with a datagram in fragments and every kind of submessage.
Buffer small_capture() {
  using namespace testing;
  constexpr EntityId pub = entity::publications_writer;
  const Route route{at(1, 7410), at(2, 7410), 3};
  PcapFile file;
  for (const std::uint8_t host : {std::uint8_t{1}, std::uint8_t{2}}) {
    file.message(host, {at(host, 7410), multicast()},
                 Message{prefix(host)}.announcement({at(host, 7410)}));
  }
  Message message{prefix(1)};
  message.to(prefix(2)).timestamp().descriptor(pub, 1).vendor_specific().descriptor(pub, 2);
  message.heartbeat(pub, 1, 2, 1).gap(pub, 3, 5).from(prefix(1));
  const Buffer datagram = udp(route, message.buffer());
  file.frame(5, ethernet(ipv4_fragment(route, datagram, 0, 160, true)));
  file.frame(6, ethernet(ipv4_fragment(route, datagram, 160, datagram.size() - 160, false)));
  Message reply{prefix(2), ByteOrder::big};
  file.message(7, {at(2, 7410), at(1, 7410)}, reply.acknack(pub, 1, 40, 0x80000000, false));
  return file.buffer();
}

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
  EXPECT_LT(refused, 600 / step) << "only what ends within the first packet";
}

TEST(Damage, ASmallCaptureCutOffAnywhereGivesAnErrorOrFewerMessages) {
  const Buffer whole = small_capture();
  EXPECT_EQ(total_of(whole), 6U);
  cut_everywhere(whole, 1);
}

TEST(Damage, ARealCaptureCutOffAnywhereGivesAnErrorOrFewerMessages) {
  const Buffer whole = plain_capture();
  ASSERT_GT(whole.size(), 20'000U);
  cut_everywhere(whole, 11);
}

TEST(Damage, ACompressedCaptureCutOffAnywhere) {
  const Buffer whole = packed_capture();
  const auto complete = total_of(whole);
  ASSERT_TRUE(complete.has_value());
  for (std::size_t length = 0; length < whole.size(); length += 3) {
    EXPECT_LE(total_of(Bytes{whole}.first(length)).value_or(0), *complete);
  }
}

TEST(Damage, AlteredBytesAreSurvived) {
  Buffer bytes = small_capture();
  const auto complete = total_of(bytes);
  std::size_t noticed = 0;
  for (std::uint8_t& byte : bytes) {
    const std::uint8_t original = byte;
    for (const int change : {0x01, 0x80, 0xff}) {
      byte = static_cast<std::uint8_t>(original ^ change);
      if (total_of(bytes) != complete) ++noticed;
    }
    byte = original;
  }
  EXPECT_GT(noticed, 100U);
}

}  // namespace
}  // namespace stormproof::capture
