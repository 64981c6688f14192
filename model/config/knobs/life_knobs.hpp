// The tables of what happens to participants (`deployment.life`), and its rules. See knobs.hpp for
// what visits them.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "model/config/knobs/knobs.hpp"
#include "model/config/knobs/value_types.hpp"
#include "model/implementations.hpp"
#include "model/life.hpp"
#include "model/scenario.hpp"
#include "model/servers.hpp"

namespace stormproof::model::config {

inline constexpr NumberType endpoint_count = count_range(0, Deployment::max_endpoints);
inline constexpr NumberType participant_number = count_range(0, Deployment::max_participants - 1);
void visit_knobs(auto& visit, Is<StaleRelation> auto& stale) {
  visit.knob("writer", stale.writer, participant_number, "who believes that the other has all");
  visit.knob("reader", stale.reader, participant_number, "who has forgotten the writer");
}
void visit_knobs(auto& visit, Is<Mute> auto& mute) {
  visit.knob("participant", mute.participant, participant_number, "who falls silent");
  visit.knob("from", mute.from, delay_range, "from when on");
}
template <>
inline constexpr std::array<std::string_view, 3> enum_names<Reach>{"participant", "host", "all"};
void visit_knobs(auto& visit, Is<Outage> auto& outage) {
  visit.knob("from", outage.from, participant_number, "whose packets are not received");
  visit.knob("to", outage.to, participant_number, "by whom");
  visit.knob("from_reach", outage.from_reach, UsualChoiceType<Reach>{{}, Reach::participant},
             "whether the first number is a participant's, as it is if absent, or a host's, or all "
             "others are meant, whatever the number",
             Presence::optional);
  visit.knob("to_reach", outage.to_reach, UsualChoiceType<Reach>{{}, Reach::participant},
             "the same of the second", Presence::optional);
  visit.knob("start", outage.start, delay_range, "the first instant");
  visit.knob("end", outage.end, delay_range, "the first instant after it");
  visit.rule(outage.start <= outage.end, "end", "not before its start");
}

template <>
inline constexpr std::array<std::string_view, 2> enum_names<Identity>{"same", "new"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<Goodbye>{"false", "true"};
void visit_knobs(auto& visit, Is<Restart> auto& restart) {
  visit.knob("participant", restart.participant, participant_number, "who");
  visit.knob("stop", restart.stop, delay_range, "when it stops");
  visit.knob("start", restart.start, delay_range, "when it is there again, knowing nothing");
  visit.knob("identity", restart.identity, UsualChoiceType<Identity>{{}, Identity::same},
             "whether it comes back under its name, as it does if absent, or as somebody new",
             Presence::optional);
  visit.knob("goodbye", restart.goodbye, UsualChoiceType<Goodbye>{{}, Goodbye::no},
             "whether it says that it stops; no if absent", Presence::optional);
  visit.rule(restart.stop < restart.start, "start", "later than its stop");
}
void visit_knobs(auto& visit, Is<Lease> auto& lease) {
  visit.knob("participant", lease.participant, participant_number, "whose");
  visit.knob("duration", lease.duration, period_range, "how long others remember it");
}

void visit_knobs(auto& visit, Is<LateEndpoints> auto& late) {
  visit.knob("participant", late.participant, participant_number, "who");
  visit.knob("publications", late.publications, endpoint_count, "how many it creates");
  visit.knob("subscriptions", late.subscriptions, endpoint_count, "how many it creates");
  visit.knob("at", late.at, delay_range, "when it creates them");
  visit.knob("until", late.until, delay_range, "when it deletes them; never if absent",
             Presence::optional);
  visit.rule(!late.until || late.at < *late.until, "until", "later than their creation");
}

void visit_knobs(auto& visit, Is<Deletion> auto& deletion) {
  visit.knob("participant", deletion.participant, participant_number, "who");
  visit.knob("publication", deletion.publication, endpoint_count,
             "which of the user publications that it has from the beginning", Presence::optional);
  visit.knob("subscription", deletion.subscription, endpoint_count,
             "or which of its user subscriptions", Presence::optional);
  visit.knob("at", deletion.at, delay_range, "when it deletes it");
  visit.rule(deletion.publication.has_value() != deletion.subscription.has_value(), "publication",
             "a publication or a subscription");
}
void visit_knobs(auto& visit, Is<Leave> auto& leave) {
  visit.knob("participant", leave.participant, participant_number, "who");
  visit.knob("at", leave.at, delay_range, "when it deletes all that it has and says that it goes");
}

void visit_knobs(auto& visit, Is<Life> auto& life) {
  constexpr ListSize any{0, 1'000'000};
  constexpr ListSize each_participant{0, Deployment::max_participants};
  visit.list("stale", life.stale, any,
             "before the run a writer believes that a reader has everything, and that reader has "
             "forgotten it",
             Presence::optional);
  visit.list("mute", life.mute, any, "participants that fall silent for ever", Presence::optional);
  visit.list("outages", life.outages, any,
             "times in which one participant does not receive from another", Presence::optional);
  visit.list("restarts", life.restarts, each_participant,
             "participants that stop and come back, having lost all that they knew",
             Presence::optional);
  visit.knob("lease", life.lease, period_range,
             "how long a participant is remembered of which nothing is heard; for ever if absent",
             Presence::optional);
  visit.list("leases", life.leases, each_participant, "of participants with another one",
             Presence::optional);
  visit.list("endpoints", life.endpoints, any,
             "user endpoints that participants create in the run, and may delete again",
             Presence::optional);
  visit.list("deletions", life.deletions, any,
             "user endpoints that participants have from the beginning and delete in the run",
             Presence::optional);
  visit.list("leaves", life.leaves, each_participant,
             "participants that say that they go, and do not come back", Presence::optional);
}

/// How many there are that something may happen to: Discovery Servers are among them.
[[nodiscard]] inline std::uint32_t everybody(const Scenario& scenario) {
  const bool has_server = traits_of(scenario.dds).has_server;
  return scenario.deployment.size() + (has_server ? server_count(scenario.deployment) : 0);
}
/// Whether both are participants of different hosts.
[[nodiscard]] inline bool is_cross_host(const Scenario& scenario, std::uint32_t i,
                                        std::uint32_t j) {
  const std::uint32_t all = everybody(scenario);
  return i < all && j < all && host_of(scenario.deployment, i) != host_of(scenario.deployment, j);
}
/// Whether the rules know of a life. Those of Fast DDS do as long as no event waits for a thread or
/// a full queue.
[[nodiscard]] inline bool knows_lives(const Scenario& scenario) {
  const bool is_punctual = !scenario.hosts && scenario.wireless.sender == Sender::backlog;
  return traits_of(scenario.dds).knows_lives && (is_punctual || scenario.dds.amendments);
}
/// What else there would have to be, and what to set.
[[nodiscard]] inline std::string needed_for_lives(const Scenario& scenario) {
  if (!traits_of(scenario.dds).knows_lives) {
    return "or a DDS profile whose rules know it: one with amendments, or implementation: fastdds "
           "or cyclone";
  }
  std::string needed;
  if (scenario.wireless.sender != Sender::backlog) {
    needed =
        "or wireless.sender: backlog (--set wireless.sender=backlog), as the wireless profile "
        "has sender: stalls, with which packets wait for a full queue";
  }
  if (scenario.hosts) {
    if (!needed.empty()) needed += ", and ";
    needed += needed.empty() ? "or " : "";
    needed += "no hosts, whose threads take processor time";
  }
  return needed;
}
/// What only those know that say goodbye, and what they do not know.
void visit_goodbyes(auto& visit, const Scenario& scenario, bool says_goodbye) {
  const Deployment& deployment = scenario.deployment;
  const Life& life = *deployment.life;
  const auto is_silent = [](const Restart& r) { return r.goodbye == Goodbye::no; };
  const auto is_new = [](const Restart& r) { return r.identity == Identity::fresh; };
  visit.rule(says_goodbye || (life.deletions.empty() && life.leaves.empty() &&
                              std::ranges::all_of(life.restarts, is_silent)),
             "deployment.life",
             "no deletions, leaves or restarts with a goodbye, or implementation: cyclone, whose "
             "rules know them");
  visit.rule(!says_goodbye || std::ranges::all_of(life.restarts, is_new),
             "deployment.life.restarts",
             "identity: new; Cyclone DDS has no way to come back under the same name");
  visit.rule(!says_goodbye || life.stale.empty(), "deployment.life.stale",
             "nothing; rules of Cyclone DDS begin with participants that know nobody");
  const auto is_done = [&](std::uint32_t i, Nanoseconds at) {
    return i < deployment.size() && at >= deployment.participants[i].endpoints_done &&
           !is_away(life, i, at);
  };
  visit.rule(std::ranges::all_of(life.deletions,
                                 [&](const Deletion& deletion) {
                                   const std::uint32_t i = deletion.participant;
                                   if (!is_done(i, deletion.at)) return false;
                                   const Participant& p = deployment.participants[i];
                                   return deletion.publication
                                              ? *deletion.publication < p.publications
                                              : deletion.subscription.value_or(0) < p.subscriptions;
                                 }),
             "deployment.life.deletions",
             "user endpoints of participants of the deployment, when all endpoints are created");
  visit.rule(
      std::ranges::all_of(life.leaves,
                          [&](const Leave& leave) { return is_done(leave.participant, leave.at); }),
      "deployment.life.leaves",
      "participants of the deployment, when all their endpoints are created");
  visit.rule(!says_goodbye || std::ranges::all_of(life.endpoints,
                                                  [&](const LateEndpoints& late) {
                                                    return is_done(late.participant, late.at);
                                                  }),
             "deployment.life.endpoints", "created when those from the beginning are");
  visit.rule(!says_goodbye || std::ranges::all_of(life.restarts,
                                                  [&](const Restart& restart) {
                                                    return restart.goodbye == Goodbye::no ||
                                                           is_done(restart.participant,
                                                                   restart.stop);
                                                  }),
             "deployment.life.restarts", "with a goodbye only when all endpoints are created");
}

/// What cannot be with a Discovery Server.
void visit_served(auto& visit, const Scenario& scenario) {
  if (!traits_of(scenario.dds).has_server) return;
  const Life& life = *scenario.deployment.life;
  visit.rule(life.stale.empty(), "deployment.life.stale",
             "nothing; with a Discovery Server participants begin knowing nobody");
  const auto is_usual = [&](const Restart& restart) {
    const bool of_client = restart.participant < scenario.deployment.size();
    return restart.identity == (of_client ? Identity::fresh : Identity::same);
  };
  visit.rule(std::ranges::all_of(life.restarts, is_usual), "deployment.life.restarts",
             "identity: new of clients, which are somebody new then, and identity: same of a "
             "Discovery Server, which is known by its name or its id");
}

void visit_life(auto& visit, Is<Scenario> auto& scenario) {
  const Deployment& deployment = scenario.deployment;
  const bool may_fail = scenario.vary && (scenario.vary->outages || scenario.vary->restarts);
  visit.rule(!may_fail || knows_lives(scenario), "vary",
             fmt::format("no outages or restarts, {}", needed_for_lives(scenario)));
  const bool may_write = scenario.vary && scenario.vary->new_endpoints;
  visit.rule(!may_write || scenario.dds.amendments.has_value(), "vary.new_endpoints",
             "none, or a DDS profile with amendments, whose rules know them");
  if (!deployment.life) return;
  const Life& life = *deployment.life;
  visit.rule(knows_lives(scenario), "deployment.life",
             fmt::format("nothing of the kind, {}", needed_for_lives(scenario)));
  const auto is_stale = [&](const StaleRelation& stale) {
    return is_cross_host(scenario, stale.writer, stale.reader);
  };
  const auto is_outage = [&](const Outage& outage) {
    const bool is_between_two =
        outage.from_reach == Reach::participant && outage.to_reach == Reach::participant;
    return !is_between_two || is_cross_host(scenario, outage.from, outage.to);
  };
  const std::uint32_t all = everybody(scenario);
  const auto is_mute = [&](const Mute& mute) { return mute.participant < all; };
  visit.rule(std::ranges::all_of(life.stale, is_stale), "deployment.life.stale",
             "participants of different hosts");
  visit.rule(std::ranges::all_of(life.outages, is_outage), "deployment.life.outages",
             "participants of different hosts");
  visit.rule(std::ranges::all_of(life.mute, is_mute), "deployment.life.mute",
             "participants of the deployment");
  const auto is_there = [&](const auto& entry) { return entry.participant < all; };
  visit.rule(std::ranges::all_of(life.restarts, is_there), "deployment.life.restarts",
             "participants of the deployment");
  visit.rule(std::ranges::all_of(life.leases, is_there), "deployment.life.leases",
             "participants of the deployment");
  visit_served(visit, scenario);
  const bool says_goodbye = traits_of(scenario.dds).says_goodbye;
  visit.rule(life.endpoints.empty() || scenario.dds.amendments.has_value() || says_goodbye,
             "deployment.life.endpoints",
             "none, or a DDS profile with amendments or implementation: cyclone, whose rules know "
             "them");
  visit_goodbyes(visit, scenario, says_goodbye);
  visit.rule(creates_while_there(deployment), "deployment.life.endpoints",
             "created and deleted by participants of the deployment, from their start on and not "
             "while they are away");
  visit.rule(comes_back_in_order(deployment), "deployment.life.restarts",
             "of each participant one after the other, from its start on, and nothing after it has "
             "come back as somebody new");
}

}  // namespace stormproof::model::config
