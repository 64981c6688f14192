// Counts a run of the model by the rules of a capture: each message at its emission, DATA by its
// key, HEARTBEATs and ACKNACKs by their reason, and all of it over time. A probe, because a run
// itself only keeps its totals at the end.
#pragma once

#include <optional>
#include <set>
#include <tuple>

#include "checker/evidence/validate/figures.hpp"
#include "model/dds_profile.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/submessage.hpp"
#include "model/engine/topology.hpp"
#include "model/implementations.hpp"
#include "model/probe.hpp"
#include "props/monitors/relation_words.hpp"

namespace stormproof::validate {

class MessageTally final : public model::Probe {
 public:
  /// Growth is kept for `steps` steps of `step_ns`.
  MessageTally(const model::DdsProfile& dds, std::int64_t step_ns, std::size_t steps)
      : acknacks_have_bases_{model::traits_of(dds).acknacks_have_bases},
        steps_{steps},
        has_server_{model::traits_of(dds).has_server} {
    growth_.step_ns = step_ns;
  }

  void run_started(const model::Topology& topology) override {
    generated_.reset(topology);
    topology_ = &topology;
  }
  void event_started(const model::Event& event) override;
  void event_finished(const model::Depths& depths) override;
  void received(const model::Packet& packet, std::uint32_t receiver) override;
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override;

  /// Everything that was emitted.
  [[nodiscard]] const Tally& tally() const { return tally_; }
  /// Until the event that emitted the last initial DATA, inclusive; its completion is that time.
  [[nodiscard]] const Tally& at_last_initial() const { return at_last_initial_; }
  /// Fills the steps up to now and all later ones with what was sent; then the growth.
  [[nodiscard]] Growth finish() &&;
  [[nodiscard]] const Sizes& sizes() const { return sizes_; }

 private:
  void add_data(const model::Packet& packet);
  void add_heartbeats(const model::Packet& packet, std::uint64_t copies);
  void add_acknack(const model::Packet& packet);
  void add_acknack(const model::Packet& packet, bool asks, bool is_initial);
  /// False if it is nothing that only a server and its clients send.
  bool add_of_server(const model::Packet& packet);
  void add_relay(const model::Packet& packet);
  void add_relayed(const model::Packet& packet);
  [[nodiscard]] bool is_needed(const model::Packet& packet) const;
  void add_message(const model::Packet& packet);
  [[nodiscard]] std::optional<model::MessageClass> add_submessage(const model::Submessage& m,
                                                                  const model::Packet& packet);
  [[nodiscard]] model::MessageClass add_sample(const model::Submessage& m,
                                               const model::Packet& packet);
  void note_initial();
  void fill_growth(std::int64_t until_ns);

  bool acknacks_have_bases_;
  std::size_t steps_;
  Tally tally_{};
  Tally at_last_initial_{};
  bool emitted_initial_ = false;  ///< in this event, something that had not been sent to somebody
  std::int64_t now_ns_ = 0;
  model::EventKind event_{};
  std::optional<model::PacketKind> incoming_;  ///< what this event receives
  props::RelationWords generated_;
  // Of Cyclone DDS, whose messages mix submessages: DATA by sender or pair, writer and sample.
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;
  std::set<Key> sent_to_group_;
  std::set<Key> sent_to_one_;
  std::set<Key> reached_;  ///< by pair: has been sent to it, to it alone or to the group
  std::set<Key> requested_;
  const bool has_server_;
  const model::Topology* topology_ = nullptr;  ///< of the run
  Growth growth_;
  Sizes sizes_;
};

}  // namespace stormproof::validate
