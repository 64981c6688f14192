// live.isolation: whoever is dead delays nobody else. The run is compared with that of the same
// deployment without the participants that fall silent, in which the same packets are lost: no
// relation between those that live may be complete later than there by more than one period of
// HEARTBEATs. That much is allowed because a writer has one clock for all its readers, so that
// somebody else can shift it. The periods of a writer that slows down do not count: it is what is
// looked for.
#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include <fmt/core.h>

#include "model/life.hpp"
#include "model/simulator.hpp"
#include "model/trace/event_subject.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"
#include "props/monitors/packet_names.hpp"
#include "props/monitors/received_descriptors.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;

/// A run as it is compared: when relations become complete, and which packets are lost.
class ComparedRun : public Observer {
 public:
  /// Writer and reader with their original numbers, and the stream.
  using Ends = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;
  struct Progress {
    std::uint32_t relation = 0;
    std::uint64_t missing = 0;
    std::optional<Nanoseconds> complete;  ///< the last time that it became so
    std::uint64_t event = 0;              ///< the last that had to do with it
    Nanoseconds time;
  };

  ComparedRun(std::vector<std::uint32_t> originals, std::vector<std::uint64_t> lost)
      : Observer{"live.isolation"},
        originals_{std::move(originals)},
        lost_{std::move(lost)},
        names_{originals_} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    received_.reset(topology);
    relations_.assign(topology.relation_count(), {});
    for (std::uint32_t r = 0; r < topology.relation_count(); ++r) {
      relations_[r].relation = r;
      relations_[r].missing = topology.descriptor_count(r);
      const model::Pair& pair = topology.pair(r / 2);
      if (!pair.cross_host || relations_[r].missing == 0) continue;
      if (pair.source >= originals_.size() || pair.destination >= originals_.size()) continue;
      by_ends_[{originals_[pair.source], originals_[pair.destination], r % 2}] = r;
    }
  }
  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    if (model::trace::subject_of(event.kind) == model::trace::Subject::relation) {
      touch(event.subject);
    }
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    if (source >= originals_.size()) return;
    std::uint64_t number = packet.number;
    for (const PacketNames::Name& name : names_.of(packet, source, destinations)) {
      named(name, number, std::ranges::binary_search(lost_, number));
      ++number;
    }
  }
  void received(const model::Packet& packet, std::uint32_t) override { received_.arriving(packet); }
  void transition(const model::Transition& fired) override {
    if (const model::Packet* data = received_.taken(fired.machine, fired.event)) take(*data);
    if (ReceivedDescriptors::is_new(fired.machine, fired.event)) {
      received_.lose(fired.machine.subject);
      relations_[fired.machine.subject].missing =
          topology().descriptor_count(fired.machine.subject);
      relations_[fired.machine.subject].complete.reset();
    }
    if (fired.machine.kind == model::MachineRef::Kind::relation) touch(fired.machine.subject);
  }

  [[nodiscard]] const std::map<Ends, std::uint32_t>& by_ends() const { return by_ends_; }
  [[nodiscard]] const Progress& progress(std::uint32_t relation) const {
    return relations_[relation];
  }

 protected:
  virtual void named(const PacketNames::Name& name, std::uint64_t number, bool is_lost) = 0;

 private:
  void touch(std::uint32_t relation) {
    Progress& progress = relations_[relation];
    if (progress.missing == 0 || events() == 0) return;
    progress.event = event();
    progress.time = now();
  }
  void take(const model::Packet& data) {
    touch(data.relation());
    received_.take(data);
    Progress& progress = relations_[data.relation()];
    std::uint64_t has = 0;
    for (std::uint32_t k = 0; k < received_.word_count(data.relation()); ++k) {
      has += static_cast<std::uint64_t>(std::popcount(received_.word(data.relation(), k)));
    }
    const std::uint64_t missing = topology().descriptor_count(data.relation()) - has;
    if (missing == 0 && progress.missing > 0) progress.complete = now();
    progress.missing = missing;
  }

  std::vector<std::uint32_t> originals_;
  std::vector<std::uint64_t> lost_;
  PacketNames names_;
  ReceivedDescriptors received_;
  std::vector<Progress> relations_;
  std::map<Ends, std::uint32_t> by_ends_;
};

/// A run without the dead that is longer than this says nothing.
constexpr std::uint64_t most_events = 5'000'000;

using Names = std::set<PacketNames::Name>;

/// The run without the dead. It notes the first packet that should be lost and is not.
class RunWithoutTheDead : public ComparedRun {
 public:
  RunWithoutTheDead(std::vector<std::uint32_t> originals, std::vector<std::uint64_t> lost,
                    const Names& to_lose)
      : ComparedRun{std::move(originals), std::move(lost)}, to_lose_{to_lose} {}

  [[nodiscard]] std::optional<std::uint64_t> first_to_lose() const { return first_to_lose_; }

 protected:
  void named(const PacketNames::Name& name, std::uint64_t number, bool is_lost) override {
    if (!is_lost && !first_to_lose_ && to_lose_.contains(name)) first_to_lose_ = number;
  }

 private:
  const Names& to_lose_;
  std::optional<std::uint64_t> first_to_lose_;
};

std::vector<std::uint32_t> all_of(const model::Scenario& scenario) {
  // Those that come back as somebody new are numbered after all others.
  const std::uint32_t count = with_successors(scenario.deployment).size();
  std::vector<std::uint32_t> all(count);
  for (std::uint32_t i = 0; i < count; ++i) all[i] = i;
  return all;
}

