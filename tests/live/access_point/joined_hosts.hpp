// Hosts for the tests of the program: network namespaces without a name, and the access point
// between them. The kernel removes a namespace when the last file descriptor that holds it is
// closed, and the access point ends with the process that started it, so a test that fails, or is
// killed, leaves nothing behind.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <sys/types.h>

namespace stormproof::live {

/// Why such a test cannot run here; nothing if it can.
[[nodiscard]] std::optional<std::string> why_no_hosts();

/// A network namespace.
class Host {
 public:
  Host();  ///< fails the test if there can be none; then `ready` is false
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;
  ~Host();

  [[nodiscard]] bool ready() const { return descriptor_ >= 0; }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Runs `work` inside; processes and sockets that it makes belong to the namespace.
  void inside(const std::function<void()>& work) const;

 private:
  int descriptor_ = -1;
};

/// A process with its standard output and error in pipes.
class AccessPoint {
 public:
  /// Starts the program and waits until it has printed a line or ended.
  explicit AccessPoint(const std::vector<std::string>& arguments);
  AccessPoint(const AccessPoint&) = delete;
  AccessPoint& operator=(const AccessPoint&) = delete;
  ~AccessPoint();  ///< kills it if it still runs

  /// Asks it to end; its exit code, or -1 if a signal ended it.
  int end();
  /// Waits for its own end; the exit code.
  int wait();
  [[nodiscard]] const std::string& first_line() const { return first_line_; }
  /// All that it wrote to standard error, once it has ended.
  [[nodiscard]] const std::string& complaint() const { return complaint_; }
  [[nodiscard]] pid_t process() const { return process_; }

 private:
  pid_t process_ = -1;
  int output_ = -1;
  int error_ = -1;
  std::string first_line_;
  std::string complaint_;
};

/// Hosts that an access point joins, with addresses 10.99.0.1, 10.99.0.2 … and no traffic but what
/// a test sends: static neighbours, no IPv6.
class JoinedHosts {
 public:
  explicit JoinedHosts(const std::vector<std::string>& arguments = {}, std::size_t count = 2);
  ~JoinedHosts();

  [[nodiscard]] bool ready() const { return ready_; }
  /// A UDP socket of the host, bound to port 7400; receiving gives up after two seconds.
  int open_socket(std::size_t host);
  /// Ends the access point; its statistics, or null if it did not end well.
  nlohmann::json end();

 private:
  void join(std::size_t host, const std::string& tap);

  std::deque<Host> hosts_;
  std::string statistics_;
  std::optional<AccessPoint> access_point_;
  std::vector<int> sockets_;
  bool ready_ = false;
};

}  // namespace stormproof::live
