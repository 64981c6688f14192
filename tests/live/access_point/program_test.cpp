// The program between two real network namespaces: what a host sends reaches the other one, whole,
// not before the channel has served it twice, and the statistics account for it to the nanosecond.
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <unistd.h>

#include "model/airtime.hpp"
#include "tests/live/access_point/joined_hosts.hpp"

namespace stormproof::live {
namespace program_test {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t headers_bytes = 14 + 20 + 8;  // Ethernet, IP, UDP
constexpr model::ServiceRate unicast{150'000, 144'400'000};
constexpr model::ServiceRate multicast{150'000, 6'000'000};

std::int64_t ns_since(Clock::time_point start) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
}

void send(int socket, const std::string& address, const std::string& text) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(7400);
  inet_pton(AF_INET, address.c_str(), &to.sin_addr);
  const ssize_t sent =
      sendto(socket, text.data(), text.size(), 0, reinterpret_cast<sockaddr*>(&to), sizeof to);
  ASSERT_EQ(sent, static_cast<ssize_t>(text.size())) << std::strerror(errno);
}

/// The next datagram, or nothing after two seconds.
std::string receive(int socket, int flags = 0) {
  std::string text(65'536, '\0');
  const ssize_t bytes = recv(socket, text.data(), text.size(), flags);
  text.resize(bytes > 0 ? static_cast<std::size_t>(bytes) : 0);
  return text;
}

/// A datagram that tells a lost or repeated fragment from a right one.
std::string pattern(std::size_t bytes) {
  std::string text(bytes, '\0');
  for (std::size_t k = 0; k < bytes; ++k) text[k] = static_cast<char>((k * 7 + k / 251) % 256);
  return text;
}

class AccessPointProgram : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto reason = why_no_hosts()) GTEST_SKIP() << *reason;
  }
};

TEST_F(AccessPointProgram, JoinsThreeHosts) {
  JoinedHosts hosts{{}, 3};
  ASSERT_TRUE(hosts.ready());
  const int a = hosts.open_socket(0);
  const int b = hosts.open_socket(1);
  const int c = hosts.open_socket(2);
  send(c, "10.99.0.255", "to all");  // up once, down once
  EXPECT_EQ(receive(a), "to all");
  EXPECT_EQ(receive(b), "to all");
  EXPECT_EQ(receive(c), "to all");  // its own kernel's copy, once
  EXPECT_EQ(receive(c, MSG_DONTWAIT), "");
  send(a, "10.99.0.3", "to one");
  EXPECT_EQ(receive(c), "to one");
  send(b, "10.99.0.1", "to another");
  EXPECT_EQ(receive(a), "to another");
  EXPECT_EQ(receive(b, MSG_DONTWAIT), "");
  const auto statistics = hosts.end();
  ASSERT_EQ(statistics["stations"].size(), 3U);
  EXPECT_EQ(statistics["up"]["frames"], 3);
  EXPECT_EQ(statistics["down"]["frames"], 3);
  EXPECT_EQ(statistics["delivered"], 3);
}

