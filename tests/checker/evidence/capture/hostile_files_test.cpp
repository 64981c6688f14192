// Files that are no captures, or hostile ones: each is refused, or used up to what is wrong, and
// takes neither long nor more memory than its limit.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <lzma.h>
#include <sys/stat.h>
#include <unistd.h>

#include "checker/evidence/capture/capture_file.hpp"
#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/decompress.hpp"
#include "tests/checker/evidence/capture/gzip.hpp"
#include "tests/checker/evidence/capture/packets.hpp"
#include "tests/files.hpp"

namespace stormproof::capture {

namespace hostile_files_test {

namespace fs = std::filesystem;
using namespace testing;

const Route route{at(1, 7410), at(2, 7411), 5};

Buffer frame() {
  return ethernet(ipv4(route, Message{prefix(1)}.announcement({at(1, 7410)}).buffer()));
}

/// Datagrams that were read, and the damage that ended the reading.
struct Read {
  std::size_t datagrams = 0;
  std::string damage{};
  std::vector<std::int64_t> times_ns{};
};

Read read(const Buffer& content) {
  const std::vector<MemoryCapture> captures{{"a", content, 1U << 20U}};
  const auto conversation = read_conversation(captures);
  if (!conversation) return {0, to_string(conversation.error()), {}};
  Read result{conversation->datagrams.size(), {}, {}};
  for (const Remark& remark : conversation->remarks) result.damage += remark.first;
  for (const auto& one : conversation->datagrams) result.times_ns.push_back(one.time_ns);
  return result;
}

TEST(Pcapng, InterfacesWithTheirOwnResolutions) {
  PcapngFile file;
  file.interface(1, 6).interface(1, 9).interface(1, 0x80 | 10).interface(1, 0);
  file.packet(0, 1'000'000, frame()).packet(1, 2'000'000'000, frame());
  file.packet(2, 3 * 1024 + 512, frame()).packet(3, 4, frame());
  EXPECT_EQ(
      read(file.buffer()).times_ns,
      (std::vector<std::int64_t>{1'000'000'000, 2'000'000'000, 3'500'000'000, 4'000'000'000}));
}

TEST(Pcapng, UnknownBlocksAndSeveralSections) {
  PcapngFile file;
  file.block(0x0bad, Buffer(13, 7)).interface(1).block(5, Buffer(8, 0)).packet(0, 1, frame());
  Buffer twice = file.buffer();
  const Buffer second = PcapngFile{ByteOrder::big}.interface(1).packet(0, 2, frame()).buffer();
  twice.insert(twice.end(), second.begin(), second.end());
  EXPECT_EQ(read(file.buffer()).datagrams, 1U);
  EXPECT_GE(read(twice).datagrams, 1U);
}

TEST(Pcapng, HostileBlocksEndTheReading) {
  const PcapngFile start = PcapngFile{}.interface(1).packet(0, 1, frame());
  const auto damage = [&start](std::uint32_t type, const Buffer& body,
                               std::optional<std::uint32_t> length) {
    PcapngFile file = start;
    const Read result = read(file.block(type, body, length).packet(0, 2, frame()).buffer());
    EXPECT_GE(result.datagrams, 1U);
    return result.damage;
  };
  for (const std::uint32_t length : {0U, 3U, 11U, 0x7fffffffU, 0xffffffffU, 0xfffffff0U}) {
    EXPECT_NE(damage(6, Buffer(20, 0), length), "") << length;
    EXPECT_NE(damage(0x0bad, Buffer(20, 0), length), "") << length;
  }
  constexpr std::uint32_t huge = 0x40000000;
  // A packet longer than its block, one of no interface, and one in no time.
  const Writer no_bytes = Writer{ByteOrder::little}.u32(0).u32(0).u32(1).u32(huge).u32(huge);
  EXPECT_NE(damage(6, no_bytes.buffer(), {}), "");
  const Writer nowhere = Writer{ByteOrder::little}.u32(9).u32(0).u32(1).u32(0).u32(0);
  EXPECT_NE(damage(6, nowhere.buffer(), {}), "");
  const Writer never = Writer{ByteOrder::little}.u32(0).u32(0xffffffff).u32(1).u32(0).u32(0);
  EXPECT_NE(damage(6, never.buffer(), {}).find("impossible time"), std::string::npos);
}

TEST(Pcapng, HostileInterfaces) {
  const auto first_packet = [](const Buffer& interface) {
    return read(PcapngFile{}.block(1, interface).packet(0, 1, frame()).buffer());
  };
  Writer start{ByteOrder::little};
  start.u16(1).u16(0).u32(0);
  // Options that reach beyond the block, a resolution of the wrong length, one beyond all times.
  EXPECT_EQ(first_packet(Writer{start}.u16(2).u16(0xffff).u32(0).buffer()).datagrams, 0U);
  EXPECT_EQ(first_packet(Writer{start}.u16(9).u16(4).u32(6).u32(0).buffer()).datagrams, 0U);
  EXPECT_EQ(first_packet(Writer{start}.u16(9).u16(1).u32(0xff).u32(0).buffer()).datagrams, 0U);
  EXPECT_EQ(first_packet(Writer{start}.u32(0).buffer()).datagrams, 1U);
  constexpr std::uint16_t wifi = 105;
  const Read mixed = read(
      PcapngFile{}.interface(1).packet(0, 1, frame()).interface(wifi).packet(1, 2, {}).buffer());
  EXPECT_EQ(mixed.datagrams, 1U);
  EXPECT_NE(mixed.damage.find("after packet 1"), std::string::npos) << mixed.damage;
}

TEST(Pcap, HostilePacketLengthsEndTheReading) {
  for (const std::uint32_t length : {262'145U, 0x7fffffffU, 0xffffffffU}) {
    Buffer bytes = PcapFile{}.frame(0, frame()).buffer();
    const Buffer header = Writer{ByteOrder::little}.u32(1).u32(1).u32(length).u32(9).buffer();
    bytes.insert(bytes.end(), header.begin(), header.end());
    bytes.resize(bytes.size() + 300'000);
    const Read result = read(bytes);
    EXPECT_EQ(result.datagrams, 1U);
    EXPECT_NE(result.damage.find("after packet 1"), std::string::npos);
  }
}

TEST(Bombs, StopAtTheLimit) {
  const Buffer bomb = gzip(Buffer(8U << 20U, 0));
  EXPECT_LT(bomb.size(), 20'000U);
  EXPECT_EQ(read(bomb).damage, "a: unpacks to more than 1 MiB; unpack and split it first");
}

TEST(Bombs, AnXzDictionaryBeyondTheMemoryLimit) {
  Buffer packed(4096);
  std::size_t length = 0;
  const Buffer plain = PcapFile{}.frame(0, frame()).buffer();
  ASSERT_EQ(lzma_easy_buffer_encode(6, LZMA_CHECK_CRC32, nullptr, plain.data(), plain.size(),
                                    packed.data(), &length, packed.size()),
            LZMA_OK);
  packed.resize(length);
  EXPECT_EQ(read(packed).datagrams, 1U);
  // Behind the header of the stream: the block's header of 4 · (n + 1) bytes, which ends with its
  // CRC. The filter LZMA2 (0x21) has one byte of properties, the size of the dictionary.
  constexpr std::size_t block = 12;
  const std::size_t size = (packed[block] + 1U) * 4;
  const auto end = packed.begin() + static_cast<std::ptrdiff_t>(block + size);
  const auto filter = std::find(packed.begin() + block, end, 0x21);
  ASSERT_LT(filter, end);
  filter[2] = 40;  // 4 GiB
  const Buffer crc =
      Writer{ByteOrder::little}.u32(lzma_crc32(packed.data() + block, size - 4, 0)).buffer();
  std::copy(crc.begin(), crc.end(), end - 4);
  EXPECT_EQ(read(packed).damage, "a: the .xz data needs more than 256 MiB of memory to unpack");
}

class Files : public ::testing::Test {
 protected:
  std::string path(const char* name) const { return folder_ / name; }
  static std::string error_of(const std::string& path) {
    const std::vector<std::string> files{path};
    const auto conversation = read_conversation(files);
    return conversation ? "" : conversation.error().message;
  }

  const files::Folder own_;
  const fs::path folder_ = own_.path();
};

TEST_F(Files, FoldersPipesAndDevicesAreRefusedWithoutWaiting) {
  constexpr const char* refused =
      "not a regular file or a pipe; expected a capture (pcap or pcapng)";
  constexpr const char* silent =
      "a pipe into which nobody writes; expected a capture (pcap or pcapng)";
  EXPECT_EQ(error_of(folder_), "is a directory; expected a file");
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(error_of(path("pipe")), silent);
  fs::create_symlink(path("pipe"), path("link.pcap"));
  EXPECT_EQ(error_of(path("link.pcap")), silent);
  EXPECT_EQ(error_of("/dev/zero"), refused);
}

TEST_F(Files, EmptyAndMissingFiles) {
  std::ofstream{path("empty.pcap")};
  EXPECT_NE(error_of(path("empty.pcap")), "");
  EXPECT_EQ(error_of(path("none.pcap")), "No such file or directory");
  fs::create_symlink(path("loop"), path("loop"));
  EXPECT_NE(error_of(path("loop")), "");
}

TEST_F(Files, AFileThatGrowsOrShrinksWhileItIsRead) {
  PcapFile file;
  for (int k = 0; k < 400; ++k) file.frame(k, frame());
  const Buffer& whole = file.buffer();
  const auto write = [this](Bytes bytes, std::ios::openmode mode) {
    std::ofstream{path("a.pcap"), mode | std::ios::binary}.write(
        reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  const auto rest = [](CaptureFile& capture) {
    std::size_t packets = 0;
    while (capture.next()) ++packets;
    return packets;
  };
  write(part(whole, 0, whole.size() / 2), std::ios::trunc);
  auto growing = CaptureFile::open(path("a.pcap"));
  ASSERT_TRUE(growing);
  EXPECT_TRUE(growing->next().has_value());
  write(part(whole, whole.size() / 2), std::ios::app);
  EXPECT_EQ(rest(*growing), 399U);
  EXPECT_EQ(growing->damage(), "");
  auto shrinking = CaptureFile::open(path("a.pcap"));
  ASSERT_TRUE(shrinking);
  EXPECT_TRUE(shrinking->next().has_value());
  fs::resize_file(path("a.pcap"), whole.size() / 2 + 5);
  const std::size_t packets = rest(*shrinking);
  EXPECT_LT(packets, 399U);
  EXPECT_NE(shrinking->damage(), "");
}

}  // namespace hostile_files_test
}  // namespace stormproof::capture
