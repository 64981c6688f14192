// A composition as plain data: what there is, and every effect of every rule. Diagrams, pages and
// checks of completeness read this, and need nothing of Boost.MSM for it; it is what the recorded
// program (fsm/program) says in words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fsm/composition/effect_mutation.hpp"

namespace stormproof::fsm::composition {

/// A machine in its place.
struct PartInfo {
  std::string_view name;
  std::string_view machine;
  std::string_view owner;
  std::vector<std::string_view> events;  ///< of the machine
  std::vector<std::string_view> outbox;  ///< field names
};

/// A timer, a flag or number, or a packet.
struct ThingInfo {
  std::string_view name;
  std::string_view owner;
};

/// A condition or loop around an effect. Effects of one block stand in the same place.
struct BlockInfo {
  std::string text;
  unsigned number = 0;             ///< within the rule
  std::string_view kind = "when";  ///< or "for"
  EffectKey key{};
};

struct EffectInfo {
  std::string id;           ///< "AckNackArrives.3"
  std::string_view kind;    ///< feed, feed each, renew, set, set each, after, at, cancel, emit,
                            ///< raise, call, perform
  std::string_view target;  ///< the part, flag, timer, packet, occasion, procedure or step
  std::string_view owner;   ///< of the target
  std::string detail;       ///< the event, value, delay or contents
  std::vector<BlockInfo> blocks;  ///< outermost first
  std::string_view file;          ///< where it is written
  unsigned line = 0;
  EffectKey key{};
};

struct RuleInfo {
  std::string id;            ///< the rule's name; of a procedure with its argument
  std::string_view trigger;  ///< received, left, due, happens
  std::string_view cause;    ///< the packet, timer or occasion
  std::string_view owner;
  std::vector<EffectInfo> effects;
};

/// An outbox field or event that has no use, and why.
struct UnusedInfo {
  std::string_view part;
  std::string_view name;
  std::string_view reason;
};

/// An occasion or timer that is not the rules' doing, or not at first, and whose it is.
struct FromOutsideInfo {
  std::string_view name;
  std::string_view reason;
};

struct CompositionInfo {
  std::string_view name;
  std::vector<PartInfo> parts;
  std::vector<ThingInfo> timers;
  std::vector<ThingInfo> state;
  std::vector<ThingInfo> packets;
  std::vector<ThingInfo> occasions;
  std::vector<RuleInfo> rules;
  std::vector<RuleInfo> procedures;  ///< without triggers
  std::vector<RuleInfo> steps;       ///< contracts of the opaque steps, without triggers
  std::vector<std::pair<std::string_view, std::string>> facts;  ///< and their definitions
  std::vector<std::string> consumed;  ///< outbox fields that something reads, "Reader.opened"
  std::vector<UnusedInfo> unused;
  std::vector<FromOutsideInfo> from_outside;
};

/// "AckNackArrives.3 at fsm/composition/paper.hpp:181".
[[nodiscard]] std::string place_of(const EffectInfo& effect);

/// Something that a composition forgets.
struct Forgotten {
  std::string what;      ///< one sentence: "nothing reads C.requested"
  std::string where;     ///< the effect that one looks at first; empty: there is none
  std::string expected;  ///< what would be complete
};

/// What is forgotten: an outbox field that nothing reads, an event that nothing feeds, a timer that
/// nothing else than itself starts or that no rule handles, a packet that nobody emits or receives,
/// an occasion without a rule or a cause, state that nothing sets; and reasons that are not needed.
[[nodiscard]] std::vector<Forgotten> what_is_forgotten(const CompositionInfo& composition);

}  // namespace stormproof::fsm::composition
