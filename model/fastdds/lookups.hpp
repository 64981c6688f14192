// What participants know of types, what waits for them, and the samples by which they ask
// (fsm/composition/lookups.hpp): queued by who sends them, and kept by each writer in the order of
// their numbers. And what rules ask of that and of control-only relations, and have done with it:
// stated once for whoever executes the rules, the simulator and the audit of its runs. Who says how
// samples become messages is `Protocol` (model/fastdds/lookups.cpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "fsm/composition/fastdds.hpp"
#include "model/engine/run_state.hpp"
#include "model/engine/running_world.hpp"
#include "model/fastdds/control.hpp"
#include "model/fastdds/types.hpp"

namespace stormproof::model::fastdds {

namespace rules = fsm::composition::fastdds;
namespace control = fsm::composition::control;
namespace lookup = fsm::composition::lookup;

/// One addressee takes a sample up, whoever receives it.
struct Sample {
  std::uint32_t addressee = 0;
  /// 2 · type + stream of the descriptors that wait for it; or, if all types that wait are asked
  /// for at once, the number of the question.
  std::uint32_t looked_up = 0;
  std::uint32_t stage = 0;  ///< 0 and 2 are questions, 1 and 3 answers
};

class Lookups {
 public:
  /// A descriptor of a relation, whose reader's participant waits for its type.
  using Waiting = std::pair<std::uint32_t, std::uint32_t>;

  Lookups(const Scenario& scenario, const Topology& topology)
      : topology_{topology},
        types_{scenario.deployment},
        asks_for_all_{scenario.dds.version.typelookup_unit == LookupUnit::participant},
        learned_(topology.participant_count()),
        queues_(topology.participant_count()),
        histories_(control_writers * std::size_t{topology.participant_count()}) {}

  /// What is looked up if the reader of the relation does not know the type of descriptor d.
  [[nodiscard]] std::uint32_t looked_up(std::uint32_t relation, std::uint32_t d) const;
  /// The participant has looked it up, or creates an endpoint with it among its first ones of each
  /// stream.
  [[nodiscard]] bool knows(std::uint32_t participant, std::uint32_t looked_up,
                           std::array<std::uint32_t, 2> created) const;
  void learn(std::uint32_t participant, std::uint32_t type) { learned_[participant].insert(type); }

  /// Those that wait for the type, of this stream, in the order in which they came.
  [[nodiscard]] std::vector<Waiting>& waiting(std::uint32_t participant, std::uint32_t looked_up) {
    return waiting_[{participant, looked_up}];
  }
  [[nodiscard]] std::vector<Waiting>& waiting_with(std::uint32_t relation, std::uint32_t d) {
    return waiting(topology_.pair(relation / 2).destination, looked_up(relation, d));
  }
  [[nodiscard]] bool waits(std::uint32_t relation, std::uint32_t d) const;

  /// Whether descriptor d, which waits, is the first one of its type and stream to do so.
  [[nodiscard]] bool is_first(std::uint32_t relation, std::uint32_t d) {
    return waiting_with(relation, d).front() == Waiting{relation, d};
  }
  /// Types that the source of the pair has to ask its destination for, in the order of the
  /// descriptors, publications first; `most` of them.
  [[nodiscard]] std::vector<std::uint32_t> first_ones(std::uint32_t pair, std::size_t most);
  /// What a sample of a lookup is about.
  [[nodiscard]] std::vector<std::uint32_t> types_of(std::uint32_t looked_up) const {
    return asks_for_all_ ? questions_[looked_up] : std::vector{looked_up / 2};
  }
  [[nodiscard]] std::size_t type_count(std::uint32_t looked_up) const {
    return asks_for_all_ ? questions_[looked_up].size() : 1;
  }

