// Random executions of the rules with a clock, in which timers are due when the rules say, and each
// packet arrives within Δ or is lost, seen by each descriptor as the timed derived system sees
// them. What is looked at and the ghost limit are computed here from what was sent and lost, not
// from the system. Of the amended rules attempts of initial ACKNACKs are looked at, too.
#pragma once

#include <utility>

#include "checker/engines/tables/derived_time.hpp"
#include "checker/engines/tables/timed_descriptor.hpp"
#include "fsm/composition/amended.hpp"
#include "tests/checker/engines/tables/bridge.hpp"

namespace stormproof::tables::timed_walk {

constexpr std::int64_t delta = 7;
constexpr std::int64_t source = 3;

/// What is looked at from one place, as it says in checker/engines/tables/derived_time.hpp.
struct Ghost {
  std::map<std::string, unsigned> flying;   ///< by kind of packet: its number
  std::map<std::string, unsigned> leaving;  ///< the same
  Values values;
  bool reader_open = false;  ///< or has been
};

struct Flying {
  unsigned number;
  comp::SentPacket packet;
  std::int64_t sent;
  bool lost;
  bool arrived = false;
  bool left = false;
};

template <class Composition>
class Walk {
 public:
  /// Whether the limit is that of attempts.
  static constexpr bool attempts = std::is_same_v<Composition, comp::amended::Amended>;

  /// `exact`: every packet takes Δ. `stale`: writers hold all readers as up to date.
  Walk(const model::DdsProfile& dds, std::mt19937_64& dice, bool exact, bool stale = false)
      : dds_{dds}, dice_{dice}, exact_{exact} {
    losses_ = timeline::losses<fsm::Plain>(
        dds, {.period = dds.sedp.heartbeat_period.count(),
              .response = dds.sedp.heartbeat_response_delay.count(),
              .nack = dds.sedp.nack_response_delay.count(),
              .suppression = dds.sedp.nack_suppression_duration.count(),
              .delta = delta,
              .source = source});
    clock_.started = [this](const comp::Key& key, bool counted, std::int64_t due) {
      queue_.emplace_back(key, due);
      counted = counted || is_counted(key);
      const bool pending = counted ? state_.pending[key] > 0 : state_.surely_pending.contains(key);
      std::int64_t& known = due_[key];
      if (!pending || (counted ? due > known : due < known)) known = due;
      const auto [first, fresh] = earliest_.emplace(key, due);
      first->second = std::min(first->second, due);
    };
    clock_.cancelled = [this](const comp::Key& key) {
      std::erase_if(queue_, [&](const auto& it) { return it.first == key; });
    };
    clock_.sent = [this](const comp::SentPacket& packet) {
      sent_now_.push_back({number_++, packet, clock_.now, dice_() % 4 == 0});
    };
    for (int s = 0; s < comp::small_streams; ++s) {
      for (int d = 0; d < comp::small_descriptors; ++d) ghosts_[{s, 0, d}];
    }
    if (stale) start_stale();
  }

  /// What the system calls its variables, as the descriptor at `place` sees them.
  Values seen(const comp::Place& place) {
    Values values = seen_from<Composition>(state_, place);
    const Ghost& ghost = ghosts_.at(place);
    for (const auto& [name, value] : ghost.values) values[name] = value;
    for (const char* kind : {"Heartbeat", "AckNack", "Data", watched::initial_acknack}) {
      values[timed::in_flight(kind)] = ghost.flying.contains(kind) ? 1 : 0;
      values[timed::leaving(kind)] = ghost.leaving.contains(kind) ? 1 : 0;
    }
    for (const char* number : {"LastDelay", "LastNack", "OldCounts"}) {
      values[number] = state_.values[{number, place.of(comp::owner::relation)}];
    }
    const comp::Key attempt{"InitialAttempt", place.of(comp::owner::relation)};
    if (is_counted(attempt)) values["pending InitialAttempt"] = state_.pending[attempt];
    comp::for_each_type(typename Composition::Timers{}, [&]<class T>() {
      const comp::Key key{fsm::name_of<T>(), place.of(T::owner)};
      values[timed::due(fsm::name_of<T>())] = due_.contains(key) ? due_.at(key) : 0;
      values[timed::earliest(fsm::name_of<T>())] = earliest_.contains(key) ? earliest_.at(key) : 0;
    });
    values[timed::now] = clock_.now;
    return values;
  }

  /// Something that can happen happens: `visit(rule, owner, place)`, also for the passing of time.
  template <class Visit>
  void step(Visit&& visit) {
    switch (dice_() % 5) {
      case 0:
        return pass(visit);
      case 1:
        return packet(visit);
      case 2:
        return occasion(visit);
      default:
        return timer(visit);
    }
  }

 private:
  using World = comp::SmallWorld<Composition>;

