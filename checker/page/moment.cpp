// An observer that remembers the last event, and states of machines that are the participant's.
#include "checker/page/moment.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <tuple>

#include "checker/page/machine_owners.hpp"
#include "fsm/machines.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/simulator.hpp"
#include "model/trace/effect_names.hpp"
#include "model/trace/perfetto_labels.hpp"

namespace stormproof::page {

namespace {

using model::MachineRef;
using model::Report;

/// A machine of the run, in the order in which a page lists them.
using MachineKey = std::tuple<std::string_view, MachineRef::Kind, std::uint32_t>;

/// How many descriptors are in which state.
using StateCounts = std::map<std::string_view, std::uint32_t>;

class Witness final : public model::Probe {
 public:
  Witness(const model::Scenario& scenario, std::uint64_t event, std::uint32_t participant)
      : last_{event}, participant_{participant}, owners_{scenario}, effects_{scenario.dds} {}

  [[nodiscard]] model::Reports reports() const override {
    model::Reports reports;
    for (const Report one :
         {Report::event_started, Report::transition, Report::reader_transition,
          Report::descriptor_transition, Report::channel_transition, Report::effect,
          Report::emitted, Report::received, Report::looped_back}) {
      reports.set(one);
    }
    return reports;
  }
  [[nodiscard]] bool wants_single_packets() const override { return false; }
  [[nodiscard]] bool wants_effects() const override { return true; }

  void run_started(const model::Topology& topology) override {
    topology_.emplace(topology);
    owners_.run_started(*topology_);
  }
  void event_started(const model::Event& event) override {
    ++moment.event;
    moment.time = event.time;
    kind_ = event.kind;
    if (is_last()) effects_.event_started();
  }

  void effect(fsm::composition::EffectKey key) override {
    if (is_last()) moment.effects.emplace_back(effects_.happens(key));
  }
  void transition(const model::Transition& fired) override {
    const bool mine = owners_.owns(participant_, fired.machine);
    if (mine) remember(fired);
    if (!is_last()) return;
    moment.steps.push_back({std::string{fired.machine.machine}, owners_.words_of(fired.machine),
                            std::string{fired.event}, std::string{fired.before},
                            std::string{fired.after},
                            static_cast<std::uint32_t>(std::popcount(fired.descriptors)), mine});
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    if (!is_last()) return;
    moment.packets.push_back("participant " + std::to_string(source) + " sends " +
                             model::trace::emission_label(packet, destinations));
  }
  void looped_back(const model::Packet& packet, std::uint32_t receiver) override {
    if (!is_last()) return;
    moment.packets.push_back(std::string{model::trace::packet_label(packet)} +
                             " goes to participant " + std::to_string(receiver) +
                             " on the same host");
  }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    if (!is_last()) return;
    const std::string who = receiver == everybody ? "everybody it was sent to"
                                                  : "participant " + std::to_string(receiver);
    moment.packets.push_back(who + " receives " + std::string{model::trace::packet_label(packet)});
  }

  void finish() {
    if (moment.event > 0) moment.what = words_of(kind_);
    list_descriptors();
    for (const auto& [key, state] : states_) {
      const auto& [machine, kind, subject] = key;
      moment.machines.push_back(
          {std::string{machine}, owners_.words_of({machine, kind, subject}), std::string{state}});
    }
  }

  Moment moment;

 private:
  [[nodiscard]] bool is_last() const { return moment.event == last_; }

  static std::string words_of(model::EventKind kind) {
    std::string words = model::trace::timer_label(kind);
    std::ranges::replace(words, '_', ' ');
    return words;
  }

  void remember(const model::Transition& fired) {
    const MachineRef& machine = fired.machine;
    if (fired.descriptors == 0) {
      states_[{machine.machine, machine.kind, machine.subject}] = fired.after;
      return;
    }
    if (topology_->pair(machine.subject / 2).source != participant_) return;
    moment.descriptor_machine = machine.machine;
    const auto moved = static_cast<std::uint32_t>(std::popcount(fired.descriptors));
    StateCounts& counts = descriptors_[machine.subject];
    counts[fired.after] += moved;
    // Those that come from the initial state have not been counted there.
    std::uint32_t& before = counts[fired.before];
    before -= std::min(before, moved);
  }

