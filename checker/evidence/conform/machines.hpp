// The machines of all sides of a capture, stepped with Boost.MSM so that the row that fired is
// counted. What a machine sends when, only they say.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "checker/evidence/conform/conform.hpp"
#include "fsm/announcer.hpp"
#include "fsm/cautious_reader.hpp"
#include "fsm/change_for_reader.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/heartbeat_pacer.hpp"
#include "fsm/heartbeat_timer.hpp"
#include "fsm/initial_acknack.hpp"
#include "fsm/single_shot.hpp"
#include "fsm/stepper.hpp"

namespace stormproof::conform {

/// Steps machines of one kind and counts the rows that fire.
template <class Machine>
class Tally {
 public:
  using Fly = fsm::Stepper<Machine>;

  /// Whose machine it is, as a RunningWorld says it, does not matter.
  template <class Event>
  typename Fly::Output step(fsm::StateId& state, const typename Fly::Input& input,
                            std::uint32_t = 0) {
    fsm::RowId row = fsm::no_row;
    const auto output = machine_.template step<Event>(state, input, row);
    if (row != fsm::no_row) ++uses_[row];
    return output;
  }

  void report(std::vector<RowUse>& into) const {
    const fsm::MachineInfo info = fsm::Reflect<Machine>::info();
    for (std::size_t k = 0; k < info.rows.size(); ++k) {
      const fsm::RowInfo& row = info.rows[k];
      std::string text{info.states[row.source]};
      text += " + ";
      text += info.events[row.event];
      if (row.guard != "none") text += " [" + row.guard + "]";
      if (row.action != "none") (text += " / ") += row.action;
      (text += " → ") += info.states[row.target];
      into.push_back({info.name, k, std::move(text), uses_[k]});
    }
  }

 private:
  Fly machine_;
  std::array<std::uint64_t, fsm::Reflect<Machine>::Rows::size> uses_{};
};

/// Machines of several kinds.
template <class... Kinds>
struct Tallies : Tally<Kinds>... {
  template <class Machine>
  Tally<Machine>& of() {
    return *this;
  }
  void report(std::vector<RowUse>& into) const { (Tally<Kinds>::report(into), ...); }
};

struct Machines {
  Tallies<fsm::Announcer, fsm::HeartbeatTimer, fsm::ChangeForReader, fsm::SingleShot,
          fsm::DiscoveryReader, fsm::InitialAckNack>
      fastdds;
  Tallies<fsm::HeartbeatPacer, fsm::CautiousReader> cyclone;
};

}  // namespace stormproof::conform
