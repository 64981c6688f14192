// Words of the protocol for events, packets and state changes.
#include "checker/verification/counterexample/acts.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "model/trace/event_subject.hpp"
#include "model/trace/perfetto_labels.hpp"

namespace stormproof::counterexample {

const char* stream_name(std::uint32_t number) { return number % 2 == 0 ? "pub" : "sub"; }

namespace {

using model::EventKind;
using model::trace::Subject;
using model::trace::subject_of;
using Transition = model::trace::TransitionList::Entry;

std::string relation_name(const History& history, std::uint32_t relation) {
  const model::Pair& pair = history.topology.pair(relation / 2);
  return fmt::format("{}→{} {}", pair.source, pair.destination, stream_name(relation));
}

/// Whose event it is; nobody's for events of the network.
std::optional<std::uint32_t> participant_of(const model::Event& event, const History& history) {
  switch (subject_of(event.kind)) {
    case Subject::participant:
      return event.subject;
    case Subject::writer:
      return event.subject / 2;
    case Subject::relation: {
      const model::Pair& pair = history.topology.pair(event.subject / 2);
      const bool reads = event.kind == EventKind::acknack_generation ||
                         event.kind == EventKind::initial_acknack_due;
      return reads ? pair.destination : pair.source;
    }
    case Subject::pair:
      return history.topology.pair(event.subject).source;
    case Subject::channel:
    case Subject::control_relation:
    case Subject::control_writer:
    case Subject::endpoint_relation:
    case Subject::endpoint_writer:
    case Subject::access_point:
    case Subject::packet:
      return std::nullopt;
  }
  return std::nullopt;
}

std::string subject_name(EventKind kind, std::uint32_t subject, const History& history) {
  switch (subject_of(kind)) {
    case Subject::relation:
      return " " + relation_name(history, subject);
    case Subject::writer:
      return fmt::format(" {} writer", stream_name(subject));
    default:
      return "";
  }
}

/// "ACKNACK 1→0 pub, lacks 0–9": a packet without its number.
std::string packet_words(const PacketLog& packet) {
  std::string text = fmt::format("{} {}→", packet.label, packet.from);
  text += packet.to == to_everybody ? "all" : fmt::format("{}", packet.to);
  if (packet.relation != no_relation) text += fmt::format(" {}", stream_name(packet.relation));
  if (!packet.content.empty()) text += ", " + packet.content;
  return text;
}

class Narrator {
 public:
  Narrator(const History& history, std::size_t number, const Relevance& relevance)
      : history_{history},
        step_{history.steps[number]},
        relevance_{relevance},
        violating_{number + 1 == history.steps.size()} {}

  std::vector<Act> run() && {
    tell_event();
    tell_left_source();
    tell_arrival();
    for (const Transition& transition : step_.transitions) tell(transition);
    tell_emissions();
    for (const Step::Timer& timer : step_.timers) tell(timer);
    if (acts_.empty()) tell_channel();
    gather_parties();
    return std::move(acts_);
  }

 private:
  void add(Act::Kind kind, std::uint32_t who, std::string text,
           std::vector<std::uint64_t> packets = {}, std::string effect = {}) {
    acts_.push_back({kind, who, std::move(packets), std::move(text), std::move(effect), false});
  }

  /// The acts of one party stand together, parties in the order of their first act.
  void gather_parties() {
    std::vector<std::pair<bool, std::uint32_t>> parties;
    const auto rank = [&](const Act& act) {
      const bool network = act.kind == Act::Kind::channel || act.kind == Act::Kind::lost;
      const auto found = std::ranges::find(parties, std::pair{network, act.who});
      if (found == parties.end()) parties.emplace_back(network, act.who);
      return std::ranges::find(parties, std::pair{network, act.who}) - parties.begin();
    };
    for (const Act& act : acts_) rank(act);
    std::ranges::stable_sort(acts_, {}, rank);
  }

  void tell_event() {
    const auto who = participant_of(step_.event, history_);
    if (!who) return;
    add(Act::Kind::timer, *who,
        model::trace::timer_label(step_.event.kind) +
            subject_name(step_.event.kind, step_.event.subject, history_));
  }

