// What the explorer's host remembers for safety.snapshot: as what a packet that arrives was
// emitted, and, where ACKNACKs list only what readers have heard of, what they have heard of. The
// claims are in checker/engines/explorer/claims.hpp.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "checker/engines/explorer/claims.hpp"
#include "checker/engines/explorer/host_parts.hpp"
#include "fsm/composition/reader.hpp"
#include "model/engine/running_world.hpp"

namespace stormproof::explorer {

/// A part of `Host`.
template <class Host, class Packing>
class SnapshotWatch {
 public:
  /// What arrives had been emitted as this, which lives as long as the event.
  void arrives_from(const Slot& emitted) { emitted_ = &emitted; }

  /// What the reader would say if it emitted the ACKNACK now.
  [[nodiscard]] Slot said_now(const Slot& acknack) {
    Slot said;
    said_ = &said;
    const std::uint32_t number = acknack.relation * detail::number_step<Host::writer_count>;
    model::RunningWorld<Host, comp::owner::relation> w{host(), number};
    if (acknack.has(Slot::initial)) {
      Packing::Composition::emit_initial(w);
    } else {
      Packing::Composition::emit_acknack(w);
    }
    said_ = nullptr;
    return said;
  }

 protected:
  /// Whether the packet is only to be known.
  bool keeps(const Slot& packet) {
    if (said_ == nullptr) return false;
    *said_ = packet;
    return true;
  }
  [[nodiscard]] const Slot& emitted() const { return *emitted_; }
  void note_emitted(const Slot& acknack) {
    std::optional<Members> announced;
    if constexpr (Packing::lists_what_is_announced) {
      announced = host().state().template get<Announced>(acknack.relation);
    }
    note_listed(host().state(), host().frame(), acknack, host().descriptors(acknack.relation),
                announced);
  }

  /// Those of readers; what these take tells them of descriptors.
  struct ListeningMachines {
    detail::PartMachines<comp::Reader>& machines;
    SnapshotWatch& watch;

    template <class Event, class Input>
    auto step(fsm::StateId& state, const Input& input, std::uint32_t) {
      const auto output = machines.template step<Event>(state, input);
      if constexpr (std::is_same_v<Event, fsm::discovery_reader::DataReceived>) {
        if (output.take_data) watch.announce(std::bit_width(watch.emitted_->set));
      } else if constexpr (std::is_same_v<Event, fsm::discovery_reader::HeartbeatReceived>) {
        if (output.schedule_acknack) watch.announce(watch.emitted_->number);
      }
      return output;
    }
  };

 private:
  [[nodiscard]] Host& host() { return static_cast<Host&>(*this); }
  /// The reader that a packet reaches has heard of the first descriptors.
  void announce(int limit) {
    const unsigned relation = emitted_->relation;
    const auto heard = static_cast<Members>(member(static_cast<unsigned>(limit)) - 1);
    auto& state = host().state();
    state.template set<Announced>(state.template get<Announced>(relation) | heard, relation);
  }

  const Slot* emitted_ = nullptr;
  Slot* said_ = nullptr;  ///< where an ACKNACK goes that is only to be known
};

}  // namespace stormproof::explorer
