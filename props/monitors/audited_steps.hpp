// Opaque steps of rules that are executed beside a run: by their contracts, but for those that are
// about the cycle of HEARTBEATs, about which topics there are, or about all peers of a participant.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "fsm/adaptive_period.hpp"
#include "fsm/composition/lookups.hpp"
#include "props/monitors/audited_packets.hpp"

namespace stormproof::props {

namespace lookup = comp::lookup;

template <class Self, class Base, class Of>
class AuditedSteps : public AuditedPackets<Self, Base, Of> {
  using Packets = AuditedPackets<Self, Base, Of>;
  static constexpr bool has_topics = has_part<typename Of::Composition, control::ControlWriterSide>;

 public:
  using NotFollowed = fsm::TypeList<lookup::HaveTypes, lookup::OfLookups, lookup::KnowsType,
                                    lookup::SomebodyWaits, lookup::LookupOfDescriptor,
                                    lookup::SentLookup, lookup::SentStage, lookup::IsAddressee>;
  template <comp::Owner owner>
  using World = typename Packets::template World<owner>;
  using typename Packets::Composition;
  using typename Packets::Number;

  AuditedSteps(model::RunState& run, Audit& audit) : Packets{run, audit} {
    if constexpr (has_topics) topics_.emplace(run.topology);
  }

  template <class Step, class W, class... Args>
  void perform(Step, W& w, const Args&... args) {
    if constexpr (requires { typename Step::SendsBatch; }) {
      send_batch<typename Step::SendsBatch>(w);
    } else if constexpr (requires { typename Step::ForgetsTopics; }) {
      forget_topics<typename Step::ForgetsTopics>(w);
    } else if constexpr (requires { typename Step::LosesAll; }) {
      lose_all<typename Step::LosesAll>(w);
    } else if constexpr (requires { typename Step::FillsMessage; }) {
      this->fill([&] { Step::contract(w, args...); });
    } else if constexpr (requires { typename Step::SendsMessage; }) {
      this->flush();
    } else {
      Step::contract(w, args...);
    }
  }

  // Batches: the silent readers of a cycle.
  template <class W>
  void perform(comp::PlanBatches, W& w, const std::int64_t& period) {
    auto& batches = batches_[w.template number<comp::owner::writer>()];
    batches.clear();
    const auto size = fsm::batch_size<fsm::Plain>({.contacted = w(comp::ContactedCount{}),
                                                   .responded = w(comp::RespondedCount{}),
                                                   .epsilon_num = w(comp::EpsilonNumerator{}),
                                                   .epsilon_den = w(comp::EpsilonDenominator{})});
    w.for_readers_by_number([&](auto& r) {
      if (!r(comp::Contacted{}) || r(comp::Responded{})) return;
      if (batches.empty() || std::ssize(batches.back()) == size) batches.emplace_back();
      batches.back().push_back(r.template number<comp::owner::relation>());
    });
    const std::int64_t rest = period - w(comp::CyclePeriod{});
    const std::int64_t count = std::ssize(batches);
    for (std::int64_t k = 0; k < count; ++k) {
      w.at(this->now() + rest * k / count, comp::BatchDue{});
    }
    std::ranges::reverse(batches);
  }
  /// A side that closes loses its turn in the cycle of its writer.
  void loses_turn(Number writer, Number relation) {
    for (auto& batch : batches_[writer]) std::erase(batch, relation);
  }

  // Topics.
  [[nodiscard]] Number pair_of_control(Number topic) const { return topics_->pair_of(topic); }
  using Packets::answer;
  template <class W>
  [[nodiscard]] bool answer(control::OfTopic, const W& w) const {
    return !topics_->is_liveliness(w.template number<comp::owner::control_relation>());
  }
  // What asks for types: runs in which somebody does are not followed (props/applicability.cpp).
  template <class Tag, class W>
  requires(model::detail::is_listed<Tag>(NotFollowed{}))
      [[nodiscard]] auto answer(Tag, const W&) const {
    if constexpr (std::derived_from<Tag, comp::Amount>) {
      return std::int64_t{0};
    } else {
      return false;
    }
  }
  [[nodiscard]] Number writer_of_control(Number topic) const {
    const model::Pair& ends = this->topology().pair(pair_of_control(topic));
    return model::fastdds::control_writers * (ends.source + 1) - 1;
  }
  [[nodiscard]] static Number participant_of_control(Number writer) {
    return writer / model::fastdds::control_writers;
  }
  [[nodiscard]] static std::vector<Number> readers_of_control(Number) { return {}; }
  template <class W>
  void perform(lookup::SendSamples, W&) {}
  template <class W>
  void perform(lookup::LearnType, W&) {}
  /// Between the participant and one peer, or any.
  template <class W>
  void perform(control::OpenTopics, W& w) {
    if constexpr ((W::place.indices & comp::owner::peer_index) != 0) {
      open_sides(w.template number<comp::owner::pair>());
    } else {
      const Number i = w.template number<comp::owner::participant>();
      const model::Topology& topology = this->topology();
      for (Number n = topology.first_pair(i); n < topology.first_pair(i + 1); ++n) {
        open_sides(topology.pair(n).reverse);
      }
    }
  }