  void tell_left_source() {
    if (!step_.left_source || !relevance_.packets.contains(*step_.left_source)) return;
    const bool matters = violating_ || std::ranges::any_of(step_.transitions, [](const auto& t) {
                           return t.before == "Q" && t.after == "S";
                         });
    if (!matters) return;
    const std::uint64_t number = *step_.left_source;
    const PacketLog& packet = history_.packets.at(number);
    add(Act::Kind::change, packet.from,
        fmt::format("p{} {} has left the source", number, packet.label));
  }

  void tell_arrival() {
    if (step_.arrived && history_.packets.at(*step_.arrived).lost) {
      const std::uint64_t number = *step_.arrived;
      const std::uint32_t channel =
          subject_of(step_.event.kind) == Subject::channel ? step_.event.subject : 0;
      add(Act::Kind::lost, channel, packet_text(history_, number) + " is lost", {number});
    }
    for (const Step::Reception& reception : step_.receptions) {
      const PacketLog& packet = history_.packets.at(reception.packet);
      std::string text = "receives " + packet_text(history_, reception.packet);
      if (!reception.news.empty()) text += " (" + reception.news + ")";
      if (reception.receiver != model::Probe::everybody) {
        add(Act::Kind::received, reception.receiver, text, {reception.packet});
        continue;
      }
      for (const std::uint32_t receiver : concerned_receivers(packet)) {
        add(Act::Kind::received, receiver, text, {reception.packet});
      }
    }
  }

  /// Who of all that a multicast reaches changes anything that matters.
  [[nodiscard]] std::vector<std::uint32_t> concerned_receivers(const PacketLog& packet) const {
    std::vector<std::uint32_t> receivers;
    const auto note = [&](std::uint32_t who) {
      const bool known = std::ranges::find(receivers, who) != receivers.end();
      if (!known && who != to_everybody && who != packet.from) receivers.push_back(who);
    };
    for (const Transition& transition : step_.transitions) {
      if (matters(transition)) note(owner_of(transition, step_, history_));
    }
    if (!receivers.empty()) return receivers;
    for (const std::uint64_t number : step_.emitted) {
      if (relevance_.packets.contains(number)) note(history_.packets.at(number).from);
    }
    return receivers;
  }

  [[nodiscard]] bool matters(const Transition& transition) const {
    const std::uint32_t subject = transition.machine.subject;
    switch (transition.machine.kind) {
      case model::MachineRef::Kind::relation:
        return relevance_.concerns(subject);
      case model::MachineRef::Kind::writer:
        return is_its_writer(subject);
      case model::MachineRef::Kind::participant:
      case model::MachineRef::Kind::channel:
      case model::MachineRef::Kind::control_relation:
      case model::MachineRef::Kind::control_writer:
      case model::MachineRef::Kind::pair:
      case model::MachineRef::Kind::endpoint_relation:
      case model::MachineRef::Kind::endpoint_writer:
        return false;
    }
    return false;
  }
  [[nodiscard]] bool is_its_writer(std::uint32_t writer) const {
    return std::ranges::any_of(relevance_.relations, [&](std::uint32_t relation) {
      return writer == 2 * history_.topology.pair(relation / 2).source + relation % 2;
    });
  }

  void tell(const Transition& transition) {
    if (!matters(transition)) return;
    const std::uint32_t owner = owner_of(transition, step_, history_);
    const std::uint32_t subject = transition.machine.subject;
    std::string text;
    if (transition.machine.kind == model::MachineRef::Kind::relation)
      text = relation_name(history_, subject);
    else if (transition.machine.kind == model::MachineRef::Kind::writer)
      text = fmt::format("{} writer", stream_name(subject));
    if (transition.words.empty())
      text += fmt::format(" {}", transition.machine.machine);
    else
      text += " " + members_text(transition.words);
    text += fmt::format(": {}→{}", transition.before, transition.after);
    add(Act::Kind::change, owner, text);
  }

  void tell_emissions() {
    std::map<std::uint32_t, std::size_t> others;     // by source
    std::vector<std::vector<std::uint64_t>> groups;  // that differ in their numbers only
    for (const std::uint64_t number : step_.emitted) {
      if (!relevance_.packets.contains(number)) {
        ++others[history_.packets.at(number).from];
        continue;
      }
      const auto alike = std::ranges::find_if(groups, [&](const auto& group) {
        const PacketLog& known = history_.packets.at(group.front());
        const PacketLog& packet = history_.packets.at(number);
        return packet_words(known) == packet_words(packet) && known.effect == packet.effect;
      });
      if (alike == groups.end())
        groups.push_back({number});
      else
        alike->push_back(number);
    }
    gather_series(groups);
    for (const auto& group : groups) {
      const PacketLog& packet = history_.packets.at(group.front());
      add(Act::Kind::sent, packet.from, sending(group), group, packet.effect);
    }
    if (acts_.empty()) return;
    for (const auto& [source, count] : others) {
      add(Act::Kind::change, source,
          fmt::format("sends {} other packet{}", count, count == 1 ? "" : "s"));
      acts_.back().aside = true;
    }
  }

