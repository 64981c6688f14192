// What was before the run, who hears whom, who is new, and the account of `linear_group`.
#include "model/paper/amended_protocol.hpp"

#include <algorithm>

namespace stormproof::model::paper {

namespace reader = fsm::discovery_reader;

namespace {
/// What observers are told of a machine that is a new one.
constexpr std::string_view renewed = "Renewed";
}  // namespace

AmendedProtocol::AmendedProtocol(RunState& run, Network& network)
    : ProtocolOf{run, network},
      amendments_{run.scenario.dds.amendments.value()},
      life_{run.scenario.deployment.life.value_or(Life{})},
      resent_(run.topology.relation_count()),
      retries_(run.topology.relation_count()),
      accounts_(run.topology.participant_count()),
      answered_(2 * std::size_t{run.topology.participant_count()}) {
  const std::uint32_t owners =
      std::max(run.topology.relation_count(), 2 * run.topology.participant_count());
  const auto resize = [&](auto&... each) { (each.of.resize(owners), ...); };
  std::apply(resize, memory_);
  std::apply(resize, cancelled_);
  forgets_ = forgets(life_);
  for (std::uint32_t i = 0; i < run.topology.participant_count(); ++i) {
    leases_.push_back(lease_of(life_, i).value_or(Nanoseconds{}).count());
  }
  for (std::uint32_t relation = 0; relation < run.topology.relation_count(); ++relation) {
    if (ends(relation).cross_host && !is_required(relation)) {
      run_.missing -= run.topology.descriptor_count(relation);
    }
  }
}

void AmendedProtocol::start() {
  for (const StaleRelation& stale : life_.stale) {
    open_before(stale.writer, stale.reader);
  }
  ProtocolOf::start();
  for (const Restart& restart : life_.restarts) {
    if (restart.identity == Identity::fresh) continue;
    run_.schedule(restart.start, EventKind::participant_start, restart.participant);
  }
}

void AmendedProtocol::open_before(std::uint32_t i, std::uint32_t j) {
  const std::uint32_t there = topology().pair_between(i, j);
  const std::uint32_t back = topology().pair(there).reverse;
  assign(comp::Recognised{}, back, true);
  RunningWorld<AmendedProtocol, comp::owner::pair>{*this, back}.call(amended::HearFrom{});
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

void AmendedProtocol::renew(comp::HeartbeatClock, std::uint32_t w) {
  const auto tokens = clocks_[w].tokens;
  clocks_[w] = {};
  clocks_[w].tokens = tokens;
}

void AmendedProtocol::renew(comp::Reader, std::uint32_t relation) {
  using States = fsm::Reflect<fsm::DiscoveryReader>;
  const fsm::StateId before = readers_[relation].state;
  const fsm::StateId after = topology().descriptor_count(relation) > 0
                                 ? States::id<reader::Unknown>
                                 : States::id<reader::EarlyComplete>;
  readers_[relation].state = after;
  if (run_.probe == nullptr) return;
  run_.probe->transition(
      {fsm::name_of<fsm::DiscoveryReader>(), MachineRef::Kind::relation, relation}, renewed,
      States::state_names[before], States::state_names[after], 0, 0);
}

void AmendedProtocol::renew(amended::C, std::uint32_t relation) {
  descriptors_.renew(relation, renewed);
  relations_[relation].unacknowledged = topology().descriptor_count(relation);
}

void AmendedProtocol::lose_all(std::uint32_t i) {
  renew(comp::AnnouncementTimer{}, i);
  cancel(comp::Announcement{}, i);
  participants_[i].sent_bytes = 0;
  accounts_[i] = {};
  for (std::uint32_t there = topology().first_pair(i); there < topology().first_pair(i + 1);
       ++there) {
    const std::uint32_t back = topology().pair(there).reverse;
    RunningWorld<AmendedProtocol, comp::owner::pair>{*this, back}.call(amended::Forget{});
    for (const std::uint32_t relation : {2 * back, 2 * back + 1}) {
      if (value(comp::paper::WriterOpen{}, relation)) {
        assign(amended::OldCounts{}, relation, amendments_.count_filter);
      }
    }
  }
  for (const std::uint32_t w : {2 * i, 2 * i + 1}) {
    renew(comp::HeartbeatClock{}, w);
    cancel(comp::HeartbeatExpiry{}, w);
    cancel(comp::CycleStart{}, w);
    cancel(comp::CycleEnd{}, w);
    cancel(comp::BatchDue{}, w);
    refill(w);
    answered_[w] = 0;
  }
}

std::vector<MissingDescriptor> AmendedProtocol::missing(std::size_t limit) {
  std::vector<MissingDescriptor> list = descriptors_.list_missing(SIZE_MAX);
  std::erase_if(list, [&](const MissingDescriptor& missing) {
    return is_replaced(life_, missing.source.value) ||
           is_replaced(life_, missing.destination.value);
  });
  list.resize(std::min(list.size(), limit));
  return list;
}

bool AmendedProtocol::hears(std::uint32_t i, std::uint32_t j, Nanoseconds emitted) const {
  if (!has_started(j) || is_away(life_, i, emitted) || is_away(life_, j, run_.now)) return false;
  return std::ranges::none_of(life_.outages, [&](const Outage& outage) {
    return outage.from == i && outage.to == j && run_.now >= outage.start && run_.now < outage.end;
  });
}

/// Readers act in their relations at the destination, writers at the source.
std::uint32_t AmendedProtocol::actor_of(const Event& event) const {
  switch (event.kind) {
    case EventKind::announcement_due:
    case EventKind::participant_start:
      return event.subject;
    case EventKind::acknack_generation:
    case EventKind::initial_acknack_due:
      return ends(event.subject).destination;
    case EventKind::repair_generation:
    case EventKind::suppression_end:
      return ends(event.subject).source;
    case EventKind::reply_time:
      return topology().pair(event.subject).source;
    case EventKind::lease_check:
      return topology().pair(event.subject).destination;
    default:
      return event.subject / 2;  // of a writer
  }
}

void AmendedProtocol::handle(const Event& event) {
  if (!is_away(life_, actor_of(event), run_.now)) run_due(*this, event);
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
