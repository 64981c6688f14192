// Cyclone DDS whose participants have a life, as a host of its rules
// (fsm/composition/cyclone_life.hpp, specs/guide/cyclone.md).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/cyclone/living_steps.hpp"
#include "model/cyclone/protocol.hpp"

namespace stormproof::model::cyclone {

/// What is due for a side that closes is cancelled.
struct LivingColumns : Columns {
  using Columns::column;
  static way::Insertions column(rules::AckTime);
  static way::Insertions column(rules::ReplyTime);
  // What a reader side has may be forgotten, in any order of samples.
  static way::Bits column(rules::Gone);
};

class LivingProtocol final : public ProtocolOf<LivingProtocol, rules::CycloneLiving, LivingColumns,
                                               LivingSteps<LivingProtocol>> {
  using Below =
      ProtocolOf<LivingProtocol, rules::CycloneLiving, LivingColumns, LivingSteps<LivingProtocol>>;

 public:
  LivingProtocol(RunState& run, Network& network) : Below{run, network} { begin_liveliness(); }

  void start() override;
  void handle(const Event& event) override;
  void received(const model::Packet& packet, Number receiver) override;
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override {
    return completion().missing(limit);
  }

  // The host of a RunningWorld.
  template <class P>
  void renew(P part, Number n) {
    state(part, n) = fsm::Stepper<typename P::Machine>::initial;
  }
  void changed(rules::WriterOpen open, Number relation, bool matched) {
    LivingSteps::changed(open, relation, matched);
    if (!matched) sender_.forget(relation);
  }
  using Below::assign_word;
  void assign_word(comp::X, Number relation, Number k, std::uint64_t received) {
    Stored::assign_word(comp::X{}, relation, k, received);
  }

  // What steps ask of it.
  void send_copy(Number i, Number to);
};

extern template class ProtocolOf<LivingProtocol, rules::CycloneLiving, LivingColumns,
                                 LivingSteps<LivingProtocol>>;

}  // namespace stormproof::model::cyclone
