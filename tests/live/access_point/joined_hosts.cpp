// Namespaces, processes and addresses for the tests of the program.
#include "tests/live/access_point/joined_hosts.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stormproof::live {

namespace {

constexpr const char* own_network = "/proc/thread-self/ns/net";

bool run(const std::string& command) { return std::system(command.c_str()) == 0; }

std::string rest_of(int descriptor) {
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = read(descriptor, part.data(), part.size())) > 0;) {
    text.append(part.data(), static_cast<std::size_t>(n));
  }
  return text;
}

}  // namespace

std::optional<std::string> why_no_hosts() {
  if (geteuid() != 0) return "network namespaces and TAP devices need root";
  if (access("/dev/net/tun", R_OK | W_OK) != 0) return "/dev/net/tun is missing";
  if (!run("ip -V > /dev/null 2>&1")) return "the program ip (iproute2) is missing";
  bool allowed = false;
  std::thread{[&] { allowed = unshare(CLONE_NEWNET) == 0; }}.join();
  if (!allowed) return "this system allows no network namespaces";
  return std::nullopt;
}

Host::Host() {
  // A namespace belongs to a thread; this one only makes it.
  std::thread{[this] {
    if (unshare(CLONE_NEWNET) == 0) descriptor_ = open(own_network, O_RDONLY);
  }}.join();
  EXPECT_TRUE(ready()) << std::strerror(errno);
}

Host::~Host() {
  if (ready()) close(descriptor_);
}

void Host::inside(const std::function<void()>& work) const {
  std::thread{[&] {
    if (setns(descriptor_, CLONE_NEWNET) != 0) {
      ADD_FAILURE() << "cannot enter the namespace: " << std::strerror(errno);
      return;
    }
    work();
  }}.join();
}

AccessPoint::AccessPoint(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{STORMPROOF_ACCESS_POINT};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> command;
  for (std::string& word : words) command.push_back(word.data());
  command.push_back(nullptr);
  std::array<int, 2> output{};
  std::array<int, 2> error{};
  if (pipe2(output.data(), O_CLOEXEC) != 0 || pipe2(error.data(), O_CLOEXEC) != 0) return;
  process_ = fork();
  if (process_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(output[1], STDOUT_FILENO);
    dup2(error[1], STDERR_FILENO);
    execv(command[0], command.data());
    _exit(127);
  }
  close(output[1]);
  close(error[1]);
  output_ = output[0];
  error_ = error[0];
  for (char next = 0; read(output_, &next, 1) == 1 && next != '\n';) first_line_ += next;
}

AccessPoint::~AccessPoint() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  close(output_);
  close(error_);
}

int AccessPoint::end() {
  kill(process_, SIGTERM);
  return wait();
}

int AccessPoint::wait() {
  complaint_ = rest_of(error_);
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

JoinedHosts::JoinedHosts(const std::vector<std::string>& arguments, std::size_t count) {
  const std::string name = "spt" + std::to_string(getpid());
  statistics_ = (std::filesystem::temp_directory_path() / (name + ".json")).string();
  std::vector<std::string> words{"--statistics", statistics_};
  std::vector<std::string> taps;
  std::string ready = "ready";
  for (std::size_t host = 0; host < count; ++host) {
    if (!hosts_.emplace_back().ready()) return;
    taps.push_back(name + static_cast<char>('a' + host));
    words.insert(words.end(), {"--tap", taps.back()});
    ready += " " + taps.back();
  }
  words.insert(words.end(), arguments.begin(), arguments.end());
  access_point_.emplace(words);
  if (access_point_->first_line() != ready) {
    access_point_->wait();
    ADD_FAILURE() << "the access point is not ready: " << access_point_->complaint();
    return;
  }
  for (std::size_t host = 0; host < count; ++host) join(host, taps[host]);
  ready_ = !testing::Test::HasFailure();
}

JoinedHosts::~JoinedHosts() {
  for (const int socket : sockets_) close(socket);
  std::error_code ignored;
  std::filesystem::remove(statistics_, ignored);
}

/// Moves the device into the namespace of the host and sets it up there.
void JoinedHosts::join(std::size_t host, const std::string& tap) {
  const std::string network =
      "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(hosts_[host].descriptor());
  EXPECT_TRUE(run("ip link set " + tap + " netns " + network));
  const std::string own = std::to_string(host + 1);
  std::string command = "ip link set " + tap + " address 02:00:00:00:00:0" + own +
                        " addrgenmode none && ip addr add 10.99.0." + own +
                        "/24 broadcast 10.99.0.255 dev " + tap + " && ip link set " + tap + " up";
  for (std::size_t other = 0; other < hosts_.size(); ++other) {
    if (other == host) continue;
    const std::string number = std::to_string(other + 1);
    command += " && ip neigh add 10.99.0." + number + " lladdr 02:00:00:00:00:0" + number +
               " dev " + tap + " nud permanent";
  }
  hosts_[host].inside([&] { EXPECT_TRUE(run(command)); });
}

int JoinedHosts::open_socket(std::size_t host) {
  int made = -1;
  hosts_[host].inside([&] {
    made = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(7400);
    const timeval patience{.tv_sec = 2, .tv_usec = 0};
    const int on = 1;
    EXPECT_EQ(bind(made, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(setsockopt(made, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience), 0);
    EXPECT_EQ(setsockopt(made, SOL_SOCKET, SO_BROADCAST, &on, sizeof on), 0);
  });
  sockets_.push_back(made);
  return made;
}

nlohmann::json JoinedHosts::end() {
  const int code = access_point_->end();
  EXPECT_EQ(code, 0) << access_point_->complaint();
  std::ifstream file{statistics_};
  EXPECT_TRUE(file) << "no statistics";
  if (code != 0 || !file) return nullptr;
  return nlohmann::json::parse(file);
}

}  // namespace stormproof::live
