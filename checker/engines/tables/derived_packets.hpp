// A kind of packet in a derived system: one variable for each content with which one has been sent
// to or by our relation. What was sent may arrive at any time, any number of times. Numbers that a
// packet says are unknown to its receiver.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "checker/engines/tables/derived.hpp"

namespace stormproof::tables {

/// What a packet says, by field.
using PacketContent = std::vector<std::pair<std::string, bool>>;
/// "sent AckNack Listed" and what that packet says, for each content that it can have.
[[nodiscard]] std::vector<std::pair<std::string, PacketContent>> all_contents(
    const fsm::program::Program& program, fsm::program::Tag packet);

class DerivedPacket {
 public:
  using Says = DerivedTime::Says;

  DerivedPacket(const fsm::program::Program& program, fsm::program::Tag packet, Derived& derived)
      : program_{program}, packet_{packet}, derived_{derived} {}

  void emitted(const Expr& when, const Says& says) const;
  /// What one that arrives says: inputs of the step.
  [[nodiscard]] Says inputs() const;
  /// One has been sent that says this.
  void arrives(const Says& says) const;
  /// The mistake of a bitmap that is read when it arrives: some ACKNACK has been sent, and says
  /// what it would say `now`.
  void arrives_as(const Says& says, const Says& now) const;

 private:
  [[nodiscard]] std::string name() const { return std::string{program_.things[packet_].name}; }
  [[nodiscard]] Derivation& system() const { return derived_.derivation; }
  void forget_if_unsound() const;

  const fsm::program::Program& program_;
  fsm::program::Tag packet_;
  Derived& derived_;
};

}  // namespace stormproof::tables