  /// The sides that the pair's source has of relations with its destination are new ones.
  template <class Rules, class W>
  void forget_topics(W& w) {
    const Number there = w.template number<comp::owner::pair>();
    for_topics(there, true, [&](Number topic, const ControlSides::Needs&) {
      this->renew(control::ControlWriterSide{}, topic);
    });
    const Number back = this->topology().pair(there).reverse;
    for_topics(back, false, [&](Number topic, const ControlSides::Needs&) {
      World<comp::owner::control_relation> side{this->self(), topic};
      Rules::forget_reader(side);
    });
  }

 protected:
  void open_topics_before(Number there, Number back) {
    for_topics(there, true, [&](Number topic, const ControlSides::Needs&) {
      this->state(control::ControlWriterSide{}, topic) =
          fsm::Reflect<fsm::ControlWriter>::id<fsm::control_relation::Open>;
    });
    for_topics(back, false, [&](Number topic, const ControlSides::Needs&) {
      this->state(control::ControlReaderSide{}, topic) =
          fsm::Reflect<fsm::ControlReader>::id<fsm::control_relation::Open>;
      this->assign(control::ControlHeartbeatSeen{}, topic, true);
    });
  }
  /// Each side at the destination of the pair that has what it needs is open.
  void open_sides(Number pair) {
    for_topics(pair, false, [&](Number topic, const ControlSides::Needs& needs) {
      open(control::ControlReaderSide{}, control::ControlReaderOpens{}, topic, needs);
    });
    for_topics(this->topology().pair(pair).reverse, true,
               [&](Number topic, const ControlSides::Needs& needs) {
                 open(control::ControlWriterSide{}, control::ControlWriterOpens{}, topic, needs);
               });
  }
  template <class Visit>
  void for_topics(Number pair, bool of_writer, Visit&& visit) {
    topics_->for_each(pair, of_writer, visit);
  }

 private:
  template <class Side, class Opens>
  void open(Side side, Opens opens, Number topic, const ControlSides::Needs& needs) {
    if (this->state(side, topic) != fsm::Stepper<typename Side::Machine>::initial) return;
    const bool ready =
        needs.liveliness ? this->value(comp::Recognised{}, needs.pair)
                         : this->has(typename Composition::Exists{}, needs.writer, needs.created) &&
                               this->has(comp::fastdds::HandedOver{}, 2 * needs.pair + needs.stream,
                                         needs.notified);
    if (!ready) return;
    World<comp::owner::control_relation> w{this->self(), topic};
    w.raise(opens);
  }
  /// A HEARTBEAT to each reader of the next batch that still waits.
  template <class Writer, class W>
  void send_batch(W& w) {
    auto& batches = batches_[w.template number<comp::owner::writer>()];
    if (batches.empty()) return;
    const std::vector<Number> batch = std::move(batches.back());
    batches.pop_back();
    for (const Number relation : batch) {
      World<comp::owner::relation> r{this->self(), relation};
      if (r(typename Writer::Waits{})) Writer::heartbeat(r);
    }
  }
  /// All peers are forgotten, known or not, then come the writers.
  template <class Life, class W>
  void lose_all(W& w) {
    const Number i = w.template number<comp::owner::participant>();
    this->forget_creations(i);
    Life::lose_participant(w);
    const model::Topology& topology = this->topology();
    for (Number n = topology.first_pair(i); n < topology.first_pair(i + 1); ++n) {
      World<comp::owner::pair> back{this->self(), topology.pair(n).reverse};
      back.call(typename Life::Forget{});
    }
    for (const Number writer : {2 * i, 2 * i + 1}) {
      World<comp::owner::writer> of_writer{this->self(), writer};
      Life::lose_writer(of_writer);
    }
  }

  std::map<Number, std::vector<std::vector<Number>>> batches_;  // by writer; the last is next
  std::optional<ControlSides> topics_;
};

}  // namespace stormproof::props