struct Living {
  model::Scenario scenario;
  std::vector<std::uint32_t> originals;
};

/// Those that do not fall silent.
Living living(const model::Scenario& scenario) {
  constexpr std::uint32_t dead = UINT32_MAX;
  const model::Life life = scenario.deployment.life.value_or(model::Life{});
  Living living{scenario, {}};
  std::vector<std::uint32_t> number(scenario.deployment.size(), dead);
  living.scenario.deployment.participants.clear();
  for (std::uint32_t i = 0; i < scenario.deployment.size(); ++i) {
    if (std::ranges::find(life.mute, i, &model::Mute::participant) != life.mute.end()) continue;
    number[i] = static_cast<std::uint32_t>(living.originals.size());
    living.originals.push_back(i);
    living.scenario.deployment.participants.push_back(scenario.deployment.participants[i]);
  }
  model::Life& rest = living.scenario.deployment.life.emplace(life);
  rest.mute.clear();
  const auto keep = [&](auto& list, auto... members) {
    std::erase_if(list, [&](auto& each) { return ((number[each.*members] == dead) || ...); });
    for (auto& each : list) ((each.*members = number[each.*members]), ...);
  };
  keep(rest.stale, &model::StaleRelation::writer, &model::StaleRelation::reader);
  keep(rest.outages, &model::Outage::from, &model::Outage::to);
  keep(rest.restarts, &model::Restart::participant);
  keep(rest.leases, &model::Lease::participant);
  keep(rest.endpoints, &model::LateEndpoints::participant);
  // Successors come after all others, in the order of the restarts, here and there.
  std::uint32_t successor = scenario.deployment.size();
  for (const model::Restart& restart : life.restarts) {
    if (restart.identity != model::Identity::fresh) continue;
    if (number[restart.participant] != dead) living.originals.push_back(successor);
    ++successor;
  }
  return living;
}

class Isolation : public ComparedRun {
 public:
  explicit Isolation(const model::Scenario& scenario)
      : ComparedRun{all_of(scenario), sorted(scenario.wireless.lost_packets)}, scenario_{scenario} {
    const model::SedpProfile& sedp = scenario.dds.sedp;
    const bool adaptive = sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive;
    allowed_ = adaptive ? sedp.adaptive.min_period : sedp.heartbeat_period;
  }

  void run_started(const model::Topology& topology) override {
    ComparedRun::run_started(topology);
    names_.emplace(topology);
  }
  void finish(Nanoseconds end) override {
    const auto& life = scenario_.deployment.life;
    if (!life || life->mute.empty()) return;  // the run would be compared with itself
    const Living others = living(scenario_);
    // Each run finds one packet more that has to be lost.
    model::Scenario scenario = others.scenario;
    scenario.wireless.lost_packets.clear();
    for (std::size_t runs = 0; runs <= to_lose_.size(); ++runs) {
      RunWithoutTheDead without{others.originals, scenario.wireless.lost_packets, to_lose_};
      model::RunOptions options;
      options.probe = &without;
      options.max_events = most_events;
      if (simulate(scenario, options).end == model::RunEnd::interrupted) break;
      const auto next = without.first_to_lose();
      if (!next) return compare(without, end);
      scenario.wireless.lost_packets.push_back(*next);
      std::ranges::sort(scenario.wireless.lost_packets);
    }
    undecided_ = true;
  }
  [[nodiscard]] bool is_undecided() const override { return undecided_; }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {
        fmt::format("{} relations of those that live are compared; the latest is complete {} "
                    "later than without the dead, {} is allowed.",
                    compared_, time_text(latest_), time_text(allowed_))};
  }

 protected:
  void named(const PacketNames::Name& name, std::uint64_t, bool is_lost) override {
    if (is_lost) to_lose_.insert(name);
  }

 private:
  static std::vector<std::uint64_t> sorted(std::vector<std::uint64_t> list) {
    std::ranges::sort(list);
    return list;
  }
  void compare(const RunWithoutTheDead& without, Nanoseconds end) {
    for (const auto& [ends, relation] : without.by_ends()) {
      const auto expected = without.progress(relation).complete;
      const auto own = by_ends().find(ends);
      if (!expected || own == by_ends().end()) continue;
      const Progress& here = progress(own->second);
      const Nanoseconds due = *expected + allowed_;
      ++compared_;
      if (here.complete) {
        latest_ = std::max(latest_, *here.complete - *expected);
        if (*here.complete > due) object_to(here, *here.complete, *expected);
      } else if (end <= due) {
        undecided_ = true;
      } else {
        object_to(here, end, *expected);
      }
    }
  }
  void object_to(const Progress& here, Nanoseconds until, Nanoseconds expected) {
    object(here.event, here.time,
           fmt::format("{} is {} {}; without the participants that are dead it is so at {}.",
                       relation_text(*names_, here.relation),
                       here.complete ? "complete at" : "not complete at", time_text(until),
                       time_text(expected)));
  }

  const model::Scenario scenario_;
  Nanoseconds allowed_;
  std::optional<model::Topology> names_;  ///< also after the run
  Names to_lose_;
  std::size_t compared_ = 0;
  Nanoseconds latest_;
  bool undecided_ = false;
};

}  // namespace

MonitorPtr watch_isolation(const model::Scenario& scenario) {
  return attentive<Isolation>(scenario);
}

}  // namespace stormproof::props