  /// A question for all types gets its number, and is about those that wait now.
  void queue(std::uint32_t pair, Sample sample) {
    if (asks_for_all_ && sample.stage == 0) {
      sample.looked_up = static_cast<std::uint32_t>(questions_.size());
      questions_.push_back(first_ones(pair, SIZE_MAX));
    }
    queues_[topology_.pair(pair).source].push_back(sample);
  }
  [[nodiscard]] bool has_queued(std::uint32_t participant) const {
    return !queues_[participant].empty();
  }
  /// The oldest sample of the participant's queue leaves it, and is the next one of its writer
  /// (`control_writers`), which is the result.
  std::uint32_t take(std::uint32_t participant);
  /// Sample `number`, from 1, of a writer, and the last one.
  [[nodiscard]] const Sample& sample(std::uint32_t writer, std::uint32_t number) const {
    return histories_[writer][number - 1];
  }
  [[nodiscard]] const Sample& last_sample(std::uint32_t writer) const {
    return histories_[writer].back();
  }
  [[nodiscard]] std::uint32_t sample_count(std::uint32_t writer) const {
    return static_cast<std::uint32_t>(histories_[writer].size());
  }

 private:
  const Topology& topology_;
  const Types types_;
  const bool asks_for_all_;
  std::vector<std::vector<std::uint32_t>> questions_;  // for all types: which
  std::vector<std::set<std::uint32_t>> learned_;       // types, by participant
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Waiting>> waiting_;
  std::vector<std::deque<Sample>> queues_;      // by participant
  std::vector<std::vector<Sample>> histories_;  // by writer
};

/// A layer of such a host.
template <class Host>
class ControlSteps {
  using Number = std::uint32_t;

 public:
  explicit ControlSteps(const RunState& run)
      : control_{run.topology, run.scenario},
        has_types_{run.scenario.deployment.types.has_value()},
        lookups_{run.scenario, run.topology} {}

  [[nodiscard]] Number pair_of_control(Number relation) const { return control_.pair_of(relation); }
  [[nodiscard]] Number writer_of_control(Number relation) const {
    return control_.writer_of(relation);
  }
  [[nodiscard]] static Number participant_of_control(Number writer) {
    return writer / control_writers;
  }