  /// Groups that differ in their contents alone become one if they are many: the repairs of a long
  /// list are one thing that happens.
  void gather_series(std::vector<std::vector<std::uint64_t>>& groups) const {
    const auto kind = [&](const std::vector<std::uint64_t>& group) {
      const PacketLog& packet = history_.packets.at(group.front());
      return std::tie(packet.label, packet.from, packet.to, packet.relation, packet.effect);
    };
    for (std::size_t k = 0; k < groups.size(); ++k) {
      const auto alike = [&](const auto& group) { return kind(group) == kind(groups[k]); };
      const auto later = groups.begin() + static_cast<std::ptrdiff_t>(k) + 1;
      if (static_cast<std::size_t>(std::count_if(later, groups.end(), alike)) < listed) continue;
      for (auto group = later; group != groups.end(); ++group) {
        if (alike(*group)) groups[k].insert(groups[k].end(), group->begin(), group->end());
      }
      groups.erase(std::remove_if(later, groups.end(), alike), groups.end());
    }
  }

  [[nodiscard]] std::string sending(const std::vector<std::uint64_t>& group) const {
    if (group.size() == 1) return "sends " + packet_text(history_, group.front());
    const PacketLog& last = history_.packets.at(group.back());
    std::string words = packet_words(history_.packets.at(group.front()));
    if (last.content != history_.packets.at(group.front()).content) words += " … " + last.content;
    if (group.front() >= first_local) {
      return fmt::format("sends {} × {} on its host", group.size(), words);
    }
    std::string text = "sends ";
    for (std::size_t k = 0; k < std::min(group.size(), listed); ++k) {
      text += fmt::format("{}p{}", k == 0 ? "" : ", ", group[k]);
    }
    if (group.size() > listed) text += fmt::format(" and {} more", group.size() - listed);
    return text + ": " + words;
  }

  void tell(const Step::Timer& timer) {
    const model::Event event{timer.due, 0, timer.subject, 0, timer.kind};
    const auto who = participant_of(event, history_);
    if (!who) return;
    const Subject subject = subject_of(timer.kind);
    const bool relevant = (subject == Subject::relation && relevance_.concerns(timer.subject)) ||
                          (subject == Subject::writer && is_its_writer(timer.subject)) ||
                          subject == Subject::participant;
    if (!relevant || timer.kind == EventKind::announcement_due) return;
    std::string label = model::trace::timer_label(timer.kind);
    if (label.ends_with(" due")) label.resize(label.size() - 4);
    add(Act::Kind::change, *who, fmt::format("{} at {} ms", label, report::milliseconds(timer.due)),
        {}, timer.effect);
  }

  /// Only the network does something here.
  void tell_channel() {
    const bool channel = subject_of(step_.event.kind) == Subject::channel;
    const std::uint32_t who = channel ? step_.event.subject : 0;
    std::string text = model::name_of(step_.event.kind);
    std::ranges::replace(text, '_', ' ');
    if (step_.served)
      text += ": " + packet_text(history_, *step_.served);
    else if (step_.arrived)
      text += ": " + packet_text(history_, *step_.arrived);
    add(Act::Kind::channel, who, text);
  }

  static constexpr std::size_t listed = 4;  // of many packets

  const History& history_;
  const Step& step_;
  const Relevance& relevance_;
  bool violating_;
  std::vector<Act> acts_;
};

}  // namespace

std::vector<Act> acts_of(const History& history, std::size_t step, const Relevance& relevance) {
  return Narrator{history, step, relevance}.run();
}

std::string packet_text(const History& history, std::uint64_t number) {
  const std::string words = packet_words(history.packets.at(number));
  if (number >= first_local) return words + " on its host";
  return fmt::format("p{} {}", number, words);
}

}  // namespace stormproof::counterexample
