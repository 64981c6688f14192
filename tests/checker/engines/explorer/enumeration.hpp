// The explorer against brute force, for every composition: the simulator runs every combination of
// whole delays, losses and opening times of a tiny instance, up to the end of all traffic, and what
// comes out of it must be what the explorer finds with its zones: no outcome more, none less.
// Outcomes are the histories of runs, packet by packet without their times, and the times at which
// nothing was missing any more with what had been sent until then.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "checker/engines/explorer/replay.hpp"
#include "checker/engines/explorer/search.hpp"
#include "model/engine/packet.hpp"

namespace stormproof::explorer {

struct Outcomes {
  std::set<std::pair<std::int64_t, std::string>> completions;  ///< ns, history until then
  std::set<std::string> ends;                                  ///< whole histories

  bool operator==(const Outcomes&) const = default;
};

/// A packet of a history: "D0{0,1}+" is a repair of two descriptors in relation 0.
inline std::string word_of(What what, std::uint16_t set, unsigned relation, bool repair,
                           bool initial, bool carries_heartbeat) {
  const char letter = what == What::data ? 'D' : what == What::heartbeat ? 'H' : 'A';
  std::string word = fmt::format("{}{}", letter, relation);
  if (what != What::heartbeat) word += fmt::format("{{{:x}}}", set);
  return word + (repair ? "+" : "") + (initial ? "i" : "") + (carries_heartbeat ? "h" : "") + " ";
}

/// A world that remembers what it has sent, and notes its outcomes.
template <class World>
class RememberingWorld {
 public:
  struct State {
    std::uint64_t history = 0;
    typename World::State rules;
    bool operator==(const State&) const = default;
  };
  RememberingWorld(World& world, Outcomes& outcomes) : world_{world}, outcomes_{outcomes} {}

  State start(Frame& frame) { return {number_of(""), world_.start(frame)}; }
  void fire(State& state, Frame& frame, const Slot& slot) {
    const bool missing = !complete(state);
    log_ = {};
    frame.log_to(log_);
    world_.fire(state.rules, frame, slot);
    std::string history = histories_[state.history];
    for (const PathLog::Emission& each : log_.emissions) {
      const Slot& packet = each.packet;
      history += word_of(packet.what, packet.set, packet.relation, packet.has(Slot::from_repair),
                         packet.has(Slot::initial), packet.has(Slot::carries_heartbeat));
    }
    state.history = number_of(history);
    if (missing && complete(state)) {
      const unsigned mark = frame.find(What::opened) + 1;
      for (auto t = -frame.zone().bound(mark, 0); t <= frame.zone().bound(0, mark); ++t) {
        outcomes_.completions.insert({t, history});
      }
      frame.erase_marks(What::opened, 0);
    }
    if (!frame.any_pending()) outcomes_.ends.insert(history);
  }
  [[nodiscard]] bool complete(const State& state) const { return world_.complete(state.rules); }
  [[nodiscard]] std::uint32_t received(const State& s) const { return world_.received(s.rules); }
  [[nodiscard]] unsigned deliveries() const { return world_.deliveries(); }
  [[nodiscard]] const Scope& scope() const { return world_.scope(); }
  [[nodiscard]] const EventRules& rules() const { return world_.rules(); }
  [[nodiscard]] bool sorts_slots() const { return world_.sorts_slots(); }
  [[nodiscard]] std::size_t used_words() const { return 1 + world_.used_words(); }

 private:
  std::uint64_t number_of(const std::string& history) {
    const auto [found, fresh] = numbers_.try_emplace(history, histories_.size());
    if (fresh) histories_.push_back(history);
    return found->second;
  }

  World& world_;
  Outcomes& outcomes_;
  PathLog log_;
  std::map<std::string, std::uint64_t> numbers_;
  std::vector<std::string> histories_;
};

template <class World>
Outcomes explored(const model::Scenario& scenario, const Scope& scope) {
  World rules{scenario, scenario, scope, {}};
  Outcomes outcomes;
  RememberingWorld<World> world{rules, outcomes};
  SearchOptions options;
  options.mark_opening = true;
  const SearchResult result = Search<RememberingWorld<World>>{world, options}.run();
  EXPECT_TRUE(result.exhausted());
  return outcomes;
}

/// The packets of the explored relations from participant 0 to the readers, and when these are
/// complete.
class RelationHistory final : public model::Probe {
 public:
  struct Entry {
    Slot slot;
    model::Nanoseconds emitted;
  };
  std::vector<Entry> packets;
  std::string history;
  std::string until_completion;
  std::optional<model::Nanoseconds> completion;

