// How the hosts of a run hang on the network: which are stations of which access point on which
// channel, which are wired, what waits for a beacon (specs/guide/fleet.md). A deployment without a
// list of hosts has stations of one access point that never sleep.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::model {

class Fleet {
 public:
  explicit Fleet(const Scenario& scenario);

  /// Whether the deployment lists its hosts.
  [[nodiscard]] bool is_listed() const { return is_listed_; }
  [[nodiscard]] std::uint32_t host_count() const { return static_cast<std::uint32_t>(all_.size()); }
  /// Of the participant, which may be a Discovery Server.
  [[nodiscard]] std::uint32_t host_of(std::uint32_t participant) const {
    return hosts_[participant];
  }
  [[nodiscard]] bool is_wired(std::uint32_t host) const { return all_[host].wired; }
  /// Of a station.
  [[nodiscard]] std::uint32_t access_point_of(std::uint32_t host) const {
    return all_[host].access_point;
  }
  [[nodiscard]] bool is_station(std::uint32_t host, std::uint32_t access_point) const {
    return !all_[host].wired && all_[host].access_point == access_point;
  }
  /// Of unicast to and from the station, if it is not the profile's.
  [[nodiscard]] std::optional<BitsPerSecond> rate(std::uint32_t host) const {
    return all_[host].rate;
  }
  [[nodiscard]] std::uint32_t access_point_count() const {
    return static_cast<std::uint32_t>(radios_.size());
  }
  /// The channel of the access point; those of equal names have equal numbers.
  [[nodiscard]] std::uint32_t radio_of(std::uint32_t access_point) const {
    return radios_[access_point];
  }
  /// The names of the channels, by number.
  [[nodiscard]] const std::vector<std::string>& radios() const { return names_; }

  /// When the access point sends what it has at `now` for the station; `now` if it is awake.
  [[nodiscard]] Nanoseconds awake(std::uint32_t host, Nanoseconds now) const;
  /// The same for multicast, which all its stations have to hear.
  [[nodiscard]] Nanoseconds all_awake(std::uint32_t access_point, Nanoseconds now) const {
    return next_multiple(now, group_interval_[access_point]);
  }

 private:
  struct One {
    bool wired = false;
    std::uint32_t access_point = 0;
    std::optional<BitsPerSecond> rate;
    Nanoseconds beacon_interval;  ///< 0: always awake
  };
  static Nanoseconds next_multiple(Nanoseconds now, Nanoseconds interval);
  void take_access_points(const Deployment& deployment);
  void take_host(const Deployment& deployment, const Host& host);

  bool is_listed_;
  std::vector<std::uint32_t> hosts_;  // by participant, those of Discovery Servers behind them
  std::vector<One> all_;
  std::vector<std::uint32_t> radios_;  // by access point
  std::vector<Nanoseconds> group_interval_;
  std::vector<std::string> names_;
};

}  // namespace stormproof::model
