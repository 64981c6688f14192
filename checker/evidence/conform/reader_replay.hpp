// Replays what was chosen for the ACKNACKs of one relation through the reader's machines, which
// decide whether they send just these.
#pragma once

#include "checker/evidence/conform/reader_side.hpp"
#include "checker/evidence/conform/reply_search.hpp"

namespace stormproof::conform {

class ReaderReplay {
 public:
  ReaderReplay(const Dialogue& dialogue, const Relation& relation, const model::SedpProfile& sedp,
               const Bounds& bounds, ReaderMachines& machines, Tally<fsm::SingleShot>& timers,
               Ledger& ledger)
      : dialogue_{dialogue},
        relation_{relation},
        sedp_{sedp},
        bounds_{bounds},
        machines_{machines},
        timers_{timers},
        ledger_{ledger} {}

  /// The reader side opens. Returns the delay until the first initial ACKNACK, ns; 0: there is
  /// none.
  std::int64_t open(std::int64_t now);
  /// An initial ACKNACK is sent, `delay` ns after the one before it or the opening. Returns the
  /// next delay.
  std::int64_t attempt(const Answer& answer, std::int64_t delay);
  /// The chosen submessages arrive, in order, and the reply is generated.
  void reply(const Answer& answer, const Choice& choice);
  /// The attempt that finds that a HEARTBEAT was seen.
  void finish();

  [[nodiscard]] bool is_open() const { return is_open_; }
  [[nodiscard]] std::int64_t opened_ns() const { return opened_ns_; }
  /// Submessages that have arrived or are lost.
  [[nodiscard]] std::size_t consumed() const { return consumed_; }
  [[nodiscard]] const Knowledge& knowledge() const { return knowledge_; }

 private:
  void confirm(bool replayed, Rule rule);
  void miss(const Submessage& message);
  bool receive(const Submessage& message);
  [[nodiscard]] bool says(const Answer& answer) const;
  [[nodiscard]] bool is_constant() const;
  [[nodiscard]] std::int64_t missing() const;

  const Dialogue& dialogue_;
  const Relation& relation_;
  const model::SedpProfile& sedp_;
  const Bounds& bounds_;
  ReaderMachines& machines_;
  Tally<fsm::SingleShot>& timers_;
  Ledger& ledger_;

  bool is_open_ = false;
  std::int64_t opened_ns_ = 0;
  fsm::StateId state_ = Tally<fsm::DiscoveryReader>::Fly::initial;
  fsm::StateId initial_state_ = Tally<fsm::InitialAckNack>::Fly::initial;
  std::optional<std::uint32_t> missed_;  ///< the last datagram that did not arrive
  std::size_t consumed_ = 0;
  Knowledge knowledge_{};
  std::int64_t last_reception_ns_ = INT64_MIN / 2;
  std::int64_t last_reply_ns_ = INT64_MIN / 2;
};

}  // namespace stormproof::conform
