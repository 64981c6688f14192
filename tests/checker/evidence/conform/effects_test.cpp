// The effects that conformance sees in the capture of a simulated run are those that sent packets
// in the run, no more and no fewer. Participants that share a host send for reasons that a capture
// does not show; then it may see fewer HEARTBEATs' effects, and says that something is not
// attributed.
#include <algorithm>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "checker/evidence/conform/report/effect_coverage.hpp"
#include "model/composition_of.hpp"
#include "model/engine/packet.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/implementations.hpp"
#include "model/trace/effect_names.hpp"
#include "props/generators/space.hpp"
#include "tests/checker/evidence/conform/captures.hpp"

namespace stormproof::conform::testing {
namespace effects_test {

using Effects = std::set<std::string>;

std::string_view packet_of(model::PacketKind kind) {
  switch (kind) {
    case model::PacketKind::spdp_multicast:
      return "SpdpMulticast";
    case model::PacketKind::spdp_unicast:
      return "SpdpUnicast";
    case model::PacketKind::data:
      return "Data";
    case model::PacketKind::heartbeat:
      return "Heartbeat";
    case model::PacketKind::acknack:
      return "AckNack";
    case model::PacketKind::registration:
      return "Registration";
    case model::PacketKind::registration_heartbeat:
      return "RegistrationHeartbeat";
    case model::PacketKind::registration_acknack:
      return "RegistrationAckNack";
    case model::PacketKind::relayed_acknack:
      return "RelayedAckNack";
    default:
      return "";  // a control-only relation's
  }
}
std::string_view packet_of(const model::Packet& packet) {
  if (packet.kind != model::PacketKind::relayed) return packet_of(packet.kind);
  if (packet.relayed->has_data) return "RelayedData";
  return packet.relayed->numbers.empty() ? "RelayHeartbeat" : "Gap";
}

/// Observes which effect sends each packet that leaves a host: the last one that can send it, since
/// a step may keep a packet open until another one flushes it.
class Senders final : public model::Probe {
 public:
  explicit Senders(const model::DdsProfile& dds) : names_{dds} {
    add(model::composition_of(dds));
    if (model::traits_of(dds).has_server) add(model::composition_of(dds.implementation));
  }
  [[nodiscard]] bool wants_effects() const override { return true; }
  void event_started(const model::Event&) override {
    names_.event_started();
    happened_.clear();
  }
  void effect(fsm::composition::EffectKey key) override {
    happened_.emplace_back(names_.happens(key));
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    const std::string_view name = packet_of(packet);
    if (!name.empty()) sent_as(name);
    const bool is_relayed = packet.kind == model::PacketKind::relayed;
    if (packet.carries_heartbeat && !is_relayed) sent_as("Heartbeat");
  }

  Effects sent;

 private:
  void add(const fsm::composition::CompositionInfo& composition) {
    for (const auto* list : {&composition.rules, &composition.procedures}) {
      for (const auto& rule : *list) {
        for (const auto& effect : rule.effects) {
          packets_[effect.id] = packets_sent_by(composition, effect);
        }
      }
    }
  }
  void sent_as(std::string_view name) {
    const auto sender = std::find_if(happened_.rbegin(), happened_.rend(), [&](const auto& id) {
      return std::ranges::find(packets_.at(id), name) != packets_.at(id).end();
    });
    ASSERT_NE(sender, happened_.rend()) << name;
    sent.insert(*sender);
  }

  model::trace::EffectNames names_;
  std::map<std::string, std::vector<std::string_view>> packets_;
  std::vector<std::string> happened_;
};

struct Compared {
  Effects run;
  Effects seen;
  Effects possible;  ///< to be seen, under the profile
  std::uint64_t unattributed = 0;

