// Records the loopback interface while something is sent over it. Where capturing is not allowed,
// that is what the error says.
#include "checker/evidence/capture/recording.hpp"

#include <filesystem>
#include <string>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "checker/evidence/capture/capture_file.hpp"

namespace stormproof::capture {
namespace recording_test {

/// Other tests of this file may run at the same time, in processes of their own.
std::string file() {
  return ::testing::TempDir() + "/recording-" + std::to_string(getpid()) + ".pcap";
}

/// One datagram to the discard port of this machine.
void send_one() {
  const int socket_fd = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(9);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const char text[] = "RTPS";
  static_cast<void>(
      sendto(socket_fd, text, sizeof text, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to));
  close(socket_fd);
}

/// Leaves no file behind.
class Recordings : public ::testing::Test {
 protected:
  void TearDown() override {
    for (const std::string& name : {file(), file() + ".1"}) std::filesystem::remove(name);
  }
};

TEST_F(Recordings, KeepsWhatPassesTheInterface) {
  const auto recorded = record({"lo", model::Nanoseconds{400'000'000}, file()}, [](std::uint64_t) {
    send_one();
    return true;
  });
  if (!recorded) {
    EXPECT_NE(to_string(recorded.error()).find("setcap"), std::string::npos)
        << to_string(recorded.error());
    return;
  }
  EXPECT_GT(*recorded, 0U);
  auto opened = CaptureFile::open(file());
  ASSERT_TRUE(opened) << to_string(opened.error());
  std::uint64_t packets = 0;
  while (opened->next()) ++packets;
  EXPECT_EQ(packets, *recorded);
  EXPECT_TRUE(opened->damage().empty()) << opened->damage();
}

TEST_F(Recordings, ARingKeepsTheNewestPacketsInTwoFiles) {
  constexpr std::uint64_t most_bytes = 2000;
  const Recording ring{"lo", model::Nanoseconds{2'000'000'000}, file(), most_bytes};
  std::filesystem::remove(ring.older());
  std::uint64_t seen = 0;
  const auto recorded = record(ring, [&](std::uint64_t packets) {
    seen = packets;
    for (int k = 0; k < 5; ++k) send_one();
    return packets < 100;
  });
  if (!recorded) return;  // as above
  EXPECT_EQ(*recorded, seen);
  std::uint64_t kept = 0;
  for (const std::string& name : {ring.older(), ring.path}) {
    auto opened = CaptureFile::open(name);
    ASSERT_TRUE(opened) << to_string(opened.error());
    while (opened->next()) ++kept;
    EXPECT_TRUE(opened->damage().empty()) << opened->damage();
  }
  EXPECT_GT(kept, 0U);
  EXPECT_LT(kept, *recorded);
}

TEST_F(Recordings, RefusesAnInterfaceThatIsNotThere) {
  const auto recorded = record({"nosuch0", model::Nanoseconds{1'000'000}, file()},
                               [](std::uint64_t) { return true; });
  ASSERT_FALSE(recorded);
  EXPECT_EQ(recorded.error().where, "--interface nosuch0");
}

}  // namespace recording_test
}  // namespace stormproof::capture
