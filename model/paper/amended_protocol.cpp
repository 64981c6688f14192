// What was before the run, who hears whom, and the account of `linear_group`.
#include "model/paper/amended_protocol.hpp"

#include <algorithm>

namespace stormproof::model::paper {

namespace reader = fsm::discovery_reader;

AmendedProtocol::AmendedProtocol(RunState& run, Network& network)
    : ProtocolOf{run, network},
      amendments_{run.scenario.dds.amendments.value()},
      life_{run.scenario.deployment.life.value_or(Life{})},
      resent_(run.topology.relation_count()),
      retries_(run.topology.relation_count()),
      accounts_(run.topology.participant_count()),
      answered_(2 * std::size_t{run.topology.participant_count()}) {
  std::apply([&](auto&... each) { (each.of.resize(run.topology.relation_count()), ...); }, memory_);
}

void AmendedProtocol::start() {
  for (const StaleRelation& stale : life_.stale) {
    open_before(stale.writer, stale.reader);
  }
  ProtocolOf::start();
}

void AmendedProtocol::open_before(std::uint32_t i, std::uint32_t j) {
  const std::uint32_t there = topology().pair_between(i, j);
  const std::uint32_t back = topology().pair(there).reverse;
  assign(comp::Recognised{}, back, true);
  for (std::uint32_t s = 0; s < 2; ++s) {
    // The writer side of (i, j, s).
    const std::uint32_t outward = 2 * there + s;
    RunningWorld<AmendedProtocol, comp::owner::relation> w{*this, outward};
    w.feed_each(amended::C{}, comp::on<fsm::descriptor_repair::AckNackReceived>, [](auto&) {
      return fsm::DescriptorRepairIo::Input<LaneDomain>{
          .listed = Lanes{false}, .below_first_missing = Lanes{true}, .prefix_only = Lanes{false}};
    });
    assign(comp::paper::WriterOpen{}, outward, true);
    assign(amended::OldCounts{}, outward, amendments_.count_filter);
    // The reader side of (j, i, s).
    const std::uint32_t inward = 2 * back + s;
    RunningWorld<AmendedProtocol, comp::owner::relation> r{*this, inward};
    assign_each(comp::X{}, inward, r.set_of(comp::everyone));
    readers_[inward].state = fsm::Reflect<fsm::DiscoveryReader>::id<reader::Complete>;
    readers_[inward].heartbeat_seen = true;
  }
}

bool AmendedProtocol::is_silent(std::uint32_t participant, Nanoseconds time) const {
  return std::ranges::any_of(life_.mute, [&](const Mute& mute) {
    return mute.participant == participant && time >= mute.from;
  });
}

bool AmendedProtocol::hears(std::uint32_t i, std::uint32_t j, Nanoseconds emitted) const {
  if (!has_started(j) || is_silent(i, emitted) || is_silent(j, run_.now)) return false;
  return std::ranges::none_of(life_.outages, [&](const Outage& outage) {
    return outage.from == i && outage.to == j && run_.now >= outage.start && run_.now < outage.end;
  });
}

/// Readers act in their relations at the destination, writers at the source.
std::uint32_t AmendedProtocol::actor_of(const Event& event) const {
  switch (event.kind) {
    case EventKind::announcement_due:
      return event.subject;
    case EventKind::acknack_generation:
    case EventKind::initial_acknack_due:
      return ends(event.subject).destination;
    case EventKind::repair_generation:
    case EventKind::suppression_end:
      return ends(event.subject).source;
    case EventKind::reply_time:
      return topology().pair(event.subject).source;
    default:
      return event.subject / 2;  // of a writer
  }
}

void AmendedProtocol::handle(const Event& event) {
  if (!is_silent(actor_of(event), run_.now)) run_due(*this, event);
}

void AmendedProtocol::received(const Packet& packet, std::uint32_t) {
  take_in(*this, packet,
          [&](std::uint32_t i, std::uint32_t j) { return hears(i, j, packet.emitted); });
}

void AmendedProtocol::source_completed(const Packet& packet) {
  if (packet.kind != PacketKind::data) return;
  run_rule<comp::LeftSource<comp::paper::Data>>(*this, packet.relation(), &packet);
}

void AmendedProtocol::renew_bitmap(Packet& acknack) {
  RunningWorld<AmendedProtocol, comp::owner::relation> w{*this, acknack.relation()};
  acknack.descriptors = w.set_of(said_of<comp::Listed>(amended::Implementation::bitmap()));
}

bool AmendedProtocol::uses_up_budget(std::uint32_t w, std::int64_t added_bytes) {
  if (amendments_.piggyback_account == PiggybackAccount::of_the_profile) {
    return ProtocolOf::uses_up_budget(w, added_bytes);
  }
  Account& account = accounts_[w / 2];
  account.bytes += added_bytes;
  if (account.bytes > sedp_.piggyback_threshold_bytes.count()) {
    account.bytes -= sedp_.piggyback_threshold_bytes.count();
    ++account.overflows;
  }
  return std::exchange(answered_[w], account.overflows) != account.overflows;
}

}  // namespace stormproof::model::paper