  static bool is_counted(const comp::Key& key) { return attempts && key.first == "InitialAttempt"; }
  void start_stale() {
    namespace repair = fsm::descriptor_repair;
    for (int s = 0; s < comp::small_streams; ++s) {
      for (int p = 0; p < comp::small_peers; ++p) {
        state_.values[{"WriterOpen", {s, p, 0}}] = 1;
        for (int d = 0; d < comp::small_descriptors; ++d) {
          state_.values[{"C", {s, p, d}}] = fsm::Reflect<fsm::ReopeningRepair>::id<repair::A>;
        }
      }
    }
  }
  [[nodiscard]] std::int64_t next_attempt(std::int64_t time, std::int64_t opened) const {
    const std::int64_t first = dds_.sedp.initial_acknack_delay.count();
    const bool doubles =
        dds_.sedp.initial_acknack_interval == model::InitialAckNackInterval::doubling;
    return doubles ? 2 * time - opened + first : time + first;
  }

  template <class R, class Before, class Visit>
  void run(const comp::Place& at, Before&& before, const comp::SentPacket* packet, unsigned number,
           Visit&& visit) {
    sent_now_.clear();
    World world{state_, dds_, dice_, at, &clock_};
    before(world);
    if (packet != nullptr) world.receive(*packet);
    R::run(world);
    using Trigger = typename R::Trigger;
    for (auto& [place, ghost] : ghosts_) {
      if (packet != nullptr) {
        constexpr bool left = std::is_same_v<Trigger, comp::LeftSource<typename Trigger::Cause>>;
        auto& looked_at = left ? ghost.leaving : ghost.flying;
        std::erase_if(looked_at, [&](const auto& it) { return it.second == number; });
      }
      look(place, ghost);
    }
    flying_.insert(flying_.end(), sent_now_.begin(), sent_now_.end());
    visit(World::template tag<R>(), R::owner, at);
  }

  void look(const comp::Place& place, Ghost& ghost) {
    Values& values = ghost.values;
    std::int64_t raised = 0;
    for (const Flying& it : sent_now_) {
      if (it.packet.place == place.of(comp::owner::relation) &&
          !std::exchange(values[timed::sent(it.packet.name)], 1)) {
        values[timed::first(it.packet.name)] = clock_.now + delta;
      }
      const std::string& kind = it.packet.name;
      if (is_initial(it.packet, place)) look_at(it, watched::initial_acknack, ghost, raised);
      if (!matters(it.packet, place)) continue;
      if (kind == "Heartbeat") values[watched::heartbeat_sent] = clock_.now;
      look_at(it, kind, ghost, raised);
      const bool repair = it.packet.says.contains("IsRepair") && it.packet.says.at("IsRepair") != 0;
      if (!repair || ghost.leaving.contains(kind) || !waits_for_source()) continue;
      ghost.leaving[kind] = it.number;
      values[timed::leaves(kind)] = clock_.now + source;
    }
    std::int64_t& limit = values[timed::limit];
    std::int64_t& opened = values[watched::opened];
    if (attempts && raised > 0) {
      const auto& spoils = dds_.sedp.nack_suppression_duration;
      limit = next_attempt(clock_.now + source + spoils.count(), opened);
    } else {
      limit += raised;
    }
    const Values now = seen_from<Composition>(state_, place);
    const bool reader_open = now.at("Reader=Recognised") + now.at("Reader=Complete") > 0;
    if (reader_open && !std::exchange(ghost.reader_open, true)) opened = clock_.now;
    const Expr open = can_be_asked_for(dds_, [&](const char* name) {
      return smt::SymbolicContext::current().bool_val(now.at(name) != 0);
    });
    if (values[watched::counting] != 0 || !open.simplify().is_true()) return;
    if (attempts && !reader_open) return;
    values[watched::counting] = 1;
    limit = attempts ? next_attempt(clock_.now, opened) : clock_.now + losses_.first + raised;
  }
  /// Looks at it as one of this kind.
  void look_at(const Flying& it, const std::string& kind, Ghost& ghost, std::int64_t& raised) {
    if (ghost.flying.contains(kind)) return;
    if (it.lost) {
      raised += losses_.loss;
    } else {
      ghost.flying[kind] = it.number;
      ghost.values[timed::arrives(kind)] = clock_.now + delta;
    }
  }
  static bool is_initial(const comp::SentPacket& packet, const comp::Place& place) {
    return attempts && packet.name == "AckNack" && packet.says.at("IsInitial") != 0 &&
           packet.place == place.of(comp::owner::relation);
  }
  static bool waits_for_source() {
    return attempts || std::is_same_v<Composition, comp::paper::Paper>;
  }
  static bool matters(const comp::SentPacket& packet, const comp::Place& place) {
    const auto says = [&](const char* field) {
      const auto found = packet.says.find(field);
      return found != packet.says.end() && (found->second >> place.descriptor & 1) != 0;
    };
    if (packet.place.of(comp::owner::relation) != place.of(comp::owner::relation)) return false;
    if (packet.name == "Heartbeat") return !packet.says.contains("Announces") || says("Announces");
    if (packet.name == "Data") return says("Carries");
    if (packet.name != "AckNack") return false;
    return says("Listed") && !says("BelowBase") && packet.says.at("IsInitial") == 0;
  }

