// The channel in real time: frames come from two TAP devices, and each goes to the other one when
// its downlink ends. All times are the channel's: a frame requests service when it is read, and
// the next service begins where the last one ended, however late this process woke up. So lateness
// moves single deliveries, is measured, and never accumulates.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tests/live/access_point/half_duplex_channel.hpp"
#include "tests/live/access_point/statistics.hpp"
#include "tests/live/access_point/tap_device.hpp"

namespace stormproof::live {

class Relay {
 public:
  Relay(HalfDuplexChannel& channel, const std::array<TapDevice, 2>& taps);

  /// Serves until `stop` (a file descriptor) is readable; returns why it ended before, if it did.
  [[nodiscard]] std::optional<std::string> run(int stop);

  [[nodiscard]] const RelayStatistics& statistics() const { return statistics_; }

 private:
  enum class Wake { work, stopped, tap_gone };

  [[nodiscard]] Nanoseconds now() const;
  Wake wait(int stop);
  void read_frames();
  bool read_frame(std::uint32_t station);
  void deliver();

  HalfDuplexChannel& channel_;
  const std::array<TapDevice, 2>& taps_;
  std::chrono::steady_clock::time_point start_;
  std::array<bool, 2> readable_{};
  std::vector<std::byte> buffer_;
  std::vector<std::vector<std::byte>> contents_;  // by the channel's name of the frame
  RelayStatistics statistics_;
};

}  // namespace stormproof::live
