// Properties of machines, of the order of events, of the network and of results apply to all.
#include "props/applicability.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "model/composition_of.hpp"
#include "model/fastdds/peer_ports.hpp"
#include "model/implementations.hpp"
#include "model/scenario.hpp"

namespace stormproof::props {

namespace {
constexpr std::array<std::string_view, 8> of_all{
    "fsm.determinism", "fsm.totality",          "fsm.reachability",    "composition.total",
    "order.total",     "order.reception-first", "safety.conservation", "timer.progress"};

/// They are about runs of the paper's rules, amended or not: engines need not know the writer.
constexpr std::array<std::string_view, 7> of_amended_rules{"safety.ack-implies-received",
                                                           "safety.ack-stable",
                                                           "live.recovery",
                                                           "live.isolation",
                                                           "storm.join-cost",
                                                           "storm.piggyback-rate",
                                                           "storm.feedback-gain"};
/// Of these, those that only amended rules can break or have a scenario for.
constexpr std::array<std::string_view, 4> of_the_papers_rules{
    "live.recovery", "live.isolation", "storm.join-cost", "storm.piggyback-rate"};

/// Of these, those that a certificate from the rules proves, amended or not.
constexpr std::array<std::string_view, 1> certified_of_amended_rules{"live.recovery"};

/// They know that participants of Fast DDS may have a life.
constexpr std::array<std::string_view, 3> of_living_fastdds{"composition.followed", "live.recovery",
                                                            "live.isolation"};

/// They know what a Discovery Server adds to the rules.
constexpr std::array<std::string_view, 2> of_server{"composition.live", "composition.followed"};

/// What clients tell a Discovery Server goes by Fast DDS's rules; of that these hold as they do
/// without one.
constexpr std::array<std::string_view, 7> of_clients{
    "safety.ack-implies-received", "safety.ack-stable",
    "safety.repair-only-if-asked", "safety.snapshot",
    "timer.single-heartbeat",      "timer.suppression-honoured",
    "storm.feedback-gain"};

/// Of these, what certificates prove from those rules.
constexpr std::array<std::string_view, 4> certified_of_clients{
    "safety.ack-implies-received", "safety.repair-only-if-asked", "safety.snapshot",
    "timer.single-heartbeat"};

/// What a certificate from Cyclone DDS's rules proves.
constexpr std::array<std::string_view, 2> certified_of_cyclone{"safety.ack-implies-received",
                                                               "safety.snapshot"};

/// What the explorer decides for small scopes, and no certificate proves.
constexpr std::array<std::string_view, 2> explored_of_cyclone{"safety.repair-only-if-asked",
                                                              "live.no-stall"};

/// What runs of Cyclone DDS show, and no certificate proves.
constexpr std::array<std::string_view, 5> observed_of_cyclone{
    "safety.repair-only-if-asked", "live.no-stall", "storm.feedback-gain", "composition.live",
    "composition.followed"};

/// Their bounds and theorems count from instants at which timers are due.
constexpr std::array<std::string_view, 7> of_punctual_timers{
    "live.completion",   "live.quiescence",      "live.recovery",     "live.isolation",
    "storm.single-copy", "storm.free-threshold", "storm.cannot-start"};

/// They follow each packet on one way from its source to all its receivers.
constexpr std::array<std::string_view, 2> of_one_way{"safety.conservation", "live.no-stall"};

bool stalls(const model::Scenario& scenario) {
  return scenario.wireless.sender == model::Sender::stalls;
}

bool is_among(std::span<const std::string_view> list, std::string_view property) {
  return std::ranges::find(list, property) != list.end();
}

bool is_certified(std::string_view property, model::Writer writer) {
  if (writer == model::Writer::of_cyclone) return is_among(certified_of_cyclone, property);
  if (writer == model::Writer::of_server) return is_among(certified_of_clients, property);
  return writer == model::Writer::of_the_paper && is_among(certified_of_amended_rules, property);
}

bool is_of_all(std::string_view property) {
  return property.starts_with("limit.") || is_among(of_all, property);
}

/// A run that live.isolation is compared with has to lose the same packets, found one by one.
constexpr std::size_t most_losses_to_find = 100;

std::string_view why_nothing_to_recover_from(const model::Scenario& scenario) {
  const auto& life = scenario.deployment.life;
  const bool fails = life && !(life->stale.empty() && life->mute.empty() && life->outages.empty() &&
                               life->restarts.empty() && life->endpoints.empty());
  return fails ? ""
               : "nobody forgets, fails, comes back or changes its endpoints in this deployment "
                 "(deployment.life)";
}

std::string_view why_nobody_to_isolate(const model::Scenario& scenario) {
  const auto& life = scenario.deployment.life;
  if (!life || life->mute.empty()) {
    return "nobody falls silent in this deployment (deployment.life.mute)";
  }
  if (scenario.wireless.kind != model::ServiceKind::constant_delay) {
    return "over a channel that is shared every packet delays others; it is stated for constant "
           "delays";
  }
  if (scenario.wireless.lost_packets.size() > most_losses_to_find) {
    return "more than 100 packets are lost, which are not looked for in the run without the dead";
  }
  return {};
}
}  // namespace

std::string_view why_not_applicable(std::string_view property, const model::Scenario& scenario) {
  std::string_view why = why_not_applicable(property, model::kind_of(scenario.dds));
  const bool is_living = model::is_living_fastdds(scenario);
  if (is_living && is_among(of_living_fastdds, property)) why = {};
  if (why.empty() && is_living && !is_of_all(property) && !is_among(of_living_fastdds, property)) {
    return "it is stated for participants of Fast DDS that nobody forgets; with deployment.life "
           "only machines, network, results, what rules do, recovery and isolation are checked";
  }
  if (why.empty() && property == "live.recovery") why = why_nothing_to_recover_from(scenario);
  if (why.empty() && property == "live.isolation") why = why_nobody_to_isolate(scenario);
  if (!why.empty()) return why;
  const bool is_timed = is_among(of_punctual_timers, property);
  if (scenario.hosts && property == "order.reception-first") {
    return "a busy thread (hosts) takes what is due in the order in which it became due";
  }
  if (scenario.hosts && (is_timed || is_among(of_one_way, property))) {
    return "it counts on timers and receptions that are handled when they are due; a thread that "
           "is busy (hosts) handles them later, and a program that has just started hears nothing";
  }
  const bool has_fleet = !scenario.deployment.hosts.empty();
  if ((has_fleet || scenario.wireless.loss) && (is_timed || is_among(of_one_way, property))) {
    return has_fleet ? "it is stated for stations of one access point; the hosts of this "
                       "deployment are listed (deployment.hosts)"
                     : "it is stated for losses of whole packets, by number; here transmissions "
                       "of frames fail (wireless.loss)";
  }
  if (!stalls(scenario) || !is_timed) return {};
  return "it counts on timers that are served when they are due; a participant that stalls "
         "(sender: "
         "stalls) serves none as long as its packets wait for room, however long that is";
}

std::string_view why_not_provable(std::string_view property, const model::Scenario& scenario) {
  constexpr std::array<std::string_view, 3> of_rules{"fsm.", "order.", "composition."};
  const bool is_about_rules = std::ranges::any_of(
      of_rules, [&](std::string_view kind) { return property.starts_with(kind); });
  const bool is_about_services = property == "order.reception-first";
  if (!scenario.deployment.hosts.empty() && (!is_about_rules || is_about_services)) {
    return "the engines that prove it know no hosts that are listed (deployment.hosts)";
  }
  if (is_about_rules) return {};
  const model::ImplementationTraits& traits = model::traits_of(scenario.dds);
  if (!traits.is_known_to_engines && !is_certified(property, traits.writer) &&
      !is_only_explored(property, model::kind_of(scenario.dds))) {
    return "the engines that prove it know the rules of the paper and of Fast DDS only";
  }
  if (!model::fastdds::announcements_reach_all(scenario)) {
    return "somebody is at no port that announcements go to (dds.peer_ports), and only runs tell "
           "whether the others hear of it";
  }
  if (model::is_living_fastdds(scenario)) {
    return "the engines that prove it know nobody who forgets or comes back (deployment.life)";
  }
  if (stalls(scenario)) return "the engines that prove it know no sender that stalls";
  if (scenario.hosts) return "the engines that prove it know no threads that are busy (hosts)";
  if (scenario.wireless.loss) {
    return "the engines that prove it know no transmissions that fail (wireless.loss)";
  }
  return {};
}

std::string_view why_not_applicable(std::string_view property,
                                    model::ImplementationKind implementation) {
  if (is_of_all(property)) return {};
  const model::Writer writer = model::traits_of(implementation).writer;
  const bool has_server = writer == model::Writer::of_server;
  if (has_server && (is_among(of_server, property) || is_among(of_clients, property))) return {};
  const bool is_paper = writer == model::Writer::of_the_paper;
  const bool is_of_cyclone =
      is_certified(property, writer) || is_among(observed_of_cyclone, property);
  if (writer == model::Writer::of_cyclone && is_of_cyclone) return {};
  if (is_paper && is_among(of_amended_rules, property)) return {};
  if (is_among(of_the_papers_rules, property)) {
    return "it is stated for the rules of the closed-loop model, amended or not, and live.recovery "
           "and live.isolation for Fast DDS whose participants have a life (deployment.life)";
  }
  if (model::traits_of(implementation).is_known_to_engines) return {};
  if (writer == model::Writer::of_cyclone) {
    return "it has no meaning for Cyclone DDS's writer, or no engine knows how to decide it there "
           "(specs/guide/cyclone.md, \"What is not\")";
  }
  return "it is stated for the writers of the paper and of Fast DDS; of this one only machines, "
         "network and results are checked";
}

bool is_only_explored(std::string_view property, model::ImplementationKind implementation) {
  const bool is_cyclone = model::traits_of(implementation).writer == model::Writer::of_cyclone;
  return is_cyclone && is_among(explored_of_cyclone, property);
}

bool is_about_clients(std::string_view property, model::ImplementationKind implementation) {
  const bool has_server = model::traits_of(implementation).writer == model::Writer::of_server;
  return has_server && is_among(of_clients, property);
}

}  // namespace stormproof::props
