// What was before the run, who hears whom, and who is new.
#include "model/fastdds/living_protocol.hpp"

#include <algorithm>
#include <utility>

#include "model/engine/endpoint_creations.hpp"

namespace stormproof::model::fastdds {

bool LivingProtocol::was_there_before(std::uint32_t i) const {
  return std::ranges::find(life_.stale, i, &StaleRelation::writer) != life_.stale.end();
}

void LivingProtocol::start() {
  for (const StaleRelation& stale : life_.stale) open_before(stale.writer, stale.reader);
  Protocol::start();
  for (std::uint32_t i = 0; i < topology().participant_count(); ++i) {
    // Its endpoints exist already.
    if (was_there_before(i)) cancel(Creations{}, i);
  }
  schedule_returns();
}

void LivingProtocol::open_before(std::uint32_t i, std::uint32_t j) {
  const std::uint32_t there = topology().pair_between(i, j);
  const std::uint32_t back = topology().pair(there).reverse;
  assign(comp::Recognised{}, back, true);
  hear_from(back);
  for (std::uint32_t s = 0; s < 2; ++s) {
    // The writer side of (i, j, s).
    const std::uint32_t outward = 2 * there + s;
    set_first<rules::Exists>(2 * i + s, topology().descriptor_count(outward));
    RunningWorld<LivingProtocol, comp::owner::relation> w{*this, outward};
    w.feed_each(rules::C{}, comp::on<fsm::change_for_reader::ReaderMatched>);
    w.feed_each(rules::C{}, comp::on<fsm::change_for_reader::AckNackReceived>, [](auto&) {
      return fsm::ChangeForReaderIo::Input<LaneDomain>{.listed = Lanes{false},
                                                       .below_base = Lanes{true}};
    });
    assign(rules::WriterOpen{}, outward, true);
    assign(rules::SomeConfirmed{}, outward, true);
    // The reader side of (j, i, s).
    const std::uint32_t inward = 2 * back + s;
    RunningWorld<LivingProtocol, comp::owner::relation> r{*this, inward};
    const DescriptorSet all = r.set_of(comp::everyone);
    take(changes(), inward, all, is_required(inward));
    set_first<rules::Known>(inward, topology().descriptor_count(inward));
    set_first<rules::HandedOver>(inward, topology().descriptor_count(inward));
    at<comp::Reader>(inward) =
        fsm::Reflect<fsm::DiscoveryReader>::id<fsm::discovery_reader::Complete>;
    at<comp::HeartbeatSeen>(inward) = true;
  }
  open_topics_before(there, back);
}

/// i's sides of the control-only relations of both directions are open, and it has heard of the
/// other's writers.
void LivingProtocol::open_topics_before(std::uint32_t there, std::uint32_t back) {
  const auto [first_there, end_there] = control_.of(there);
  for (std::uint32_t relation = first_there; relation < end_there; ++relation) {
    at<control::ControlWriterSide>(relation) =
        fsm::Reflect<fsm::ControlWriter>::id<fsm::control_relation::Open>;
  }
  const auto [first_back, end_back] = control_.of(back);
  for (std::uint32_t relation = first_back; relation < end_back; ++relation) {
    at<control::ControlReaderSide>(relation) =
        fsm::Reflect<fsm::ControlReader>::id<fsm::control_relation::Open>;
    at<control::ControlHeartbeatSeen>(relation) = true;
  }
}

void LivingProtocol::take_descriptors(std::uint32_t relation, const DescriptorSet& received) {
  if (received.empty()) {
    lose(changes(), relation, is_required(relation));
  } else {
    take(changes(), relation, received, is_required(relation));
  }
}

void LivingProtocol::assign(rules::WriterOpen open, std::uint32_t relation, bool matched) {
  LivingHost::assign(open, relation, matched);
  if (matched) return;
  for (std::vector<std::uint32_t>& batch : cycles_[writer_of(relation)].batches) {
    std::erase(batch, relation);
  }
}

void LivingProtocol::hear_from(std::uint32_t pair) {
  RunningWorld<LivingProtocol, comp::owner::pair>{*this, pair}.call(comp::HearFrom{});
}

void LivingProtocol::forget_topics(std::uint32_t there) {
  const auto [first_there, end_there] = control_.of(there);
  for (std::uint32_t relation = first_there; relation < end_there; ++relation) {
    at<control::ControlWriterSide>(relation) = fsm::Stepper<fsm::ControlWriter>::initial;
  }
  const auto [first_back, end_back] = control_.of(topology().pair(there).reverse);
  for (std::uint32_t relation = first_back; relation < end_back; ++relation) {
    at<control::ControlReaderSide>(relation) = fsm::Stepper<fsm::ControlReader>::initial;
    at<control::ControlInitialTimer>(relation) = fsm::Stepper<fsm::InitialAckNack>::initial;
    at<control::ControlReply>(relation) = fsm::Stepper<fsm::SingleShot>::initial;
    at<control::ControlHeartbeatSeen>(relation) = false;
    at<control::ControlLastDelay>(relation) = 0;
    cancel(control::ControlInitialAttempt{}, relation);
    cancel(control::ControlReplyDue{}, relation);
  }
}

void LivingProtocol::lose_all(std::uint32_t i) {
  const auto of_participant = [&] {
    cancel(Creations{}, i);
    renew(rules::AsyncRun{}, i);
    cancel(rules::AsyncRunDue{}, i);
    participants_[i] = {};
  };
  const auto of_writer = [&](std::uint32_t w) {
    renew(rules::NackResponse{}, w);
    cancel(rules::NackResponseDue{}, w);
    set_first<rules::Exists>(w, 0);
    set_first<rules::Enqueued>(w, 0);
  };
  LivingHost::lose_all<rules::Life>(*this, i, of_participant, of_writer);
}

std::optional<std::uint32_t> LivingProtocol::sender_of(const Event& event) const {
  const std::optional<std::uint32_t> actor = actor_of_timer(*this, event);
  return actor ? actor : Protocol::sender_of(event);
}

void LivingProtocol::handle(const Event& event) {
  const std::optional<std::uint32_t> actor = sender_of(event);
  if (actor && is_away(life_, *actor, run_.now)) return;
  if (event.kind == EventKind::endpoint_creation) {
    if (is_due(Creations{}, event)) create(*this, event);
    return;
  }
  run_due(*this, event);
  if (event.kind == EventKind::participant_start) schedule_creations(run_, event.subject, run_.now);
}

void LivingProtocol::received(const Packet& packet, std::uint32_t receiver) {
  const Pair* const ends = packet.multicast() ? nullptr : &topology().pair(packet.pair);
  const std::uint32_t sender = ends == nullptr      ? packet.pair
                               : packet.to_writer() ? ends->destination
                                                    : ends->source;
  if (hears(run_.scenario.deployment, sender, receiver, packet.emitted, run_.now))
    take_in(*this, packet, receiver);
}

}  // namespace stormproof::model::fastdds
