// A walk from the violating event backwards.
#include "checker/verification/counterexample/relevance.hpp"

#include <algorithm>

#include "model/trace/event_subject.hpp"

namespace stormproof::counterexample {

namespace {

using model::MachineRef;
using model::trace::Subject;
using model::trace::subject_of;
using Transition = model::trace::TransitionList::Entry;

bool of_relation(const Transition& transition) {
  return transition.machine.kind == MachineRef::Kind::relation;
}

std::uint32_t relation_of_packet(const History& history, std::uint64_t packet) {
  const auto found = history.packets.find(packet);
  return found == history.packets.end() ? no_relation : found->second.relation;
}

/// The relations that an event is about. Its subject says it best, then what changes, then what is
/// received, then what is sent; a writer stands for all of its relations.
std::set<std::uint32_t> relations_of(const Step& step, const History& history) {
  const Subject subject = subject_of(step.event.kind);
  if (subject == Subject::relation) return {step.event.subject};
  std::set<std::uint32_t> found;
  for (const Transition& transition : step.transitions) {
    if (of_relation(transition)) found.insert(transition.machine.subject);
  }
  if (!found.empty()) return found;
  for (const auto& packet : {step.arrived, step.left_source, step.served}) {
    if (packet) found.insert(relation_of_packet(history, *packet));
  }
  if (found.empty() && subject == Subject::writer) {
    const std::uint32_t participant = step.event.subject / 2;
    for (std::uint32_t pair = history.topology.first_pair(participant);
         pair < history.topology.first_pair(participant + 1); ++pair) {
      found.insert(2 * pair + step.event.subject % 2);
    }
  }
  if (found.empty()) {
    for (const std::uint64_t packet : step.emitted) {
      found.insert(relation_of_packet(history, packet));
    }
  }
  found.erase(no_relation);
  return found;
}

class Walk {
 public:
  explicit Walk(const History& history) : history_{history} {
    relevance_.steps.assign(history.steps.size(), false);
    relevance_.essential.assign(history.steps.size(), false);
  }

  Relevance run() && {
    if (history_.steps.empty()) return std::move(relevance_);
    relevance_.relations = relations_of(history_.violating(), history_);
    for (std::size_t n = 0; n < history_.steps.size(); ++n) {
      if (touches(history_.steps[n])) reach(n);
    }
    reach(history_.steps.size() - 1);
    while (!open_.empty()) {
      const std::size_t n = open_.back();
      open_.pop_back();
      follow(history_.steps[n]);
    }
    for (const auto& [number, packet] : history_.packets) {
      if (relevance_.concerns(packet.relation)) relevance_.packets.insert(number);
    }
    mark_essential();
    relevance_.count = static_cast<std::size_t>(std::ranges::count(relevance_.steps, true));
    return std::move(relevance_);
  }

 private:
  void mark_essential() {
    for (std::size_t n = 0; n < history_.steps.size(); ++n) {
      relevance_.essential[n] = relevance_.steps[n] && moves(history_.steps[n]);
    }
    constexpr int longest_chain = 12;
    std::size_t n = history_.steps.size() - 1;
    for (int k = 0; k < longest_chain; ++k) {
      relevance_.essential[n] = true;
      const Step& step = history_.steps[n];
      const auto packet = step.receptions.empty() ? (step.arrived ? step.arrived : step.left_source)
                                                  : std::optional{step.receptions.back().packet};
      if (packet)
        n = history_.packets.at(*packet).emitted;
      else if (step.cause && subject_of(step.event.kind) != Subject::channel)
        n = *step.cause;
      else
        break;
    }
  }
  /// Whether DATA moves on the relations, or a machine of theirs changes its state.
  [[nodiscard]] bool moves(const Step& step) const {
    const auto is_data = [&](std::uint64_t number) {
      return on_relation(number) &&
             history_.packets.at(number).label.find("DATA") != std::string::npos;
    };
    const auto brings_data = [&](const auto& reception) { return is_data(reception.packet); };
    return std::ranges::any_of(step.receptions, brings_data) ||
           (step.arrived && is_data(*step.arrived)) || std::ranges::any_of(step.emitted, is_data) ||
           std::ranges::any_of(step.transitions, [&](const Transition& transition) {
             return of_relation(transition) && relevance_.concerns(transition.machine.subject);
           });
  }