TEST_F(AccessPointProgram, ARoundTripTakesFourServices) {
  JoinedHosts hosts;
  ASSERT_TRUE(hosts.ready());
  const int a = hosts.open_socket(0);
  const int b = hosts.open_socket(1);
  const std::string text = pattern(1'000);
  const std::int64_t airtime_ns = unicast.airtime_ns(1'000 + headers_bytes);
  constexpr int rounds = 20;
  for (int k = 0; k < rounds; ++k) {
    const auto start = Clock::now();
    send(a, "10.99.0.2", text);
    ASSERT_EQ(receive(b), text);
    EXPECT_GE(ns_since(start), 2 * airtime_ns);
    send(b, "10.99.0.1", text);
    ASSERT_EQ(receive(a), text);
    EXPECT_GE(ns_since(start), 4 * airtime_ns);
  }
  const auto statistics = hosts.end();
  EXPECT_EQ(statistics["up"]["frames"], 2 * rounds);
  EXPECT_EQ(statistics["down"]["frames"], 2 * rounds);
  EXPECT_EQ(statistics["up"]["busy_ns"], 2 * rounds * airtime_ns);
  EXPECT_EQ(statistics["down"]["unicast"]["busy_ns"], 2 * rounds * airtime_ns);
  EXPECT_EQ(statistics["stations"][1]["frames"], rounds);
  EXPECT_EQ(statistics["delivered"], 2 * rounds);
  EXPECT_EQ(statistics["dropped"]["total"], 0);
  EXPECT_EQ(statistics["lateness_ns"]["deliveries"], 2 * rounds);
}

TEST_F(AccessPointProgram, FragmentsAreFramesOfTheirOwn) {
  JoinedHosts hosts;
  ASSERT_TRUE(hosts.ready());
  const int a = hosts.open_socket(0);
  const int b = hosts.open_socket(1);
  const std::string text = pattern(8'000);
  send(a, "10.99.0.2", text);
  ASSERT_EQ(receive(b), text);
  model::WirelessProfile wireless;
  wireless.link_overhead_bytes = model::Bytes{14};
  const model::Fragmentation fragmentation{wireless};
  std::int64_t airtime_ns = 0;
  for (std::int64_t k = 0; k < fragmentation.count(8'000); ++k) {
    airtime_ns += unicast.airtime_ns(fragmentation.bytes(8'000, k));
  }
  const auto statistics = hosts.end();
  EXPECT_EQ(statistics["up"]["frames"], 6);
  EXPECT_EQ(statistics["down"]["busy_ns"], airtime_ns);
}

TEST_F(AccessPointProgram, ABroadcastGoesDownOnceAtTheMulticastRate) {
  JoinedHosts hosts;
  ASSERT_TRUE(hosts.ready());
  const int a = hosts.open_socket(0);
  const int b = hosts.open_socket(1);
  const auto start = Clock::now();
  send(a, "10.99.0.255", "to all");
  // The sending host may hear itself, but not over the access point.
  ASSERT_EQ(receive(b), "to all");
  const std::int64_t up_ns = unicast.airtime_ns(6 + headers_bytes);
  const std::int64_t down_ns = multicast.airtime_ns(6 + headers_bytes);
  EXPECT_GE(ns_since(start), up_ns + down_ns);
  EXPECT_EQ(receive(b, MSG_DONTWAIT), "");
  const auto statistics = hosts.end();
  EXPECT_EQ(statistics["up"]["multicast"]["busy_ns"], up_ns);
  EXPECT_EQ(statistics["down"]["multicast"]["busy_ns"], down_ns);
  EXPECT_EQ(statistics["down"]["unicast"]["frames"], 0);
}

TEST_F(AccessPointProgram, WithLossOneNothingArrives) {
  JoinedHosts hosts{{"--loss", "1"}};
  ASSERT_TRUE(hosts.ready());
  const int a = hosts.open_socket(0);
  const int b = hosts.open_socket(1);
  send(a, "10.99.0.2", "into the void");
  EXPECT_EQ(receive(b), "");
  const auto statistics = hosts.end();
  EXPECT_EQ(statistics["lost"], 1);
  EXPECT_EQ(statistics["delivered"], 0);
  EXPECT_EQ(statistics["down"]["frames"], 1);
}

TEST_F(AccessPointProgram, ABurstOverflowsTheQueueOfTheStation) {
  // Services of ten seconds: while one is under way, the queue takes two more frames.
  JoinedHosts hosts{{"--overhead", "10s", "--station-queue-frames", "2"}};
  ASSERT_TRUE(hosts.ready());
  const int a = hosts.open_socket(0);
  for (int k = 0; k < 10; ++k) send(a, "10.99.0.2", "one of many");
  const int b = hosts.open_socket(1);
  send(b, "10.99.0.1", "another queue");
  EXPECT_EQ(receive(a), "");
  const auto statistics = hosts.end();
  EXPECT_EQ(statistics["stations"][0]["frames"], 10);
  EXPECT_GE(statistics["stations"][0]["dropped"], 7);
  EXPECT_EQ(statistics["stations"][1]["dropped"], 0);
  EXPECT_EQ(statistics["inside_at_end"],
            11 - statistics["stations"][0]["dropped"].get<std::int64_t>());
}

TEST_F(AccessPointProgram, LeavesNothingBehind) {
  const std::string name = "spu" + std::to_string(getpid());
  const std::string base = (std::filesystem::temp_directory_path() / name).string();
  AccessPoint program{{"--tap", name + "a", "--tap", name + "b", "--pid-file", base + ".pid",
                       "--statistics", base + ".json"}};
  EXPECT_EQ(program.first_line(), "ready " + name + "a " + name + "b");
  EXPECT_TRUE(std::filesystem::exists("/sys/class/net/" + name + "a"));
  pid_t noted = 0;
  std::ifstream{base + ".pid"} >> noted;
  EXPECT_EQ(noted, program.process());
  EXPECT_FALSE(std::filesystem::exists(base + ".json"));
  EXPECT_EQ(program.end(), 0);
  EXPECT_FALSE(std::filesystem::exists("/sys/class/net/" + name + "a"));
  EXPECT_FALSE(std::filesystem::exists("/sys/class/net/" + name + "b"));
  EXPECT_FALSE(std::filesystem::exists(base + ".pid"));
  EXPECT_FALSE(std::filesystem::exists(base + ".json.partial"));
  EXPECT_TRUE(std::filesystem::remove(base + ".json"));
}

TEST_F(AccessPointProgram, ATakenNameIsAnErrorThatLeavesNothing) {
  const std::string name = "spv" + std::to_string(getpid());
  AccessPoint program{{"--tap", name, "--tap", name}};
  EXPECT_EQ(program.first_line(), "");
  EXPECT_EQ(program.wait(), 2);
  EXPECT_NE(program.complaint().find(name + ": cannot create the TAP device"), std::string::npos)
      << program.complaint();
  EXPECT_FALSE(std::filesystem::exists("/sys/class/net/" + name));
}

/// These need no rights: they end before a device is made.
int code_of(const std::vector<std::string>& arguments, std::string& complaint) {
  AccessPoint program{arguments};
  const int code = program.wait();
  complaint = program.complaint();
  return code;
}

TEST(AccessPointUsage, BadInputIsRefused) {
  std::string said;
  EXPECT_EQ(code_of({"--tap", "one"}, said), 2);
  EXPECT_NE(said.find("--tap"), std::string::npos) << said;
  EXPECT_EQ(code_of({"--tap", "a", "--tap", "b", "--loss", "1.5"}, said), 2);
  EXPECT_NE(said.find("--loss"), std::string::npos) << said;
  EXPECT_EQ(code_of({"--tap", "a", "--tap", "b", "--queue-frames", "0"}, said), 2);
  EXPECT_EQ(code_of({"--tap", "a", "--tap", "b", "--wireless", "cellular"}, said), 2);
  EXPECT_NE(said.find("cellular: stages"), std::string::npos) << said;
  EXPECT_EQ(code_of({"--tap", "a", "--tap", "b", "--statistics", "/no/such/folder/x"}, said), 2);
  EXPECT_EQ(code_of({"--help"}, said), 0);
}

}  // namespace program_test
}  // namespace stormproof::live
