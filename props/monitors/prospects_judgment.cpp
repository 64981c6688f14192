// Whether a descriptor that its reader lacks can still get there. The first event on its way is
// enough; each of them, once processed, either delivers or leaves another one behind, or this says
// that nothing is left.
//   DATA under way always counts. Otherwise it depends on what the writer thinks:
//   A  it will not send again (Fast DDS: unless an initial ACKNACK makes it forget);
//   U  a reader that asks: a HEARTBEAT under way or pending, an ACKNACK due or under way that lists
//      it, an initial ACKNACK due while no HEARTBEAT has been seen;
//   R  the pending repair generation (Fast DDS: nack response);
//   Q  the repair that has not left the source (Fast DDS: the pending async run);
//   S  the pending end of the suppression, which arms the HEARTBEAT timer;
//   not created yet (Fast DDS)  the pending creation.
// While the relation is not open on both sides, an announcement must still come.
#include <bit>

#include "props/monitors/prospects.hpp"

namespace stormproof::props {

/// Whether the pair's source may still tell its destination of itself, unasked.
bool Prospects::can_be_announced(std::uint32_t pair) const {
  const model::Pair& ends = topology_->pair(pair);
  const Participant& source = participants_[ends.source];
  if (source.multicasts > 0 || copies_[pair] > 0) return true;
  const bool reaches =
      hears_announcements_[ends.destination] || relations_[2 * ends.reverse].reader_open;
  return source.announcements_due > 0 && reaches;
}

/// Whether the pair's destination may still hear of its source: the source announces itself, or
/// will do so because it hears of the other one.
bool Prospects::can_be_recognised(std::uint32_t pair) const {
  const model::Pair& ends = topology_->pair(pair);
  if (can_be_announced(pair)) return true;
  return participants_[ends.source].announcements_due > 0 && can_be_announced(ends.reverse);
}

/// The relation is not open on both sides: whether it may still open.
bool Prospects::can_open(std::uint32_t relation) const {
  const std::uint32_t pair = relation / 2;
  if (!relations_[relation].reader_open) return can_be_recognised(pair);
  if (!each_side_) return false;  // the writer side opens with the reader side
  const std::uint32_t reverse = topology_->pair(pair).reverse;
  return !relations_[2 * reverse + relation % 2].reader_open && can_be_recognised(reverse);
}

/// Whether the reader will ask for everything that it lacks and the writer has in U.
bool Prospects::will_ask(std::uint32_t relation) const {
  const Relation& rel = relations_[relation];
  if (rel.heartbeats > 0 || rel.acknacks_due > 0) return true;
  const std::uint32_t writer = 2 * topology_->pair(relation / 2).source + relation % 2;
  if (heartbeats_.count(writer) > 0) return true;
  if (rules_.initial_acknack == model::InitialAckNackReply::none) return false;
  const bool replies = rules_.initial_acknack == model::InitialAckNackReply::heartbeat;
  return (rel.initials_due > 0 && !rel.heartbeat_seen) || (replies && rel.initial_acknacks > 0);
}

bool Prospects::forgets_acknowledgments(std::uint32_t relation) const {
  const Relation& rel = relations_[relation];
  return stateful_ && (rel.initial_acknacks > 0 || (rel.initials_due > 0 && !rel.heartbeat_seen));
}

/// Descriptors of word k whose own next step at the writer is pending.
std::uint64_t Prospects::progressing(std::uint32_t relation, std::uint32_t k) const {
  const Relation& rel = relations_[relation];
  const std::uint32_t i = topology_->pair(relation / 2).source;
  std::uint64_t members = 0;
  if (will_ask(relation)) members |= states_[u].word(relation, k);
  const bool repair =
      stateful_ ? writers_[2 * i + relation % 2].responses_due > 0 : rel.repairs_due > 0;
  if (repair) members |= states_[r].word(relation, k);
  const bool rearms = stateful_ || !adaptive_ || heartbeats_.count(2 * i + relation % 2) > 0;
  if (rel.suppressions > 0 && rearms) members |= states_[s].word(relation, k);
  if (participants_[i].async_runs_due > 0) members |= states_[q].word(relation, k);
  if (participants_[i].creations_due > 0) members |= states_[absent].word(relation, k);
  if (forgets_acknowledgments(relation)) members |= states_[a].word(relation, k);
  return members;
}

std::optional<std::uint32_t> Prospects::hopeless(std::uint32_t relation,
                                                 const ReceivedDescriptors& x) const {
  const std::uint32_t count = topology_->descriptor_count(relation);
  const Relation& rel = relations_[relation];
  const bool usable = rel.writer_open && (rel.reader_open || accepts_unmatched_);
  for (std::uint32_t k = 0; k < x.word_count(relation); ++k) {
    std::uint64_t left = RelationWords::below(count, k) & ~x.word(relation, k);
    if (left == 0) continue;
    if (!usable && can_open(relation)) return {};
    if (usable) left &= ~progressing(relation, k);
    for (; left != 0; left &= left - 1) {
      const auto d = 64 * k + static_cast<std::uint32_t>(std::countr_zero(left));
      if (!usable) return d;
      if (data_.at(relation, d) > 0) continue;
      if (states_[u].test(relation, d) && requests_.at(relation, d) > 0) continue;
      if (states_[q].test(relation, d) && sources_.at(relation, d) > 0) continue;
      return d;
    }
  }
  return {};
}

std::string Prospects::situation(std::uint32_t relation, std::uint32_t d) const {
  const Relation& rel = relations_[relation];
  if (!rel.writer_open) return "the writer side is not open";
  if (!rel.reader_open && !accepts_unmatched_) return "the reader side is not open";
  switch (state_of(relation, d)) {
    case u:
      return "the writer has it in U and no reader will ask for it";
    case r:
      return "the writer has it in R and no repair is due";
    case q:
      return "the writer has it in Q and nothing takes it on";
    case s:
      return "the writer has it in S and no suppression ends";
    case a:
      return "the writer takes it as acknowledged";
    case absent:
      break;
  }
  return "the writer does not have it";
}

Prospects::State Prospects::state_of(std::uint32_t relation, std::uint32_t d) const {
  for (const State state : {u, r, q, s, a}) {
    if (states_[state].test(relation, d)) return state;
  }
  return absent;
}

}  // namespace stormproof::props
