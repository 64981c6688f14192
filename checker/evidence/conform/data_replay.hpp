// Replays a plan of requests and transmissions of one relation through the descriptors' machines,
// which decide whether each transmission is what they would send.
#pragma once

#include <optional>
#include <vector>

#include "checker/evidence/conform/requests.hpp"
#include "checker/evidence/conform/writer_side.hpp"

namespace stormproof::conform {

/// When the ACKNACKs of a relation arrive, and which of them asks for each transmission; nothing
/// for those that are pushed.
struct Plan {
  std::vector<Arrival> arrivals{};
  std::vector<std::optional<std::size_t>> request{};
  std::vector<bool> to_everybody{};  ///< transmissions that nobody asked for here
};

class DataReplay {
 public:
  /// `existing`: how many descriptors there were when the relation opened.
  DataReplay(const WriterContext& context, const Relation& relation,
             const std::vector<Transmission>& transmissions, std::uint32_t existing,
             Tally<fsm::ChangeForReader>& changes, Tally<fsm::SingleShot>& timers, Ledger& ledger)
      : context_{context},
        relation_{relation},
        transmissions_{transmissions},
        existing_{existing},
        changes_{changes},
        timers_{timers},
        ledger_{ledger} {}

  /// Writes into the ledger what the machines confirm. Returns an ACKNACK that must have arrived
  /// and is not answered, if nothing may be lost. `lag`: from a serialization to its capture, ns.
  [[nodiscard]] const Answer* run(const Plan& plan, std::int64_t lag);

 private:
  struct Step {
    std::int64_t time_ns = 0;
    bool is_transmission = false;
    std::size_t index = 0;
  };

  void open();
  [[nodiscard]] std::size_t known() const;
  /// False: it must have arrived, and is not answered.
  bool arrive(const Step& step, const Arrival& arrival);
  /// Whether it asks for something unacknowledged that is never sent again.
  [[nodiscard]] bool is_unanswered(const Answer& answer, std::int64_t now) const;
  void transmit(const Step& step, bool to_everybody);
  void end_suppression(std::int64_t now);

  const WriterContext& context_;
  const Relation& relation_;
  const std::vector<Transmission>& transmissions_;
  std::uint32_t existing_;
  Tally<fsm::ChangeForReader>& changes_;
  Tally<fsm::SingleShot>& timers_;
  Ledger& ledger_;
  std::vector<fsm::StateId> states_;
  fsm::StateId response_ = Tally<fsm::SingleShot>::Fly::initial;
  fsm::StateId suppression_ = Tally<fsm::SingleShot>::Fly::initial;
  std::int64_t suppressed_until_ns_ = INT64_MAX;
};

}  // namespace stormproof::conform