  /// Effects of one and not of the other.
  [[nodiscard]] Effects differing() const {
    Effects all;
    std::ranges::set_symmetric_difference(run, seen, std::inserter(all, all.end()));
    return all;
  }
};

/// What the profile rules out, once for each that differs in more than the budget.
const std::vector<tables::ImpossibleEffects>& impossible_under(model::DdsProfile dds) {
  static std::vector<std::pair<model::DdsProfile, std::vector<tables::ImpossibleEffects>>> known;
  dds.sedp.piggyback_threshold_bytes = model::Bytes{1};
  const auto found = std::ranges::find_if(known, [&](const auto& one) { return one.first == dds; });
  if (found != known.end()) return found->second;
  known.reserve(100);
  return known.emplace_back(dds, tables::impossible_effects(dds)).second;
}

/// Nothing if the run has no discovery between hosts.
std::optional<Compared> compared(const model::Scenario& scenario, bool may_lose) {
  Senders senders{scenario.dds};
  model::RunOptions options;
  options.probe = &senders;
  options.max_events = 20'000;
  const Simulated run = simulated(scenario, options);
  if (run.is_empty || run.conversation.topology.hosts < 2) return std::nullopt;
  Bounds bounds = exact_bounds(scenario, run);
  bounds.may_lose = may_lose;
  const Conformance result = conformance(run.conversation, scenario.dds, bounds);
  if (result.checked == 0) return std::nullopt;  // a server that is silent is at no known address
  // A run without descriptors decides nothing about a profile; its effects are seen all the same.
  EXPECT_EQ(result.explained, result.checked) << description(result);
  EXPECT_TRUE(result.unexplained.empty()) << description(result);
  const CompositionCoverage coverage =
      effect_coverage(result, scenario.dds, impossible_under(scenario.dds));
  Compared both{senders.sent, {}, {}, coverage.unattributed};
  for (const RuleCoverage& rule : coverage.rules) {
    for (const EffectCoverage& one : rule.effects) {
      if (one.times > 0) both.seen.insert(one.effect->id);
      if (one.ruled_out_by.empty()) both.possible.insert(one.effect->id);
    }
  }
  return both;
}

/// Datagrams do not overtake each other; participants have a host of their own, or not. Who resends
/// nothing is known late: what is sent to it before is dropped, which is a loss, too.
model::Scenario drawn(std::uint64_t seed, bool alone, bool losses) {
  constexpr const char* versions[] = {"fastdds-2.6.11", "fastdds-2.9.1", "fastdds-2.14.5"};
  constexpr model::SpdpResend resends[] = {model::SpdpResend::all_known,
                                           model::SpdpResend::new_and_multicast,
                                           model::SpdpResend::new_only, model::SpdpResend::none};
  model::Scenario scenario =
      props::draw_scenario(seed, static_cast<int>(seed % 101),
                           {.implementation = model::ImplementationKind::fastdds,
                            .max_participants = 5,
                            .losses = losses,
                            .max_time_limit = model::Nanoseconds{4'000'000'000}});
  scenario.dds = profile(versions[seed % 3]);
  scenario.dds.spdp.resend = resends[seed / 3 % (losses ? 4 : 3)];
  if (seed % 2 == 0) scenario.dds.sedp.piggyback_threshold_bytes = model::Bytes{5'000};
  model::WirelessProfile& wireless = scenario.wireless;
  wireless.packet_delays.clear();
  wireless.fragment_request = model::FragmentRequest::at_admission;
  wireless.order = model::ServiceOrder::fifo;
  wireless.mtu_payload_bytes = model::Bytes{65'535};
  std::uint32_t host = 0;
  for (model::Participant& one : scenario.deployment.participants) {
    if (alone) one.host = model::HostId{host++};
  }
  return scenario;
}

std::string text(const Effects& effects) {
  std::string all;
  for (const std::string& one : effects) all += " " + one;
  return all;
}

/// Effects that send nothing but HEARTBEATs.
Effects heartbeats() {
  const auto& composition = model::composition_of(model::ImplementationKind::fastdds);
  Effects all;
  for (const auto* list : {&composition.rules, &composition.procedures}) {
    for (const auto& rule : *list) {
      for (const auto& effect : rule.effects) {
        if (packets_sent_by(composition, effect) == std::vector<std::string_view>{"Heartbeat"}) {
          all.insert(effect.id);
        }
      }
    }
  }
  return all;
}
Effects without(Effects effects, const Effects& others) {
  std::erase_if(effects, [&](const std::string& one) { return others.contains(one); });
  return effects;
}

TEST(SimulatedEffects, AreSeenExactlyIfNothingIsLostAndHostsHaveOneParticipant) {
  Effects seen;
  Effects possible;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const auto both = compared(drawn(seed, true, false), false);
    if (!both) continue;
    EXPECT_EQ(text(both->run), text(both->seen));
    EXPECT_EQ(both->unattributed, 0U);
    seen.insert(both->seen.begin(), both->seen.end());
    possible.insert(both->possible.begin(), both->possible.end());
  }
  EXPECT_EQ(text(seen), text(possible)) << "something was in no run";
}

/// A HEARTBEAT may have several reasons: the answer to an initial ACKNACK that was lost can have
/// been an expiry.
TEST(SimulatedEffects, AreSeenUpToTheReasonsOfHeartbeatsIfSomethingIsLost) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const auto both = compared(drawn(seed, true, true), true);
    if (!both) continue;
    EXPECT_EQ(text(without(both->differing(), heartbeats())), "");
    EXPECT_EQ(both->unattributed, 0U);
  }
}

TEST(SimulatedEffects, AreSeenUpToTheReasonsOfHeartbeatsIfHostsAreShared) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const auto both = compared(drawn(seed, false, false), false);
    if (!both) continue;
    EXPECT_EQ(text(without(both->differing(), heartbeats())), "");
  }
}

/// Clients on hosts of their own, and the server alone on its host.
model::Scenario drawn_with_server(std::uint64_t seed, bool losses) {
  model::Scenario scenario = drawn(seed, true, losses);
  for (model::Participant& one : scenario.deployment.participants) ++one.host.value;
  scenario.dds = profile(seed % 2 == 0 ? "fastdds-server-2.6.11" : "fastdds-server-2.14.5");
  if (seed % 3 == 0) scenario.dds.discovery = model::Discovery::super_client;
  if (seed % 4 == 0) scenario.dds.server.client_sync_period = model::Nanoseconds{40'000'000};
  if (seed % 5 == 0) scenario.dds.sedp.piggyback_threshold_bytes = model::Bytes{5'000};
  if (seed % 7 == 0) scenario.dds.server.known = model::ServerKnown::locator;
  return scenario;
}

/// Those of what a server adds; those of Fast DDS other runs have.
Effects of_server(const Effects& effects) {
  const auto& composition = model::composition_of(profile("fastdds-server-2.6.11"));
  Effects all;
  for (const auto& rule : composition.rules) {
    for (const auto& effect : rule.effects) {
      if (effects.contains(effect.id)) all.insert(effect.id);
    }
  }
  return all;
}

/// What is passed on has one reason only; why a HEARTBEAT was sent may have several.
TEST(SimulatedEffects, AreSeenWithAServerUpToTheReasonsOfHeartbeats) {
  Effects heartbeat_only = heartbeats();
  heartbeat_only.insert({"RegistrationAckNackArrives.1", "RegistrationExpires.2",
                         "RelayedAckNackArrives.1", "RelayExpires.2"});
  Effects seen;
  Effects possible;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    SCOPED_TRACE(seed);
    const bool losses = seed % 2 == 0;
    const auto both = compared(drawn_with_server(seed, losses), losses);
    if (!both) continue;
    EXPECT_EQ(text(without(both->differing(), heartbeat_only)), "");
    seen.insert(both->seen.begin(), both->seen.end());
    possible.insert(both->possible.begin(), both->possible.end());
  }
  EXPECT_EQ(text(of_server(seen)), text(of_server(possible))) << "something was in no run";
}

}  // namespace effects_test
}  // namespace stormproof::conform::testing
