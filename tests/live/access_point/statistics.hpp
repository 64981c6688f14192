// What an access point says of itself when it ends: what it served, what it lost, and how far the
// real deliveries lagged behind the virtual channel, which is what makes a measurement credible.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/live/access_point/half_duplex_channel.hpp"

namespace stormproof::live {

/// How late deliveries were: their time on the clock less their time in the channel.
class Lateness {
 public:
  void add(Nanoseconds late);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] Nanoseconds max() const { return max_; }
  [[nodiscard]] Nanoseconds mean() const;  ///< 0 without deliveries
  /// The least whole number of microseconds (at most `max`) that is not exceeded by `percent`
  /// (1 … 100) per cent of the deliveries. Beyond 100 ms it is `max`.
  [[nodiscard]] Nanoseconds percentile(int percent) const;

 private:
  static constexpr std::size_t buckets = 100'000;  // of one microsecond each

  std::vector<std::uint64_t> by_microsecond_;  // bucket k: more than k - 1, at most k
  std::uint64_t count_ = 0;
  Nanoseconds sum_;
  Nanoseconds max_;
};

struct RelayStatistics {
  Nanoseconds duration;   ///< from ready to the signal
  bool realtime = false;  ///< the kernel prefers the access point to ordinary processes
  Lateness lateness;
  std::array<std::uint64_t, most_stations>
      refused{};                    ///< deliveries that a TAP device did not take (it is down)
  std::uint64_t inside_at_end = 0;  ///< frames that waited or were served then
};

/// What was asked of the access point; it goes into the statistics, so that they explain
/// themselves.
struct Setting {
  std::vector<std::string> taps;  ///< names of the stations, from 0 on
  model::WirelessProfile wireless;
  QueueLimits limits;
  Losses losses;
};

/// JSON, indented, ends with a newline.
[[nodiscard]] std::string to_json(const Setting& setting, const ChannelStatistics& channel,
                                  const RelayStatistics& relay);

}  // namespace stormproof::live
