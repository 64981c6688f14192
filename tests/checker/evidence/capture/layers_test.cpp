// The layers at the bottom: capture files, compression, links.
#include <algorithm>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "checker/evidence/capture/capture_file.hpp"
#include "checker/evidence/capture/decompress.hpp"
#include "checker/evidence/capture/link_layer.hpp"
#include "tests/checker/evidence/capture/gzip.hpp"
#include "tests/checker/evidence/capture/packets.hpp"
#include "tests/files.hpp"

namespace stormproof::capture {

namespace layers_test {

using namespace testing;

const Route route{at(1, 7410), at(2, 7411), 5};

Message greeting() { return Message{prefix(1)}.announcement({at(1, 7410)}); }

std::size_t datagrams_of(std::uint32_t link_type, const Buffer& frame) {
  PcapFile file{link_type};
  file.frame(0, ethernet(ipv4(route, greeting().buffer())));
  PcapFile wanted{link_type};
  wanted.frame(0, frame);
  const Buffer& content = wanted.buffer();
  const std::vector<MemoryCapture> captures{{"link", content, 1U << 20U}};
  const auto conversation = read_conversation(captures);
  return conversation ? conversation->datagrams.size() : 0;
}

TEST(LinkLayer, EveryLinkTypeLeadsToTheSameDatagram) {
  constexpr std::uint32_t ethernet_link = 1;
  constexpr std::uint32_t null_link = 0;
  constexpr std::uint32_t raw_link = 101;
  constexpr std::uint32_t loop_link = 108;
  constexpr std::uint32_t cooked = 113;
  constexpr std::uint32_t cooked_2 = 276;
  const Buffer ip = ipv4(route, greeting().buffer());
  const Buffer tagged = Writer{}.u16(7).u16(0x0800).bytes(ip).buffer();
  EXPECT_EQ(datagrams_of(ethernet_link, ethernet(ip)), 1U);
  EXPECT_EQ(datagrams_of(ethernet_link, ethernet(tagged, 0x8100)), 1U);
  EXPECT_EQ(datagrams_of(raw_link, ip), 1U);
  EXPECT_EQ(datagrams_of(null_link, Writer{}.u32(2).bytes(ip).buffer()), 1U);
  EXPECT_EQ(datagrams_of(loop_link, Writer{}.u32(2).bytes(ip).buffer()), 1U);
  const Buffer start = Writer{}.u32(4).u32(0).u32(0).u16(0).u16(0x0800).bytes(ip).buffer();
  EXPECT_EQ(datagrams_of(cooked, start), 1U);
  const Buffer start_2 =
      Writer{}.u16(0x0800).u16(0).u32(1).u16(1).u8(4).u8(6).u32(0).u32(0).bytes(ip).buffer();
  EXPECT_EQ(datagrams_of(cooked_2, start_2), 1U);
}

TEST(LinkLayer, AnyNumberOfVlanTags) {
  constexpr std::uint32_t ethernet_link = 1;
  constexpr std::uint32_t cooked_2 = 276;
  const Buffer ip = ipv4(route, greeting().buffer());
  for (std::size_t tags = 1; tags < 300; tags += 30) {
    Writer tagged;
    for (std::size_t k = 1; k < tags; ++k) tagged.u16(k).u16(k % 2 == 0 ? 0x9100 : 0x88a8);
    const Buffer payload = tagged.u16(7).u16(0x0800).bytes(ip).buffer();
    EXPECT_EQ(datagrams_of(ethernet_link, ethernet(payload, 0x8100)), 1U);
    const Writer cooked = Writer{}.u16(0x8100).u16(0).u32(1).u16(1).u8(4).u8(6).u32(0).u32(0);
    EXPECT_EQ(datagrams_of(cooked_2, Writer{cooked}.bytes(payload).buffer()), 1U);
  }
  const Buffer endless = Writer{}.u16(7).u16(0x8100).u16(7).u16(0x8100).buffer();
  EXPECT_EQ(datagrams_of(ethernet_link, ethernet(endless, 0x8100)), 0U);
}

TEST(LinkLayer, OtherProtocolsAndShortFramesAreNoIpPackets) {
  constexpr int ethernet_link = 1;
  const Buffer arp = ethernet(Buffer(28, 0), 0x0806);
  EXPECT_FALSE(ip_packet(arp, ethernet_link).has_value());
  const auto nothing = ip_packet(Buffer(13, 0), ethernet_link);
  ASSERT_TRUE(nothing.has_value()) << "what it is cannot be told";
  EXPECT_TRUE(nothing->empty());
}

TEST(CaptureFile, BothByteOrdersOfPcap) {
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
    PcapFile file{1, order};
    file.message(1'500'000, route, greeting());
    const Conversation conversation = conversation_of({file.buffer()});
    ASSERT_EQ(conversation.datagrams.size(), 1U);
    EXPECT_EQ(conversation.datagrams[0].time_ns, time_of(1'500'000));
  }
}

TEST(CaptureFile, APcapngWithNanoseconds) {
  constexpr std::uint64_t time_ns = 1'000'000'000'123'456'789;
  PcapngFile file;
  file.interface(1, 9).packet(0, time_ns, ethernet(ipv4(route, greeting().buffer())));
  const Conversation conversation = conversation_of({file.buffer()});
  ASSERT_EQ(conversation.datagrams.size(), 1U);
  EXPECT_EQ(conversation.datagrams[0].time_ns, 1'000'000'000'123'456'789);
}

TEST(CaptureFile, WhatIsNoCaptureIsRefusedWithItsName) {
  const auto error_of = [](const Buffer& content) {
    const auto file = CaptureFile::from_memory("x.pcap", content, 1U << 20U);
    return file ? std::string{} : to_string(file.error());
  };
  EXPECT_NE(error_of(Writer{}.text("no capture at all, but long enough").buffer())
                .find("x.pcap: not a capture"),
            std::string::npos);
  EXPECT_EQ(error_of({}), "x.pcap: the file is empty");
  constexpr std::uint32_t wifi = 105;
  EXPECT_NE(error_of(PcapFile{wifi}.buffer()).find("link type 105"), std::string::npos);
  EXPECT_NE(error_of(PcapFile{wifi}.buffer()).find("expected Ethernet"), std::string::npos);
  EXPECT_EQ(error_of(PcapFile{}.buffer()), "");
  const auto missing = CaptureFile::open("/no/such/file.pcap");
  ASSERT_FALSE(missing);
  EXPECT_EQ(to_string(missing.error()), "/no/such/file.pcap: No such file or directory");
  EXPECT_FALSE(CaptureFile::open("/dev/zero"));
}

/// Larger than what is read at once, in two members of which the second begins within a packet.
TEST(CaptureFile, CompressedFilesAreReadAsTheyUnpack) {
  constexpr std::size_t packets = 4'000;
  PcapFile plain;
  for (std::size_t k = 0; k < packets; ++k) {
    Buffer noise(200);
    for (std::size_t i = 0; i < noise.size(); ++i) {
      noise[i] = static_cast<std::uint8_t>((k + 1) * (i + 7) * 2'654'435'761U >> 13U);
    }
    plain.frame(static_cast<std::int64_t>(k), noise);
  }
  const Buffer whole = plain.buffer();
  const auto middle = whole.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2 + 3);
  Buffer packed = gzip({whole.begin(), middle});
  const Buffer second = gzip({middle, whole.end()});
  packed.insert(packed.end(), second.begin(), second.end());
  ASSERT_GT(packed.size(), 2U << 16U);
  const stormproof::files::Folder folder;
  const std::string path = (folder.path() / "x.pcap.gz").string();
  const auto packets_of = [&](const Buffer& content) {
    std::ofstream{path, std::ios::binary}.write(reinterpret_cast<const char*>(content.data()),
                                                static_cast<std::streamsize>(content.size()));
    auto file = CaptureFile::open(path);
    EXPECT_TRUE(file);
    std::size_t count = 0;
    while (file->next()) ++count;
    return std::pair{count, file->damage()};
  };
  EXPECT_EQ(packets_of(packed), (std::pair{packets, std::string{}}));
  packed.resize(packed.size() - 20'000);
  const auto [count, damage] = packets_of(packed);
  EXPECT_LT(count, packets);
  EXPECT_GT(count, packets / 2);
  EXPECT_EQ(damage, "the .gz data is cut off");
}

TEST(Decompress, GzipWithSeveralMembersUpToTheLimit) {
  const Buffer plain(100'000, 7);
  Buffer packed = gzip(plain);
  const Buffer once = packed;
  packed.insert(packed.end(), once.begin(), once.end());
  ASSERT_EQ(compression_of(packed), Compression::gzip);
  const auto unpacked = unpack(packed, Compression::gzip, 200'000);
  ASSERT_TRUE(unpacked);
  EXPECT_EQ(unpacked->bytes.size(), 200'000U);
  EXPECT_EQ(unpacked->damage, "");
  EXPECT_FALSE(unpack(packed, Compression::gzip, 199'999));
  packed.resize(packed.size() - 9);
  const auto cut = unpack(packed, Compression::gzip, 200'000);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->damage, "the .gz data is cut off");
}

}  // namespace layers_test
}  // namespace stormproof::capture
