// What the paper's rules (fsm/composition/paper.hpp) leave to a host: DATA packets are filled up to
// the grouping limit, and each descriptor is charged against the piggyback budget; a budget that is
// used up sends a HEARTBEAT in the packet, or after it to every open relation if there are several
// (model/paper/data.cpp). Where the scope says that the budget is not used up, it is not counted.
#pragma once

#include "checker/engines/explorer/relation_world.hpp"
#include "model/descriptor_sizes.hpp"

namespace stormproof::explorer {

class PaperPacking {
 public:
  struct Budget : comp::Number<comp::owner::writer> {};          ///< bytes
  struct SentBytes : comp::Number<comp::owner::participant> {};  ///< the cumulative charge

  using Composition = comp::paper::Paper;
  using WriterOpens = comp::paper::WriterOpens;
  using State = fsm::TypeList<Budget, SentBytes>;
  template <unsigned, unsigned>
  using SharedState = fsm::TypeList<>;
  static constexpr unsigned max_descriptors = most_descriptors;
  static constexpr bool receives_separately = false;
  static constexpr bool one_event_opens_both = true;
  static constexpr bool repairs_leave_later = true;
  static constexpr bool lists_what_is_announced = false;

  PaperPacking(const model::Scenario& running, const Scope& scope)
      : sedp_{running.dds.sedp},
        count_{scope.descriptors},
        counts_bytes_{scope.counts_bytes && sedp_.piggyback != model::Piggyback::off},
        sizes_{without_defaults(running.dds.descriptors)} {}

  [[nodiscard]] unsigned descriptors(model::Stream) const { return count_; }

  template <class Host>
  void start(Host& host) const {
    for (unsigned s = 0; s < Host::writer_count; ++s) refill(host.state(), s);
  }
  template <class Host>
  static void create(Host&, const Slot&) {}  // everything exists
  template <class W>
  void perform(comp::RefillBudget, W& w) {
    auto& host = w.host();
    refill(host.state(), host.template relation_at<comp::owner::writer>(w));
  }
  template <class W>
  static void perform(comp::paper::Clock::SendBatch, W&) {}
  template <class W>
  void perform(comp::paper::Generate, W& w, const model::DescriptorSet& set, bool repair) {
    auto& host = w.host();
    const std::uint8_t relation = host.relation_at(w);
    const std::uint32_t writer = w.template number<comp::owner::writer>();
    note_generated(host.state(), host.frame(), relation, members_of(set), repair);
    const Slot empty{What::data, repair ? Slot::from_repair : std::uint8_t{0}, 0, 0, relation};
    const std::int64_t shared = sedp_.shared_header_bytes.count();
    Slot packet = empty;
    std::int64_t payload_bytes = 0;
    set.for_each([&](std::uint32_t d) {
      const std::int64_t bytes = sizes_.bytes(model::streams[writer], d);
      if (packet.set != 0 && packet_is_full(sedp_, payload_bytes, bytes - shared)) {
        host.send(std::exchange(packet, empty));
        payload_bytes = 0;
      }
      const std::int64_t added = packet.set == 0 ? bytes : bytes - shared;
      packet.set |= member(d);
      payload_bytes += added;
      const auto open = host.readers(writer);
      const bool rides = open.size() <= 1;
      if (!is_used_up(host.state(), relation, added, rides)) return;
      if (rides) {
        packet.flags |= Slot::carries_heartbeat;
        payload_bytes += sedp_.piggyback_heartbeat_bytes.count();
        return;
      }
      host.send(std::exchange(packet, empty));
      payload_bytes = 0;
      for (const std::uint32_t number : open) {
        const auto to = static_cast<std::uint8_t>(host.relation_of(number));
        host.send({What::heartbeat, 0, 0, 0, to});
      }
    });
    if (packet.set != 0) host.send(packet);
  }

 private:
  /// User descriptors only: default ones differ in nothing but their size.
  static model::DescriptorProfile without_defaults(model::DescriptorProfile profile) {
    profile.default_publications = 0;
    profile.default_subscriptions = 0;
    return profile;
  }
  template <class State>
  void refill(State& state, unsigned relation) const {
    if (!counts_bytes_) return;
    state.template set<Budget>(sedp_.piggyback_threshold_bytes.count(), relation);
  }
  /// Charges the bytes, and those of the HEARTBEAT that follows from that; whether it does.
  template <class State>
  [[nodiscard]] bool is_used_up(State& state, unsigned relation, std::int64_t added,
                                bool rides) const {
    if (!counts_bytes_) return false;
    const bool cumulative = sedp_.piggyback == model::Piggyback::cumulative;
    const std::int64_t sent = state.template get<SentBytes>() + added;
    if (cumulative) state.template set<SentBytes>(sent);
    const std::int64_t budget = state.template get<Budget>(relation) - (cumulative ? sent : added);
    state.template set<Budget>(budget, relation);
    if (budget >= 0) return false;
    refill(state, relation);
    if (cumulative) {
      const model::Bytes heartbeat =
          rides ? sedp_.piggyback_heartbeat_bytes : sedp_.heartbeat_bytes;
      state.template set<SentBytes>(sent + heartbeat.count());
    }
    return true;
  }

  const model::SedpProfile sedp_;
  const unsigned count_;
  const bool counts_bytes_;
  const model::DescriptorSizes sizes_;
};

using PaperWorld = RelationWorld<PaperPacking>;
using SharedPaperWorld = RelationWorld<PaperPacking, 2>;
extern template class RelationWorld<PaperPacking>;
extern template class RelationWorld<PaperPacking, 2>;
extern template class RelationWorld<PaperPacking, most_readers>;
extern template class RelationWorld<PaperPacking, 1, most_writers>;

}  // namespace stormproof::explorer
