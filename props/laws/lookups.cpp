// law.lookups: who meets a type that it does not know asks for it once, its dependencies and then
// the type itself; or, where that is the unit, for all types of a participant at once; each
// question is answered; and a descriptor is told of when its type is known, no earlier and no
// later. From packets, counts and the types of the deployment: what a question says, and whom it is
// for, the watch does not see.
#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "model/fastdds/types.hpp"
#include "props/laws/asking.hpp"
#include "props/laws/families.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/relation_words.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;
using model::PacketKind;
using Number = std::uint32_t;

/// A lookup is two questions and two answers.
constexpr std::size_t samples_of_a_side = 2;

class LookupWatch : public AskingWatch {
 public:
  explicit LookupWatch(const model::Scenario& scenario)
      : AskingWatch{"law.lookups", scenario}, types_{scenario.deployment} {}

  void run_started(const model::Topology& topology) override {
    AskingWatch::run_started(topology);
    missing_ = topology.required_deliveries();
    participants_.assign(topology.participant_count(), {});
    sent_.assign(fastdds::control_writers * std::size_t{topology.participant_count()}, 0);
    received_.reset(topology);
    handed_over_.assign(topology.relation_count(), 0);
  }
  void event_started(const model::Event& event) override {
    if (event.time > now()) judge_rest();
    if (event.kind == model::EventKind::endpoint_creation) create(event.subject, event.detail);
    AskingWatch::event_started(event);
  }
  void event_finished(const model::Depths& depths) override {
    judge_deliveries(static_cast<std::size_t>(missing_ - depths.missing));
    missing_ = depths.missing;
  }
  void received(const model::Packet& packet, Number receiver) override {
    AskingWatch::received(packet, receiver);
    if (packet.kind == PacketKind::data && has_recognised(packet.pair)) take(packet);
    if (packet.kind != PacketKind::lookup || !asks()) return;
    under_way_ -= packet.samples();
    has_changed_ = true;
    const bool answers = control().writer_of(packet.detail) % fastdds::control_writers == 1;
    if (answers) participants_[topology().pair(packet.pair).destination].is_answered = true;
  }

 private:
  struct Participant {
    std::set<Number> own;  ///< types of the endpoints that it has created
    /// Types of others that were not its own then, and the streams of these.
    std::set<std::pair<Number, Number>> met;
    std::size_t waiting = 0;  ///< descriptors
    // In this event:
    std::size_t known = 0;    ///< descriptors that came, of its own types
    std::size_t perhaps = 0;  ///< of types that it has met before
    bool is_answered = false;
  };

  void create(Number i, Number k) {
    const Number publications = topology().descriptor_count(i, model::Stream::pub);
    const model::Endpoint endpoint =
        model::creation_order(k, publications - model::default_publications);
    participants_[i].own.insert(types_.of(i, endpoint.stream, endpoint.descriptor));
  }
  void said(const model::Packet& packet) override {
    if (packet.kind != PacketKind::lookup) return;
    has_changed_ = true;
    under_way_ += packet.samples();
    Number& sent = sent_[control().writer_of(packet.detail)];
    sent = std::max(sent, packet.last_sample());
  }
  /// Descriptors are handed over in their order.
  void take(const model::Packet& packet) {
    const Number relation = packet.relation();
    const model::Pair& pair = topology().pair(packet.pair);
    received_.add(relation, packet.descriptors);
    Number& d = handed_over_[relation];
    for (; d < topology().descriptor_count(relation) && received_.test(relation, d); ++d) {
      meet(pair, types_.of(pair.source, packet.stream, d), relation % 2);
    }
  }
  void meet(const model::Pair& pair, Number type, Number stream) {
    Participant& j = participants_[pair.destination];
    const std::size_t counts = pair.cross_host ? 1 : 0;
    if (!asks() || j.own.contains(type)) {
      j.known += counts;
      return;
    }
    const bool has_met_it = j.met.contains({type, 0}) || j.met.contains({type, 1});
    if (has_met_it) j.perhaps += counts;
    has_changed_ = true;
    j.waiting += counts;
    j.met.insert({type, stream});
  }

  /// What came of known types is told at once, the rest with answers.
  void judge_deliveries(std::size_t delivered) {
    if (!scenario().deployment.types) return;
    std::size_t least = 0;
    std::size_t most = 0;
    for (const Participant& j : participants_) {
      least += j.known;
      most += j.known + (j.is_answered ? j.waiting : j.perhaps);
    }
    if (delivered < least || delivered > most) {
      object_now(fmt::format("At {} participants are told of {} descriptors instead of {} to {}.",
                             time_text(now()), delivered, least, most));
    }
    std::size_t rest = delivered - std::min(delivered, least);
    for (Participant& j : participants_) {
      const std::size_t told = std::min(rest, j.is_answered ? j.waiting : j.perhaps);
      j.waiting -= told;
      rest -= told;
      j.known = j.perhaps = 0;
      j.is_answered = false;
    }
  }
  /// Before time goes on.
  void judge_rest() {
    if (!asks() || under_way_ != 0 || !std::exchange(has_changed_, false)) return;
    std::array<std::size_t, fastdds::control_writers> sent{};
    for (Number writer = 0; writer < sent_.size(); ++writer) {
      sent[writer % fastdds::control_writers] += sent_[writer];
    }
    if (sent[0] != sent[1]) {
      object_now(fmt::format("At {} there are {} answers to {} questions.", time_text(now()),
                             sent[1], sent[0]));
    }
    for (Number j = 0; j < participants_.size(); ++j) judge_questions(j);
  }
  void judge_questions(Number j) {
    const Participant& asker = participants_[j];
    std::set<Number> types;
    for (const auto& [type, stream] : asker.met) types.insert(type);
    const std::size_t asked = sent_[std::size_t{fastdds::control_writers} * j];
    const model::LookupUnit unit = scenario().dds.version.typelookup_unit;
    const std::size_t least = unit == model::LookupUnit::participant
                                  ? std::min<std::size_t>(types.size(), 1)
                                  : types.size();
    const std::size_t most = unit == model::LookupUnit::type ? types.size() : asker.met.size();
    const bool fits = asked >= samples_of_a_side * least && asked <= samples_of_a_side * most;
    if (fits && asker.waiting == 0) return;
    object_now(
        fmt::format("At {} participant {} has asked {} times about {} types, and {} "
                    "descriptors wait.",
                    time_text(now()), j, asked, types.size(), asker.waiting));
  }

  const fastdds::Types types_;
  std::uint64_t missing_ = 0;
  std::vector<Participant> participants_;
  std::vector<Number> sent_;  // samples, by control-only writer
  RelationWords received_;
  std::vector<Number> handed_over_;  // by relation
  std::size_t under_way_ = 0;        // samples
  bool has_changed_ = false;         // since time stood still last
};

constexpr Law lookups_list[] = {asking_law<LookupWatch>(
    "law.lookups",
    "A type that is not known is asked for once, alone or with others, and each question answered; "
    "descriptors are told of as soon as their types are known.")};

}  // namespace

std::span<const Law> lookup_laws() { return lookups_list; }

}  // namespace stormproof::props
