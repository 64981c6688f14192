// What is under way in a run, relation by relation: the packets, the pending timers, the states of
// the writer and X. live.no-stall asks it whether something can still bring a descriptor to a
// reader that lacks it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/engine/packet.hpp"
#include "model/implementations.hpp"
#include "model/scenario.hpp"
#include "model/trace/selection.hpp"
#include "props/monitors/pending_heartbeats.hpp"
#include "props/monitors/received_descriptors.hpp"
#include "props/monitors/relation_words.hpp"

namespace stormproof::props {

class Prospects {
 public:
  /// It need not be told of other timers, nor of packets of control-only relations.
  static constexpr auto selection =
      model::trace::Selection{}
          .only({model::Report::event_started},
                {model::EventKind::acknack_generation, model::EventKind::initial_acknack_due,
                 model::EventKind::repair_generation, model::EventKind::suppression_end,
                 model::EventKind::nack_response, model::EventKind::heartbeat_expiry,
                 model::EventKind::cycle_start, model::EventKind::cycle_end,
                 model::EventKind::announcement_due, model::EventKind::endpoint_creation,
                 model::EventKind::async_run})
          .only({model::Report::scheduled},
                {model::EventKind::acknack_generation, model::EventKind::initial_acknack_due,
                 model::EventKind::repair_generation, model::EventKind::suppression_end,
                 model::EventKind::nack_response, model::EventKind::heartbeat_expiry,
                 model::EventKind::cycle_start, model::EventKind::cycle_end,
                 model::EventKind::announcement_due, model::EventKind::endpoint_creation,
                 model::EventKind::async_run, model::EventKind::source_completion,
                 model::EventKind::reception, model::EventKind::delayed_reception});

  explicit Prospects(const model::Scenario& scenario);

  // The probe's reports.
  void run_started(const model::Topology& topology);
  void event_started(const model::Event& event);
  void transition(const model::Transition& fired);
  void scheduled(std::uint64_t insertion, model::EventKind kind, std::uint32_t subject);
  void rescheduled(const model::Event& event, std::uint64_t insertion) {
    heartbeats_.rescheduled(event, insertion);
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations);
  void source_completed(const model::Packet& packet);
  void arrived(const model::Packet& packet, bool lost);
  void received(const model::Packet& packet, std::uint32_t receiver);
  /// Nothing more follows from what has happened in this event.
  void event_ended();
  /// Whether that has to be told.
  [[nodiscard]] bool expects_end() const {
    return is_touched() || delivered_ != nullptr || !departing_.pairs.empty();
  }

  [[nodiscard]] bool is_touched() const { return !touched_.empty(); }
  /// Relations of which something may have got lost since the last call; each once. They are there
  /// until the next one.
  [[nodiscard]] const std::vector<std::uint32_t>& take_touched();
  void touch_all();

  /// A descriptor that the relation's reader lacks (X) and that nothing can bring to it any more.
  [[nodiscard]] std::optional<std::uint32_t> hopeless(std::uint32_t relation,
                                                      const ReceivedDescriptors& x) const;
  /// In which state the writer has the descriptor, and whether the relation is open.
  [[nodiscard]] std::string situation(std::uint32_t relation, std::uint32_t d) const;

 private:
  enum State : std::uint8_t { absent, u, r, q, s, a };
  static constexpr std::size_t state_count = 6;

  struct Relation {
    std::uint32_t acknacks_due = 0;
    std::uint32_t initials_due = 0;
    std::uint32_t repairs_due = 0;
    std::uint32_t suppressions = 0;
    std::uint32_t heartbeats = 0;        // under way
    std::uint32_t initial_acknacks = 0;  // under way
    bool writer_open = false;
    bool reader_open = false;
    bool heartbeat_seen = false;
    bool touched = false;
  };
  struct Writer {
    std::uint32_t responses_due = 0;  // Fast DDS's nack response
  };
  struct Participant {
    std::uint32_t announcements_due = 0;
    std::uint32_t creations_due = 0;
    std::uint32_t async_runs_due = 0;
    std::uint32_t multicasts = 0;  // SPDP, under way
  };
  /// What a packet can do at its receiver.
  struct Load {
    model::PacketKind kind{};
    std::uint32_t pair = 0;
    std::uint32_t stream = 0;
    bool heartbeat = false;
    bool initial = false;
    bool from_repair = false;
    const model::DescriptorSet* descriptors = nullptr;
    [[nodiscard]] std::uint32_t relation() const { return 2 * pair + stream; }
  };
  /// An emission whose receptions are about to be scheduled (constant delay).
  struct Departing {
    Load load;
    model::DescriptorSet descriptors;
    std::vector<std::uint32_t> pairs;
    std::uint64_t number = 0;
    std::size_t completions = 0;
    std::size_t receptions = 0;
  };

  static State state_named(std::string_view name);
  static Load load_of(const model::Packet& packet);
  void count(model::EventKind kind, std::uint32_t subject, std::uint32_t change);
  void move(const Load& load, std::uint32_t change);
  void in_source(const Load& load, std::uint32_t change);
  [[nodiscard]] bool is_lost(std::uint64_t number) const;
  void touch(std::uint32_t relation);
  void touch_writer(std::uint32_t writer);
  void touch_participant(std::uint32_t participant);
  [[nodiscard]] bool can_be_announced(std::uint32_t pair) const;
  [[nodiscard]] bool can_be_recognised(std::uint32_t pair) const;
  [[nodiscard]] bool can_open(std::uint32_t relation) const;
  [[nodiscard]] bool will_ask(std::uint32_t relation) const;
  [[nodiscard]] bool forgets_acknowledgments(std::uint32_t relation) const;
  [[nodiscard]] std::uint64_t progressing(std::uint32_t relation, std::uint32_t k) const;
  [[nodiscard]] State state_of(std::uint32_t relation, std::uint32_t d) const;

  const model::ImplementationTraits& traits_;
  const model::RelationRules rules_;
  bool stateful_;
  bool constant_delay_;
  bool each_side_;
  bool accepts_unmatched_;
  bool adaptive_;
  std::vector<bool> hears_announcements_;  // to everybody; by participant
  std::vector<std::uint64_t> lost_packets_;
  std::optional<model::Topology> topology_;  // a copy: asked after the run, too

  const model::Packet* delivered_ = nullptr;  // arrived; its receptions are being scheduled
  Departing departing_;
  PendingHeartbeats heartbeats_;
  std::array<RelationWords, state_count> states_;
  RelationValues<std::uint16_t> data_;      // packets under way with the descriptor
  RelationValues<std::uint16_t> requests_;  // ACKNACKs under way that list it
  RelationValues<std::uint16_t> sources_;   // its repairs that have not left the source
  std::vector<Relation> relations_;
  std::vector<Writer> writers_;
  std::vector<Participant> participants_;
  std::vector<std::uint32_t> copies_;  // by pair: SPDP unicast copies under way
  std::vector<std::uint32_t> touched_;
  std::vector<std::uint32_t> taken_;  // of them, last
};

}  // namespace stormproof::props
