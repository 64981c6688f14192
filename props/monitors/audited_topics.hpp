// Control-only relations of Fast DDS beside a run (`OpenTopics` of fsm/composition/control.hpp):
// each side that has what it needs is open. Liveliness and what asks for types need that its
// participant has recognised the other one; a topic needs that it has created its endpoint there
// and has been notified of the other's. Where endpoints have types discovery is complete when the
// last one is notified.
#pragma once

#include <cstdint>
#include <vector>

#include "model/fastdds/lookups.hpp"
#include "props/monitors/audited_steps.hpp"

namespace stormproof::props {

template <class Self, class Base, class Of>
class AuditedTopics : public AuditedSteps<Self, Base, Of>,
                      public model::fastdds::ControlSteps<Self> {
  using Steps = AuditedSteps<Self, Base, Of>;
  using Control = model::fastdds::ControlSteps<Self>;

 public:
  template <comp::Owner owner>
  using World = typename Steps::template World<owner>;
  using typename Steps::Composition;
  using typename Steps::Number;

  AuditedTopics(model::RunState& run, Audit& audit)
      : Steps{run, audit},
        Control{run},
        readers_(model::fastdds::control_writers * std::size_t{run.topology.participant_count()}) {}

  // The host of a RunningWorld.
  using Control::answer;
  using Control::assign;
  using Control::perform;
  using Control::said;
  using Steps::answer;
  using Steps::assign;
  using Steps::changed;
  using Steps::perform;
  using Steps::said;
  void changed(lookup::GetsSamples, Number relation, bool) {
    readers_[this->writer_of_control(relation)].push_back(relation);
  }
  [[nodiscard]] const std::vector<Number>& readers_of_control(Number writer) const {
    return readers_[writer];
  }

  template <class W>
  void perform(lookup::SendSamples, W& w) {
    const auto i = w.template number<comp::owner::participant>();
    this->go_on(i);
    while (this->lookups_.has_queued(i)) {
      this->send_sample(w, i);
      if (this->lookups_.has_queued(i) && leaves_samples(i)) return;
    }
  }
  /// Descriptors come when all samples have been sent; otherwise the queue has been left.
  template <class Visit>
  void for_queue(Number i, Visit&& visit) {
    if (!this->lookups_.has_queued(i)) Steps::for_queue(i, visit);
  }

  /// Between the participant and one peer, or any. The notification that ends the run opens
  /// nothing.
  template <class W>
  void perform(control::OpenTopics, W& w) {
    if constexpr (W::place == comp::owner::descriptor) {
      const auto pair = w.template number<comp::owner::pair>();
      if (this->has_types_ && this->topology().pair(pair).cross_host) --this->run_.missing;
      if (this->run_.ends_now()) return;
    }
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
    for_relations(there, [&](Number n) { this->renew(control::ControlWriterSide{}, n); });
    for_relations(this->topology().pair(there).reverse, [&](Number n) {
      World<comp::owner::control_relation> side{this->self(), n};
      Rules::forget_reader(side);
    });
  }

 protected:
  void open_topics_before(Number there, Number back) {
    for_relations(there, [&](Number n) {
      this->state(control::ControlWriterSide{}, n) =
          fsm::Reflect<fsm::ControlWriter>::id<fsm::control_relation::Open>;
    });
    for_relations(back, [&](Number n) {
      this->state(control::ControlReaderSide{}, n) =
          fsm::Reflect<fsm::ControlReader>::id<fsm::control_relation::Open>;
      this->assign(control::ControlHeartbeatSeen{}, n, true);
    });
  }
  /// Each side at the destination of the pair that has what it needs is open: those of liveliness
  /// and topics first, of the reader and then of the writer.
  void open_sides(Number pair) {
    const Number back = this->topology().pair(pair).reverse;
    for (const bool of_lookups : {false, true}) {
      if (of_lookups && !has_lookups(pair)) return;
      for_relations(pair, [&](Number n) {
        if (this->control_.is_lookup(n) != of_lookups) return;
        open(control::ControlReaderSide{}, control::ControlReaderOpens{}, n, pair);
      });
      for_relations(back, [&](Number n) {
        if (this->control_.is_lookup(n) != of_lookups) return;
        open(control::ControlWriterSide{}, control::ControlWriterOpens{}, n, pair);
      });
    }
  }

 private:
  /// A sample mostly shows in nothing but its message. Its participant stalls after what was sent
  /// last; what it sends next was sent just now only if the message takes no more.
  bool leaves_samples(Number i) {
    const bool is_now = this->audit_.next_message() == nullptr || this->open_is_full();
    return is_now && this->leaves_queue(i);
  }
  template <class Visit>
  void for_relations(Number pair, Visit&& visit) {
    const auto [first, end] = this->control_.of(pair);
    for (Number n = first; n < end; ++n) visit(n);
  }
  /// They are the last ones of a pair, and of both its directions.
  [[nodiscard]] bool has_lookups(Number pair) const {
    const auto [first, end] = this->control_.of(pair);
    return first < end && this->control_.is_lookup(end - 1);
  }
  /// One of relation n, at the destination of the pair.
  template <class Side, class Opens>
  void open(Side side, Opens opens, Number n, Number pair) {
    if (this->state(side, n) != fsm::Stepper<typename Side::Machine>::initial) return;
    constexpr bool writes = std::is_same_v<Side, control::ControlWriterSide>;
    constexpr model::Stream own = writes ? model::Stream::pub : model::Stream::sub;
    constexpr model::Stream other = writes ? model::Stream::sub : model::Stream::pub;
    if (this->control_.is_builtin(n) ? !this->value(comp::Recognised{}, pair)
                                     : !is_known(n, pair, own, other)) {
      return;
    }
    World<comp::owner::control_relation> w{this->self(), n};
    w.raise(opens);
  }
  /// The destination of the pair has created its endpoint of the relation's topic and has been
  /// notified of the source's.
  [[nodiscard]] bool is_known(Number n, Number pair, model::Stream own, model::Stream other) const {
    const Number topic = this->control_.topic_of(n);
    const auto writer =
        static_cast<Number>(2 * this->topology().pair(pair).destination + model::index_of(own));
    const auto relation = static_cast<Number>(2 * pair + model::index_of(other));
    const Number theirs = model::fastdds::descriptor_on(topic, other);
    return this->has(typename Composition::Exists{}, writer,
                     model::fastdds::descriptor_on(topic, own)) &&
           this->has(comp::fastdds::HandedOver{}, relation, theirs) &&
           !(this->has_types_ && this->lookups_.waits(relation, theirs));
  }

  std::vector<std::vector<Number>> readers_;  // of samples, by writer, as they were matched
};

}  // namespace stormproof::props
