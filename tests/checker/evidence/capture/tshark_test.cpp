// Agreement with tshark, an independent dissector: for every datagram of every shipped capture, and
// of one with everything that those do not have, the same submessages; and from them, by another
// way of counting, the same counts.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "checker/evidence/capture/capture_file.hpp"
#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/decompress.hpp"
#include "tests/checker/evidence/capture/dissection.hpp"
#include "tests/checker/evidence/capture/figures.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture {

namespace tshark_test {

namespace fs = std::filesystem;
using namespace testing;

/// The folder with the captures: the shipped ones, or any others.
fs::path folder() {
  const char* other = std::getenv("STORMPROOF_CAPTURES");
  return other == nullptr ? STORMPROOF_CAPTURES_DIR : other;
}

std::vector<std::string> names() {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator{folder()}) {
    if (entry.path().extension() == ".xz") found.push_back(entry.path().stem().stem());
  }
  std::ranges::sort(found);
  return found;
}

Buffer plain_capture(const std::string& name) {
  std::ifstream in{folder() / (name + ".pcap.xz"), std::ios::binary};
  const Buffer packed{std::istreambuf_iterator<char>{in}, {}};
  auto plain = unpack(packed, compression_of(packed), unpack_limit);
  return plain ? std::move(plain->bytes) : Buffer{};
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

unsigned flags_of(const Event& event) {
  if (const HeartbeatEvent* one = event.heartbeat()) {
    return (one->is_final ? 2U : 0U) | (one->is_liveliness ? 4U : 0U);
  }
  const AcknackEvent* acknack = event.acknack();
  return acknack != nullptr && acknack->is_final ? 2U : 0U;
}

/// An event as tshark would put it. Of the flags, those that an event keeps.
DissectedSubmessage described(const Event& event) {
  DissectedSubmessage one;
  one.source = hex(event.source);
  if (event.has_info_dst) one.destination = hex(*event.destination);
  one.flags = flags_of(event);
  one.bytes = event.bytes;
  one.reader = hex(event.reader);
  one.writer = hex(event.writer);
  const auto add_set = [&one](const SequenceNumberSet& set) {
    one.num_bits = set.num_bits;
    for (std::uint32_t k = 0; k < set.num_bits; ++k) one.bits += set.has(k) ? '1' : '0';
  };
  if (const DataEvent* data = event.data()) {
    one.id = data->fragment == 0 ? 0x15 : 0x16;
    one.numbers = {data->sequence_number};
  } else if (const HeartbeatEvent* heartbeat = event.heartbeat()) {
    one.id = 0x07;
    one.numbers = {heartbeat->first, heartbeat->last};
    one.count = heartbeat->count;
  } else if (const AcknackEvent* acknack = event.acknack()) {
    one.id = 0x06;
    one.numbers = {acknack->missing.base};
    one.count = acknack->count;
    add_set(acknack->missing);
  } else {
    one.id = 0x08;
    one.numbers = {event.gap()->start, event.gap()->list.base};
    add_set(event.gap()->list);
  }
  return one;
}

DissectedSubmessage kept(DissectedSubmessage one) {
  if (one.id == 0x07) one.flags &= 6U;
  if (one.id == 0x06) one.flags &= 2U;
  if (one.id != 0x06 && one.id != 0x07) one.flags = 0;
  return one;
}

/// How many datagrams the conversation has otherwise than tshark.
std::size_t differences(const Conversation& conversation, const Dissection& dissection) {
  std::map<std::uint64_t, DissectedDatagram> ours;
  for (const DatagramRecord& record : conversation.datagrams) {
    DissectedDatagram& one = ours[record.packet];
    one.from = to_string(record.source.address);
    one.to = to_string(record.destination.address);
    one.port = std::to_string(record.destination.port);
    one.payload_bytes = record.payload_bytes;
    one.frames = record.frames;
    one.wire_bytes = record.wire_bytes;
    one.user_data = record.user.data;
  }
  for (const Event& event : conversation.events) {
    const std::uint64_t frame = conversation.datagrams[event.datagram].packet;
    ours[frame].submessages.push_back(described(event));
  }
  std::size_t different = 0;
  for (const auto& [frame, one] : dissection) {
    const DissectedDatagram mine = ours[frame];
    std::vector<DissectedSubmessage> submessages;
    std::uint32_t user_data = 0;
    for (const auto& submessage : one.submessages) {
      if (submessage.is_user_data()) {
        ++user_data;
      } else {
        submessages.push_back(kept(submessage));
      }
    }
    const auto rest = [](const DissectedDatagram& datagram) {
      return std::tie(datagram.from, datagram.to, datagram.port, datagram.payload_bytes,
                      datagram.frames, datagram.wire_bytes);
    };
    if (submessages == mine.submessages && user_data == mine.user_data && rest(one) == rest(mine)) {
      continue;
    }
    if (different++ == 0) std::printf("the first is frame %llu\n", 1ULL * frame);
  }
  return different + ours.size() - dissection.size();
}

class Tshark : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!tshark_is_available()) GTEST_SKIP() << "tshark is not installed";
  }
};