  explicit RelationHistory(const Scope& scope) : scope_{scope} {}
  void event_started(const model::Event& event) override { now_ = event.time; }
  void event_finished(const model::Depths&) override {
    if (completion || complete_.size() < scope_.readers * scope_.writers) return;
    completion = now_;
    until_completion = history;
  }
  void transition(const model::Transition& fired) override {
    const bool of_ours =
        fired.machine.subject % 2 < scope_.writers && fired.machine.subject / 2 < scope_.readers;
    if (fired.machine.machine == "DiscoveryReader" && of_ours &&
        fired.after.ends_with("Complete")) {
      complete_.insert(fired.machine.subject);
    }
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    const bool sedp = packet.kind == model::PacketKind::data ||
                      packet.kind == model::PacketKind::heartbeat ||
                      packet.kind == model::PacketKind::acknack;
    if (!sedp || !is_explored(packet, scope_)) return;
    for (const std::uint32_t destination : destinations) {
      const std::uint32_t reader = (packet.to_writer() ? source : destination) - 1;
      Slot slot{packet.kind == model::PacketKind::data        ? What::data
                : packet.kind == model::PacketKind::heartbeat ? What::heartbeat
                                                              : What::acknack};
      slot.set = static_cast<std::uint16_t>(packet.descriptors.word(0));
      slot.relation = static_cast<std::uint8_t>(explored_relation(packet, reader, scope_));
      if (packet.from_repair) slot.flags = Slot::from_repair;
      packets.push_back({slot, packet.emitted});
      history += word_of(slot.what, slot.set, slot.relation, packet.from_repair,
                         packet.initial_acknack, packet.carries_heartbeat);
    }
  }

 private:
  const Scope& scope_;
  model::Nanoseconds now_;
  std::set<std::uint32_t> complete_;
};

/// Runs every choice for every packet, one packet after the other, after every choice of what is
/// pending at the start.
template <class World, class History = RelationHistory>
class Enumeration {
 public:
  Enumeration(const model::Scenario& scenario, const Scope& scope,
              const model::ImplementationMaker* maker = nullptr)
      : scope_{scope}, request_{scenario, scenario, nullptr, scope_, {}, maker} {
    World world{scenario, scenario, scope, {}};
    Frame frame{world.scope(), world.rules()};
    world.start(frame);
    start(frame);
  }
  Outcomes outcomes;
  std::uint64_t runs = 0;

 private:
  /// All whole times of the events that are pending in a frame, one after the other.
  void start(const Frame& frame) {
    if (!frame.any_pending()) {
      path_.steps = {{Slot{}, model::Nanoseconds{200}, {}}};  // beyond the end of all traffic
      descend(scope_.losses);
      return;
    }
    const std::int64_t least = -frame.zone().bound(0, 1);
    for (std::int64_t time = least; time <= frame.zone().bound(1, 0); ++time) {
      Frame rest = with_first_at(frame, time);
      if (rest.count() == frame.count()) continue;  // not with the times before
      path_.scheduled.push_back({frame.slot(0), model::Nanoseconds{time}});
      start(rest);
      path_.scheduled.pop_back();
    }
  }
  /// The frame without its first event, which is at this time; unchanged if it cannot be.
  static Frame with_first_at(const Frame& frame, std::int64_t time) {
    Zone zone = frame.zone();
    std::vector<Slot> slots;
    for (unsigned k = 0; k < frame.count(); ++k) slots.push_back(frame.slot(k));
    const bool possible = zone.constrain(1, 0, time) && zone.constrain(0, 1, -time);
    if (possible) {
      zone.remove(1);
      slots.erase(slots.begin());
    }
    std::vector<std::int64_t> bounds;
    for (unsigned i = 0; i < zone.size(); ++i) {
      bounds.insert(bounds.end(), zone.row(i), zone.row(i) + zone.size());
    }
    Frame rest = frame;
    rest.restore(slots.data(), zone.size() - 1, bounds.data(), frame.losses_left());
    return rest;
  }