  [[nodiscard]] bool on_relation(std::uint64_t packet) const {
    return relevance_.concerns(relation_of_packet(history_, packet));
  }
  [[nodiscard]] bool touches(const Step& step) const {
    const Subject subject = subject_of(step.event.kind);
    if (subject == Subject::relation && relevance_.concerns(step.event.subject)) return true;
    if (subject == Subject::writer && is_its_writer(step.event.subject)) return true;
    if (step.arrived && on_relation(*step.arrived)) return true;
    const auto received = [&](const auto& reception) { return on_relation(reception.packet); };
    if (std::ranges::any_of(step.receptions, received)) return true;
    return std::ranges::any_of(step.emitted, [&](auto p) { return on_relation(p); }) ||
           std::ranges::any_of(step.transitions, [&](const Transition& transition) {
             return of_relation(transition) && relevance_.concerns(transition.machine.subject);
           });
  }
  [[nodiscard]] bool is_its_writer(std::uint32_t writer) const {
    return std::ranges::any_of(relevance_.relations, [&](std::uint32_t relation) {
      return writer == 2 * history_.topology.pair(relation / 2).source + relation % 2;
    });
  }

  void reach(std::size_t n) {
    if (relevance_.steps[n]) return;
    relevance_.steps[n] = true;
    open_.push_back(n);
  }
  void reach_packet(const std::optional<std::uint64_t>& number) {
    if (!number) return;
    const auto packet = history_.packets.find(*number);
    if (packet == history_.packets.end()) return;
    relevance_.packets.insert(*number);
    reach(packet->second.emitted);
  }
  /// What led to the step. What a channel did before does not say why it serves a packet now; the
  /// emission of the packet does.
  void follow(const Step& step) {
    reach_packet(step.arrived);
    for (const Step::Reception& reception : step.receptions) reach_packet(reception.packet);
    reach_packet(step.left_source);
    const bool channel = subject_of(step.event.kind) == Subject::channel;
    if (channel)
      reach_packet(step.served);
    else if (step.cause)
      reach(*step.cause);
  }

  const History& history_;
  Relevance relevance_;
  std::vector<std::size_t> open_;
};

}  // namespace

Relevance relevance_of(const History& history) { return Walk{history}.run(); }

std::uint32_t owner_of(const Transition& transition, const Step& step, const History& history) {
  const std::uint32_t subject = transition.machine.subject;
  switch (transition.machine.kind) {
    case MachineRef::Kind::participant:
      return subject;
    case MachineRef::Kind::writer:
      return subject / 2;
    case MachineRef::Kind::relation:
      break;
    case MachineRef::Kind::pair:
      return history.topology.pair(subject).source;
    case MachineRef::Kind::channel:
    case MachineRef::Kind::control_relation:
    case MachineRef::Kind::control_writer:
    case MachineRef::Kind::endpoint_relation:
    case MachineRef::Kind::endpoint_writer:
      return to_everybody;
  }
  const model::Pair& pair = history.topology.pair(subject / 2);
  const std::string_view machine = transition.machine.machine;
  if (machine == "DiscoveryReader" || machine == "InitialAckNack") return pair.destination;
  if (machine != "SingleShot") return pair.source;
  // The suppression of a relation is its writer's, the delay of its ACKNACKs its reader's.
  if (step.event.kind == model::EventKind::acknack_generation) return pair.destination;
  const bool read = std::ranges::any_of(step.receptions, [&](const Step::Reception& reception) {
    return reception.receiver == pair.destination;
  });
  return read ? pair.destination : pair.source;
}

}  // namespace stormproof::counterexample
