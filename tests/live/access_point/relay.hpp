// The channel in real time: frames come from TAP devices, one of each host, and each goes where its
// destination address was seen as a source, or to all others, when its downlink ends. All times are
// the channel's: a frame requests service when it is read, and the next service begins where the
// last one ended, however late this process woke up. So lateness moves single deliveries, is
// measured, and never accumulates.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/live/access_point/half_duplex_channel.hpp"
#include "tests/live/access_point/statistics.hpp"
#include "tests/live/access_point/tap_device.hpp"

namespace stormproof::live {

class Relay {
 public:
  /// Two devices or more, up to `most_stations`.
  Relay(HalfDuplexChannel& channel, const std::vector<TapDevice>& taps);

  /// Serves until `stop` (a file descriptor) is readable; returns why it ended before, if it did.
  [[nodiscard]] std::optional<std::string> run(int stop);

  [[nodiscard]] const RelayStatistics& statistics() const { return statistics_; }

 private:
  enum class Wake { work, stopped, tap_gone };

  [[nodiscard]] Nanoseconds now() const;
  Wake wait(int stop);
  void read_frames();
  bool read_frame(std::uint32_t station);
  /// Who the destination of a frame is; nothing for a group, or if nobody has sent from there.
  [[nodiscard]] std::optional<std::uint32_t> receiver_of(bool group) const;
  void deliver();
  void give(std::uint32_t receiver, const Service& service);

  HalfDuplexChannel& channel_;
  const std::vector<TapDevice>& taps_;
  std::chrono::steady_clock::time_point start_;
  std::array<bool, most_stations> readable_{};
  std::map<std::uint64_t, std::uint32_t> stations_;  // by hardware address
  std::vector<std::byte> buffer_;
  std::vector<std::vector<std::byte>> contents_;  // by the channel's name of the frame
  RelayStatistics statistics_;
};

}  // namespace stormproof::live