  void descend(unsigned losses_left) {
    std::string why_not;
    const auto scenario = scenario_of(request_, path_, why_not);
    ASSERT_TRUE(scenario) << why_not;
    History seen{scope_};
    run(request_, *scenario, seen);
    ++runs;
    if (seen.packets.size() == path_.packets.size()) {
      outcomes.ends.insert(seen.history);
      if (!seen.completion) return;
      const model::Nanoseconds start = start_of_world(request_, path_) + last_opening();
      outcomes.completions.insert({(*seen.completion - start).count(), seen.until_completion});
      return;
    }
    const typename History::Entry next = seen.packets[path_.packets.size()];
    if (!path_.packets.empty() && path_.packets.back().slot.has(Slot::goes_on)) {
      const ConcretePath::Packet& part = path_.packets.back();
      return choose(next, part.leaves_after.count(), part.one_way, losses_left);
    }
    const bool leaves_later = next.slot.has(Slot::from_repair);
    const std::int64_t last_leave = leaves_later ? scope_.leaves_within.count() : 0;
    for (std::int64_t leave = 0; leave <= last_leave; ++leave) {
      for (std::int64_t delay = std::max(leave, scope_.least_delay.count());
           delay <= scope_.largest_delay.count(); ++delay) {
        choose(next, leave, model::Nanoseconds{delay}, losses_left);
      }
      if (losses_left > 0) choose(next, leave, std::nullopt, losses_left - 1);
    }
  }
  void choose(const typename History::Entry& packet, std::int64_t leave,
              std::optional<model::Nanoseconds> one_way, unsigned losses_left) {
    const model::Nanoseconds emitted = packet.emitted - start_of_world(request_, path_);
    path_.packets.push_back({packet.slot, emitted, one_way, model::Nanoseconds{leave}});
    descend(losses_left);
    path_.packets.pop_back();
  }

  /// From which completion counts if there are several readers.
  [[nodiscard]] model::Nanoseconds last_opening() const {
    model::Nanoseconds last;
    for (const ConcretePath::Scheduled& each : path_.scheduled) {
      const bool opens =
          each.slot.what == What::reader_opens || each.slot.what == What::writer_opens;
      if (opens && scope_.readers > 1) last = std::max(last, each.time);
    }
    return last;
  }

  const Scope scope_;
  ReplayRequest request_;
  ConcretePath path_;
};

/// What makes histories equal that nobody can tell apart.
using Meaning = std::string (*)(const std::string&);
inline Outcomes told(const Outcomes& outcomes, Meaning meaning) {
  if (meaning == nullptr) return outcomes;
  Outcomes result;
  for (const auto& [time, history] : outcomes.completions) {
    result.completions.insert({time, meaning(history)});
  }
  for (const std::string& history : outcomes.ends) result.ends.insert(meaning(history));
  return result;
}

/// Both, and that they agree; returns how many runs that took.
template <class World, class History = RelationHistory>
std::uint64_t expect_equal_outcomes(const model::Scenario& scenario, const Scope& scope,
                                    const model::ImplementationMaker* maker = nullptr,
                                    Meaning meaning = nullptr) {
  const Enumeration<World, History> enumeration{scenario, scope, maker};
  const Outcomes ran = told(enumeration.outcomes, meaning);
  const Outcomes found = told(explored<World>(scenario, scope), meaning);
  const auto compare = [](const auto& zones, const auto& runs, const char* what) {
    std::string missing;
    std::string additional;
    const auto text = [](const auto& outcome) {
      if constexpr (requires { outcome.first; }) {
        return fmt::format("\n  {}: {}", outcome.first, outcome.second);
      } else {
        return "\n  " + outcome;
      }
    };
    for (const auto& each : runs) {
      if (!zones.contains(each) && missing.size() < 1'000) missing += text(each);
    }
    for (const auto& each : zones) {
      if (!runs.contains(each) && additional.size() < 1'000) additional += text(each);
    }
    EXPECT_EQ(missing, "") << what << " of runs that the explorer does not find";
    EXPECT_EQ(additional, "") << what << " that no run has";
  };
  compare(found.completions, ran.completions, "completions");
  compare(found.ends, ran.ends, "histories");
  return enumeration.runs;
}

}  // namespace stormproof::explorer