  void list_descriptors() {
    if (moment.descriptor_machine.empty()) return;
    const std::vector<fsm::MachineInfo> all = fsm::machines();
    const auto machine = std::ranges::find(all, moment.descriptor_machine, &fsm::MachineInfo::name);
    if (machine == all.end()) return;
    const std::uint32_t first = topology_->first_pair(participant_);
    for (std::uint32_t k = 0; k < topology_->peer_count(participant_); ++k) {
      for (const model::Stream stream : model::streams) {
        const std::uint32_t relation = 2 * (first + k) + static_cast<std::uint32_t>(stream);
        ReaderStates states{topology_->pair(first + k).destination, stream, {}};
        std::uint32_t others = topology_->descriptor_count(relation);
        for (const std::string_view state : machine->states) {
          states.counts.push_back(descriptors_[relation][state]);
        }
        // What is left is in the initial state.
        states.counts[machine->initial] = 0;
        for (const std::uint32_t count : states.counts) others -= std::min(others, count);
        states.counts[machine->initial] = others;
        moment.readers.push_back(std::move(states));
      }
    }
  }

  const std::uint64_t last_;
  const std::uint32_t participant_;
  MachineOwners owners_;
  model::trace::EffectNames effects_;
  std::optional<model::Topology> topology_;  // the run's own ends with it
  model::EventKind kind_{};
  std::map<MachineKey, std::string_view> states_;
  std::map<std::uint32_t, StateCounts> descriptors_;  // by relation
};

/// Notes the events in which a machine of the participant takes a step, around one of them.
class Search final : public model::Probe {
 public:
  Search(const model::Scenario& scenario, std::uint64_t event, std::uint32_t participant)
      : from_{event}, participant_{participant}, owners_{scenario} {}

  [[nodiscard]] model::Reports reports() const override {
    model::Reports reports;
    for (const Report one : {Report::event_started, Report::transition, Report::reader_transition,
                             Report::descriptor_transition}) {
      reports.set(one);
    }
    return reports;
  }
  [[nodiscard]] bool wants_single_packets() const override { return false; }

  void run_started(const model::Topology& topology) override { owners_.run_started(topology); }
  void event_started(const model::Event&) override { ++event_; }
  void transition(const model::Transition& fired) override {
    if (event_ == from_ || after || !owners_.owns(participant_, fired.machine)) return;
    (event_ < from_ ? before : after) = event_;
  }

  std::optional<std::uint64_t> before, after;

 private:
  const std::uint64_t from_;
  const std::uint32_t participant_;
  MachineOwners owners_;
  std::uint64_t event_ = 0;
};

}  // namespace

Moment moment_of(const model::Scenario& scenario, std::uint64_t event, std::uint32_t participant) {
  Witness witness{scenario, event, participant};
  model::RunOptions options;
  options.probe = &witness;
  options.max_events = std::max<std::uint64_t>(event, 1);
  if (event > 0) witness.moment.missing = model::simulate(scenario, options).missing_count;
  witness.finish();
  return std::move(witness.moment);
}

std::optional<std::uint64_t> next_step_of(const model::Scenario& scenario, std::uint64_t event,
                                          std::uint32_t participant) {
  Search search{scenario, event, participant};
  model::RunOptions options;
  options.probe = &search;
  options.on_progress = [&](const model::Progress&) { return !search.after; };
  (void)model::simulate(scenario, options);
  return search.after;
}

std::optional<std::uint64_t> step_before_of(const model::Scenario& scenario, std::uint64_t event,
                                            std::uint32_t participant) {
  if (event <= 1) return std::nullopt;
  Search search{scenario, event, participant};
  model::RunOptions options;
  options.probe = &search;
  options.max_events = event - 1;
  (void)model::simulate(scenario, options);
  return search.before;
}

}  // namespace stormproof::page