  // What only the host knows.
  template <class World>
  [[nodiscard]] bool answer(control::OfTopic, const World& w) const {
    return !control_.is_builtin(w.template number<comp::owner::control_relation>());
  }
  template <class World>
  [[nodiscard]] bool answer(lookup::HaveTypes, const World&) const {
    return has_types_;
  }
  template <class World>
  [[nodiscard]] bool answer(lookup::OfLookups, const World& w) const {
    return control_.is_lookup(w.template number<comp::owner::control_relation>());
  }
  template <class World>
  [[nodiscard]] bool answer(lookup::OfAnswers, const World& w) const {
    return w.template number<comp::owner::control_writer>() % control_writers == 1;
  }
  template <class World>
  [[nodiscard]] bool answer(lookup::KnowsType, const World& w) const {
    const auto relation = w.template number<comp::owner::relation>();
    const Number j = host().topology().pair(relation / 2).destination;
    return lookups_.knows(j, lookups_.looked_up(relation, w.descriptor()),
                          {host().template first<rules::Exists>(2 * j),
                           host().template first<rules::Exists>(2 * j + 1)});
  }
  template <class World>
  [[nodiscard]] bool answer(lookup::SomebodyWaits, const World& w) {
    return !lookups_.waiting_with(w.template number<comp::owner::relation>(), w.descriptor())
                .empty();
  }
  template <class World>
  [[nodiscard]] bool answer(lookup::SomebodyWaitsForType, const World& w) {
    const Number looked_up =
        lookups_.looked_up(w.template number<comp::owner::relation>(), w.descriptor());
    const Number j =
        host().topology().pair(w.template number<comp::owner::relation>() / 2).destination;
    return !lookups_.waiting(j, looked_up).empty() || !lookups_.waiting(j, looked_up ^ 1U).empty();
  }
  template <class World>
  [[nodiscard]] bool answer(lookup::FirstOnesWait, const World& w) {
    return !lookups_.first_ones(w.template number<comp::owner::pair>(), 1).empty();
  }
  // What the last sample of a writer says.
  template <class World>
  [[nodiscard]] std::int64_t answer(lookup::SentLookup, const World& w) const {
    return last_sample(w).looked_up;
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(lookup::SentStage, const World& w) const {
    return last_sample(w).stage;
  }
  template <class World>
  [[nodiscard]] bool answer(lookup::IsAddressee, const World& w) const {
    const Pair& ends = host().topology().pair(w.template number<comp::owner::pair>());
    return last_sample(w).addressee == ends.destination;
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(lookup::LookupOfDescriptor, const World& w) const {
    return lookups_.looked_up(w.template number<comp::owner::relation>(), w.descriptor());
  }
  void assign(rules::WaitsForType, Number relation, Number d, bool waits) {
    auto& list = lookups_.waiting_with(relation, d);
    waits ? list.push_back({relation, d})
          : static_cast<void>(std::erase(list, Lookups::Waiting{relation, d}));
  }

  // Packets of these relations.
  [[nodiscard]] static std::int64_t said(lookup::SampleCount, const Packet& packet) {
    return packet.last_sample();
  }
  [[nodiscard]] static std::int64_t said(lookup::SampleNumber, const Packet& packet) {
    return packet.last_sample();
  }
  [[nodiscard]] std::int64_t said(lookup::Stage, const Packet& packet) const {
    return sample_in(packet).stage;
  }
  [[nodiscard]] std::int64_t said(lookup::LookedUp, const Packet& packet) const {
    return sample_in(packet).looked_up;
  }
  [[nodiscard]] bool said(lookup::IsForReader, const Packet& packet) const {
    return sample_in(packet).addressee == host().topology().pair(packet.pair).destination;
  }
  /// Calls `take(tag, packet)` for one sample after the other, and then for the HEARTBEAT.
  template <class Take>
  static void take_samples(const Packet& packet, Take&& take) {
    Packet sample;
    sample.become(packet);
    const Number last = packet.last_sample();
    for (Number number = last - std::min(last, packet.samples()) + 1; number <= last; ++number) {
      sample.set_samples(1, number);
      take(lookup::LookupSample{}, sample);
    }
    if (packet.heartbeats > 0) take(control::UserHeartbeat{}, packet);
  }

  // Opaque steps.
  template <class World>
  void perform(lookup::QueueSample, World& w, std::int64_t stage, std::int64_t looked_up) {
    const auto number = w.template number<comp::owner::pair>();
    const Pair& pair = host().topology().pair(number);
    lookups_.queue(number,
                   {pair.destination, static_cast<Number>(looked_up), static_cast<Number>(stage)});
    ++host().template at<lookup::SamplesQueued>(pair.source);
  }
  template <class World>
  void perform(lookup::LearnType, World& w) {
    const Number looked_up = sample_in(w.packet()).looked_up;
    const Number j = host().topology().pair(w.template number<comp::owner::pair>()).destination;
    for (const Number type : lookups_.types_of(looked_up)) {
      lookups_.learn(j, type);
      for (const Number s : {0U, 1U}) {
        const std::vector<Lookups::Waiting> list = lookups_.waiting(j, 2 * type + s);
        for (const auto& [relation, d] : list) {
          run_rule<comp::Happens<lookup::TypeIsKnown>>(w.host(), relation, nullptr, d);
        }
      }
    }
  }

 protected:
  /// The oldest sample of the queue of participant i is sent.
  template <class World>
  void send_sample(World& w, Number i) {
    --host().template at<lookup::SamplesQueued>(i);
    run_rule<comp::Happens<lookup::SampleLeaves>>(w.host(), lookups_.take(i));
  }

  const ControlRelations control_;
  const bool has_types_;
  Lookups lookups_;

 private:
  template <class World>
  [[nodiscard]] const Sample& last_sample(const World& w) const {
    return lookups_.last_sample(w.template number<comp::owner::control_writer>());
  }
  [[nodiscard]] Host& host() { return static_cast<Host&>(*this); }
  [[nodiscard]] const Host& host() const { return static_cast<const Host&>(*this); }
  /// The sample that is received, in a packet that has no other.
  [[nodiscard]] const Sample& sample_in(const Packet& packet) const {
    return lookups_.sample(control_.writer_of(packet.detail), packet.last_sample());
  }
};

}  // namespace stormproof::model::fastdds