TEST_P(Tshark, SeesTheSameSubmessagesAndTheSameCounts) {
  const Buffer capture = plain_capture(GetParam());
  const Dissection dissection = dissect(capture);
  const Conversation conversation = conversation_of({capture});
  EXPECT_EQ(differences(conversation, dissection), 0U);
  const Figures figures = figures_of(dissection);
  EXPECT_GT(figures.at("initial DATA"), 0U);
  EXPECT_EQ(figures_of(conversation), figures);
}

INSTANTIATE_TEST_SUITE_P(Capture, Tshark, ::testing::ValuesIn(names()),
                         [](const auto& name) { return name.param; });

constexpr EntityId pub = entity::publications_writer;

/// A message with every kind of submessage.
Message varied(ByteOrder order) {
  constexpr EntityId user_writer = 0x00000103;
  const auto body = [order] { return Writer{order}; };
  const auto fragment = body().u16(0).u16(28).entity(0).entity(pub).sequence_number(9).u32(2);
  const auto gap = body().entity(pub + 5).entity(pub).sequence_number(3);
  const auto big = body().entity(pub + 5).entity(pub).sequence_number(7).u32(256);
  Writer bitmap = big;
  for (std::uint32_t word = 0; word < 8; ++word) bitmap.u32(0x80000001U << word);
  Message message{prefix(1), order};
  message.timestamp().announcement({at(1, 7410)}).to(prefix(2)).vendor_specific();
  message.descriptor(pub, 0x100000002).descriptor(pub, 3, true).descriptor(user_writer, 7);
  message.heartbeat(pub, 1, 0x300000004, 17, 0x02).heartbeat(pub, 5, 4, 18);
  message.heartbeat(entity::liveliness_writer, 1, 1, 3, 0x02 | 0x04);
  message.acknack(pub, 5, 33, 0xc0000001, true, 9).acknack(pub, 1, 0, 0, false);
  message.acknack(pub, 8, 0, 0, true).submessage(0x06, 2, Writer{bitmap}.u32(77).buffer());
  message.gap(pub, 3, 8).submessage(
      0x08, 0, Writer{gap}.sequence_number(4).u32(40).u32(0xf0f0f0f0).u32(0xff000000).buffer());
  message.submessage(0x16, 0,
                     Writer{fragment}.u16(1).u16(64).u32(500).bytes(Buffer(64, 0)).buffer());
  return message.from(prefix(3)).heartbeat(entity::subscriptions_writer, 1, 2, 1);
}

/// Such messages in both byte orders: whole, in fragments in a wrong order, and behind VLAN tags.
Buffer varied_capture() {
  PcapFile file;
  Route route{at(1, 7410), at(2, 7411), 7};
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
    const Message message = varied(order);
    file.message(0, route, message);
    ++route.id;  // with the same one it would be the same packet
    const Buffer tags = Writer{}.u16(1).u16(0x8100).u16(2).u16(0x8100).u16(3).u16(0x0800).buffer();
    Buffer tagged = tags;
    const Buffer ip = ipv4(route, message.buffer());
    tagged.insert(tagged.end(), ip.begin(), ip.end());
    file.frame(1, ethernet(tagged, 0x88a8));
    ++route.id;
    const Buffer datagram = udp(route, message.buffer());
    const std::size_t rest = datagram.size() - 640;
    file.frame(2, ethernet(ipv4_fragment(route, datagram, 320, 320, true)));
    file.frame(3, ethernet(ipv4_fragment(route, datagram, 640, rest, false)));
    file.frame(4, ethernet(ipv4_fragment(route, datagram, 0, 320, true)));
    ++route.id;
  }
  file.message(5, {at(2, 7410), multicast()}, Message{prefix(2)}.announcement({at(2, 7410)}));
  Buffer last = Message{prefix(2)}.to(prefix(1)).heartbeat(pub, 1, 1, 1).buffer();
  last[38] = 0;  // octetsToNextHeader: until the end
  file.frame(6, ethernet(ipv4(route, last)));
  return file.buffer();
}

class TsharkOnBuilt : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!tshark_is_available()) GTEST_SKIP() << "tshark is not installed";
  }
};

TEST_F(TsharkOnBuilt, SeesTheSameInBothByteOrdersFragmentsAndTags) {
  const Buffer capture = varied_capture();
  const Dissection dissection = dissect(capture);
  ASSERT_EQ(dissection.size(), 8U);
  const Conversation conversation = conversation_of({capture});
  EXPECT_EQ(differences(conversation, dissection), 0U);
  EXPECT_EQ(dissection.begin()->second.submessages.size(), 15U);
}

TEST_F(TsharkOnBuilt, DisagreesAboutAnAlteredSubmessage) {
  const Buffer capture = varied_capture();
  const Conversation conversation = conversation_of({capture});
  // The capture ends with a HEARTBEAT: behind its length, reader 4, writer 4, first 8, last 8,
  // count 4 bytes. Altered are INFO_DST, the flags and the first number.
  constexpr std::size_t body = 28;
  Buffer altered = capture;
  for (const std::size_t from_end : {body + 5, body + 3, body - 20}) {
    altered[altered.size() - from_end] ^= 2U;
    EXPECT_EQ(differences(conversation, dissect(altered)), 1U) << from_end;
    altered[altered.size() - from_end] ^= 2U;
  }
}

}  // namespace tshark_test
}  // namespace stormproof::capture
