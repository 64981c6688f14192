// Replays a plan of requests and transmissions of one relation through the writer's rules and
// machines (writer_host.hpp), which decide whether each transmission is what they would send.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "checker/evidence/conform/replayed.hpp"
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
             Ledger& ledger);

  /// Writes into the ledger what the machines confirm. Returns an ACKNACK that must have arrived
  /// and is not answered, if nothing may be lost. `lag`: from a serialization to its capture, ns.
  [[nodiscard]] const Answer* run(const Plan& plan, std::int64_t lag);

 private:
  struct Step {
    std::int64_t time_ns = 0;
    bool is_transmission = false;
    std::size_t index = 0;
  };

  /// False: it must have arrived, and is not answered.
  bool arrive(const Step& step, const Arrival& arrival);
  /// Whether it asks for something unacknowledged that is never sent again.
  [[nodiscard]] bool is_unanswered(const Answer& answer, std::int64_t now) const;
  void transmit(const Step& step, bool to_everybody);

  const WriterContext& context_;
  const Relation& relation_;
  const std::vector<Transmission>& transmissions_;
  std::uint32_t existing_;
  Ledger& ledger_;
  const std::uint32_t count_;  ///< descriptors
  std::unique_ptr<ReplayedWriter> host_;
};

}  // namespace stormproof::conform