  template <class Visit>
  void pass(Visit&& visit) {
    std::int64_t latest = clock_.now + 12;
    for (const auto& [key, due] : queue_) latest = std::min(latest, due);
    for (const Flying& it : flying_) {
      if (!it.lost && !it.arrived) latest = std::min(latest, it.sent + delta);
      if (!it.left && is_awaited(it)) latest = std::min(latest, it.sent + source);
    }
    if (latest <= clock_.now) return;
    clock_.now +=
        1 + static_cast<std::int64_t>(dice_() % static_cast<std::uint64_t>(latest - clock_.now));
    visit("time passes", comp::Owner{}, comp::Place{});
  }
  static bool is_awaited(const Flying& it) {
    return waits_for_source() && it.packet.name == "Data";
  }

  template <class Visit>
  void timer(Visit&& visit) {
    // Receptions come first.
    for (const Flying& it : flying_) {
      if (!it.lost && !it.arrived && it.sent + delta <= clock_.now) return;
    }
    std::vector<std::size_t> due;
    for (std::size_t k = 0; k < queue_.size(); ++k) {
      if (queue_[k].second == clock_.now) due.push_back(k);
    }
    if (due.empty()) return;
    const std::size_t chosen = due[dice_() % due.size()];
    const comp::Key key = queue_[chosen].first;
    queue_.erase(queue_.begin() + static_cast<std::ptrdiff_t>(chosen));
    comp::for_each_type(typename Composition::Exchange{}, [&]<class R>() {
      using Cause = typename R::Trigger::Cause;
      if constexpr (std::is_same_v<typename R::Trigger, comp::Due<Cause>>) {
        if (fsm::name_of<Cause>() != key.first) return;
        run<R>(
            key.second, [](World& w) { w.template due<Cause>(); }, nullptr, 0, visit);
      }
    });
  }
  template <class Visit>
  void packet(Visit&& visit) {
    std::erase_if(flying_, [](const Flying& it) {
      return (it.lost || it.arrived) && (it.left || !is_awaited(it));
    });
    if (flying_.empty()) return;
    Flying& it = flying_[dice_() % flying_.size()];
    const bool leaves = is_awaited(it) && !it.left;
    if (!leaves && (it.lost || it.arrived)) return;
    if (!leaves && exact_ && clock_.now < it.sent + delta) return;
    (leaves ? it.left : it.arrived) = true;
    const comp::SentPacket packet = it.packet;
    const unsigned number = it.number;
    comp::for_each_type(typename Composition::Exchange{}, [&]<class R>() {
      using Cause = typename R::Trigger::Cause;
      constexpr bool left = std::is_same_v<typename R::Trigger, comp::LeftSource<Cause>>;
      if constexpr (left || std::is_same_v<typename R::Trigger, comp::Received<Cause>>) {
        if (left != leaves || fsm::name_of<Cause>() != packet.name) return;
        run<R>(
            packet.place, [](World&) {}, &packet, number, visit);
      }
    });
  }
  template <class Visit>
  void occasion(Visit&& visit) {
    std::size_t chosen = dice_() % 3;
    const comp::Place place{static_cast<int>(dice_() % comp::small_streams),
                            static_cast<int>(dice_() % comp::small_peers),
                            static_cast<int>(dice_() % comp::small_descriptors)};
    comp::for_each_type(typename Composition::Exchange{}, [&]<class R>() {
      using Cause = typename R::Trigger::Cause;
      if constexpr (std::is_same_v<typename R::Trigger, comp::Happens<Cause>>) {
        if (chosen-- == 0)
          run<R>(
              place, [](World&) {}, nullptr, 0, visit);
      }
    });
  }

  const model::DdsProfile& dds_;
  std::mt19937_64& dice_;
  bool exact_;
  timeline::Losses<fsm::Plain> losses_;
  comp::SmallState state_;
  comp::SmallClock clock_;
  std::vector<std::pair<comp::Key, std::int64_t>> queue_;
  std::map<comp::Key, std::int64_t> due_;
  std::map<comp::Key, std::int64_t> earliest_;
  std::vector<Flying> flying_;
  std::vector<Flying> sent_now_;
  std::map<comp::Place, Ghost> ghosts_;
  unsigned number_ = 0;
};

}  // namespace stormproof::tables::timed_walk
