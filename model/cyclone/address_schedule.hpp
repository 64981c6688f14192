// Where announcements go: the group, participants, and ports of peers at which nobody is known. An
// address is live, or it ages: then it is announced to rarely, and some day no more. 0.10 keeps all
// addresses that it has ever had.
// Source: specs/guide/cyclone-life.md, "Addresses"; q_ddsi_discovery.c,
// as_disc; ddsi_spdp_schedule.c.
#pragma once

#include <cstdint>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::model::cyclone {

class AddressSchedule {
 public:
  using Number = std::uint32_t;  ///< a participant, or behind them a port of a host without one

  explicit AddressSchedule(const Scenario& scenario);

  /// Participant i starts.
  void start(Number i, std::int64_t now);
  /// The other is known from now on, or not any more.
  void recognised(Number i, Number other);
  void lease_ended(Number i, Number other, std::int64_t now);
  void said_goodbye(Number i, Number other, std::int64_t now);

  /// Of an announcement: the group first if it is one, participants ascending, then other ports by
  /// host and port. `all`: those that age, too.
  [[nodiscard]] std::vector<Number> of_announcement(Number i, bool all) const;
  /// When the next one that ages is due, ns; 0: none does.
  [[nodiscard]] std::int64_t next(Number i) const;
  /// Of those that are due, the ones that are announced to; the others are dropped.
  [[nodiscard]] std::vector<Number> age(Number i, std::int64_t now);

  [[nodiscard]] bool is_port(Number address) const { return address >= participants_; }
  /// The host of an address that is a port without a participant.
  [[nodiscard]] HostId host_of(Number address) const { return ports_[address - participants_]; }

 private:
  enum class State : std::uint8_t { unknown, live, ageing };
  struct Address {
    State state = State::unknown;
    bool is_peer = false;
    std::int64_t prune = 0;  ///< when it is dropped, if it ages then
    std::int64_t next = 0;   ///< when it is announced to, if it ages then
  };
  /// What participant i does by its profile.
  struct Rules {
    explicit Rules(const DdsProfile& dds);

    std::int64_t initial_delay;
    std::int64_t discovered_delay;
    bool has_group;
    bool only_group;
    bool prunes;
    std::int64_t interval;  ///< between two announcements to one that ages
  };
  static void let_age(const Rules& rules, Address& address, std::int64_t now);

  const Number participants_;
  std::vector<Rules> rules_;  // by participant
  std::vector<HostId> ports_;
  std::vector<std::vector<Address>> addresses_;  // by participant and address
};

}  // namespace stormproof::model::cyclone
