// What was before the run, who hears whom, who is new, and the account of `linear_group`.
#include "model/paper/amended_protocol.hpp"

#include <algorithm>
#include <utility>

namespace stormproof::model::paper {

namespace reader = fsm::discovery_reader;

AmendedProtocol::AmendedProtocol(RunState& run, Network& network)
    : Stored{run, network},
      amendments_{run.scenario.dds.amendments.value()},
      accounts_(run.topology.participant_count()),
      answered_(2 * std::size_t{run.topology.participant_count()}) {
  forgets_ = forgets(life_);
  for (std::uint32_t w = 0; w < writers_.size(); ++w) {
    const std::uint32_t all = run.topology.descriptor_count(w / 2, stream_of(w));
    const std::uint32_t at_start = all - late_descriptors(life_, w / 2, stream_of(w));
    at_start_.push_back(at_start);
    set_first<amended::Exists>(w, at_start);
  }
  for (std::uint32_t relation = 0; relation < run.topology.relation_count(); ++relation) {
    set_first<amended::Known>(relation, at_start_[writer_of(relation)]);
  }
}

void AmendedProtocol::start() {
  for (const StaleRelation& stale : life_.stale) {
    open_before(stale.writer, stale.reader);
  }
  ProtocolOf::start();
  schedule_returns();
  for (std::uint32_t k = 0; k < life_.endpoints.size(); ++k) {
    const LateEndpoints& late = life_.endpoints[k];
    run_.schedule(late.at, EventKind::endpoint_creation, late.participant, k);
    if (late.until) {
      run_.schedule(*late.until, EventKind::endpoint_creation, late.participant, k);
    }
  }
}

void AmendedProtocol::open_before(std::uint32_t i, std::uint32_t j) {
  const std::uint32_t there = topology().pair_between(i, j);
  const std::uint32_t back = topology().pair(there).reverse;
  assign(comp::Recognised{}, back, true);
  RunningWorld<AmendedProtocol, comp::owner::pair>{*this, back}.call(comp::HearFrom{});
  for (std::uint32_t s = 0; s < 2; ++s) {
    // The writer side of (i, j, s).
    const std::uint32_t outward = 2 * there + s;
    RunningWorld<AmendedProtocol, comp::owner::relation> w{*this, outward};
    const auto exists = [](auto& d) { return d(amended::Exists{}); };
    w.feed_each(
        amended::C{}, comp::on<fsm::descriptor_repair::AckNackReceived>,
        [](auto&) {
          return fsm::DescriptorRepairIo::Input<LaneDomain>{.listed = Lanes{false},
                                                            .below_first_missing = Lanes{true},
                                                            .prefix_only = Lanes{false}};
        },
        exists);
    assign(comp::paper::WriterOpen{}, outward, true);
    assign(amended::OldCounts{}, outward, amendments_.count_filter);
    // The reader side of (j, i, s).
    const std::uint32_t inward = 2 * back + s;
    RunningWorld<AmendedProtocol, comp::owner::relation> r{*this, inward};
    assign_each(comp::X{}, inward, r.set_of(exists));
    using States = fsm::Reflect<fsm::DiscoveryReader>;
    at<comp::Reader>(inward) =
        at<Lacking>(inward) == 0 ? States::id<reader::Complete> : States::id<reader::Recognised>;
    at<comp::HeartbeatSeen>(inward) = true;
  }
}

void AmendedProtocol::write(const LateEndpoints& endpoints) {
  for (const Stream s : streams) {
    const std::uint32_t w = 2 * endpoints.participant + static_cast<std::uint32_t>(s);
    const std::uint32_t count = s == Stream::pub ? endpoints.publications : endpoints.subscriptions;
    for (std::uint32_t k = 0; k < count; ++k) {
      run_rule<comp::Happens<amended::Written>>(*this, w, nullptr, first<amended::Exists>(w));
    }
  }
}

void AmendedProtocol::renew(amended::C, std::uint32_t relation) {
  planes().renew(relation, renewed);
  relations_[relation].unacknowledged = topology().descriptor_count(relation);
}

void AmendedProtocol::lose_all(std::uint32_t i) {
  const auto of_participant = [&] {
    participants_[i].sent_bytes = 0;
    accounts_[i] = {};
  };
  const auto of_writer = [&](std::uint32_t w) {
    answered_[w] = 0;
    for (std::uint32_t there = topology().first_pair(i); there < topology().first_pair(i + 1);
         ++there) {
      const std::uint32_t relation = 2 * topology().pair(there).reverse + w % 2;
      if (!value(comp::paper::WriterOpen{}, relation)) continue;
      assign(amended::OldCounts{}, relation, amendments_.count_filter);
    }
  };
  LivingHost::lose_all<amended::Life>(*this, i, of_participant, of_writer);
}

void AmendedProtocol::handle(const Event& event) {
  const bool changes_endpoints = event.kind == EventKind::endpoint_creation;
  const auto actor = changes_endpoints ? event.subject : actor_of_timer(*this, event);
  if (actor && is_away(life_, *actor, run_.now)) return;
  if (changes_endpoints) return write(life_.endpoints[event.detail]);
  run_due(*this, event);
}

void AmendedProtocol::received(const Packet& packet, std::uint32_t) {
  take_in(*this, packet, [&](std::uint32_t i, std::uint32_t j) {
    return has_started(j) && hears(run_.scenario.deployment, i, j, packet.emitted, run_.now);
  });
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
