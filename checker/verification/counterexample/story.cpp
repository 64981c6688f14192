// Header, events, reason.
#include "checker/verification/counterexample/story.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "checker/presentation/sequence/chart.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/verification/counterexample/acts.hpp"
#include "checker/verification/counterexample/selection.hpp"
#include "model/implementations.hpp"
#include "props/monitors/describe.hpp"
#include "props/property.hpp"

namespace stormproof::counterexample {

namespace {

constexpr std::size_t told_events = 40;

std::string user_endpoints(const model::Participant& participant) {
  return fmt::format("{} pub + {} sub", participant.publications, participant.subscriptions);
}

std::string network_text(const model::WirelessProfile& wireless) {
  std::string text;
  if (wireless.kind == model::ServiceKind::constant_delay) {
    text = "constant delay " + props::time_text(wireless.one_way);
  } else if (wireless.service == model::ServedBy::unit) {
    text = "access point with units of frames";
  } else {
    text = fmt::format("shared channel with {} stage{}", wireless.stages.size(),
                       wireless.stages.size() == 1 ? "" : "s");
  }
  constexpr std::size_t listed = 12;
  const auto& delays = wireless.packet_delays;
  for (std::size_t k = 0; k < std::min(delays.size(), listed); ++k) {
    text += fmt::format("{}p{} {}", k == 0 ? ", except " : ", ", delays[k].packet,
                        props::time_text(delays[k].one_way));
  }
  if (delays.size() > listed) text += fmt::format(" and {} more", delays.size() - listed);
  const auto& lost = wireless.lost_packets;
  for (std::size_t k = 0; k < std::min(lost.size(), listed); ++k) {
    text += fmt::format("{}p{}", k == 0 ? "; lost: " : ", ", lost[k]);
  }
  if (lost.size() > listed) text += fmt::format(" and {} more", lost.size() - listed);
  return text;
}

std::string who_text(const Act& act, const History& history) {
  const bool network = act.kind == Act::Kind::channel || act.kind == Act::Kind::lost;
  if (!network) return fmt::format("{}", act.who);
  return act.who < history.channels.size() ? history.channels[act.who] : "net";
}

/// One event: its acts by party, in the order in which the parties act.
std::string line_of(const History& history, const Relevance& relevance, std::size_t n,
                    std::size_t columns) {
  const model::Event& event = history.steps[n].event;
  std::string text;
  std::string who;
  for (const Act& act : acts_of(history, n, relevance)) {
    const std::string party = who_text(act, history);
    if (text.empty())
      text = party + ": ";
    else
      text += party == who ? "; " : " | " + party + ": ";
    who = party;
    text += sequence::with_effect(act.text, act.effect);
  }
  const bool last = n + 1 == history.steps.size();
  const std::string first =
      fmt::format("{}{:>7} {:>15}  ", last ? "!" : " ", n, report::milliseconds(event.time));
  return report::paragraph(first, text, columns);
}

/// Whether a gap has more than the one or two channel events that are between any two others.
bool leaves_out_more(const Relevance& relevance, const Selected& gap) {
  return std::any_of(relevance.steps.begin() + static_cast<std::ptrdiff_t>(gap.step),
                     relevance.steps.begin() + static_cast<std::ptrdiff_t>(gap.last) + 1,
                     [](bool relevant) { return relevant; });
}

}  // namespace

namespace {
/// "; before the run 1 has forgotten 0; 2 is silent from 500 µs": empty if nothing of the kind.
std::string life_text(const model::Deployment& deployment) {
  if (!deployment.life) return "";
  std::string text;
  for (const model::StaleRelation& stale : deployment.life->stale) {
    text += fmt::format("{}{} has forgotten {}", text.empty() ? "; before the run " : ", ",
                        stale.reader, stale.writer);
  }
  for (const model::Mute& mute : deployment.life->mute) {
    text += fmt::format("; {} is silent from {}", mute.participant, props::time_text(mute.from));
  }
  for (const model::Outage& outage : deployment.life->outages) {
    text += fmt::format("; {} does not receive from {} from {} to {}", outage.to, outage.from,
                        props::time_text(outage.start), props::time_text(outage.end));
  }
  for (const model::Restart& restart : deployment.life->restarts) {
    text += fmt::format("; {} stops at {} and is back at {}{}", restart.participant,
                        props::time_text(restart.stop), props::time_text(restart.start),
                        restart.identity == model::Identity::fresh ? " as somebody new" : "");
  }
  for (const model::LateEndpoints& late : deployment.life->endpoints) {
    text += fmt::format("; {} creates {} + {} endpoints at {}", late.participant, late.publications,
                        late.subscriptions, props::time_text(late.at));
    if (late.until) text += fmt::format(" and deletes them at {}", props::time_text(*late.until));
  }
  if (deployment.life->lease) {
    text += fmt::format("; leases of {}", props::time_text(*deployment.life->lease));
  }
  return text;
}
}  // namespace

std::string deployment_text(const model::Scenario& scenario) {
  const auto& participants = scenario.deployment.participants;
  const auto alike = [&](const model::Participant& p) {
    return p.publications == participants[0].publications &&
           p.subscriptions == participants[0].subscriptions && p.start == participants[0].start;
  };
  std::string text = fmt::format("{} participants on {} hosts", participants.size(),
                                 scenario.deployment.host_count());
  if (std::ranges::all_of(participants, alike)) {
    text += fmt::format(", each with {}, start at {}", user_endpoints(participants[0]),
                        props::time_text(participants[0].start));
  } else {
    constexpr std::size_t listed = 8;
    for (std::size_t k = 0; k < std::min(participants.size(), listed); ++k) {
      const model::Participant& p = participants[k];
      text += fmt::format("{}{} (host {}, {}, start {})", k == 0 ? ": " : "; ", k, p.host.value,
                          user_endpoints(p), props::time_text(p.start));
    }
    if (participants.size() > listed) text += "; …";
  }
  return text + life_text(scenario.deployment) +
         fmt::format("; {}'s writer; ", model::traits_of(scenario.dds).whose) +
         network_text(scenario.wireless);
}

std::string timers_text(const model::Scenario& scenario) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  std::string text = fmt::format(
      "τ_H {}, τ_A {}, τ_N {}, τ_S {}, τ_I {}", props::time_text(sedp.heartbeat_period),
      props::time_text(sedp.heartbeat_response_delay), props::time_text(sedp.nack_response_delay),
      props::time_text(sedp.nack_suppression_duration),
      sedp.initial_acknack_delay.count() == 0 ? "off"
                                              : props::time_text(sedp.initial_acknack_delay));
  if (sedp.initial_acknack_delay.count() > 0 &&
      sedp.initial_acknack_interval == model::InitialAckNackInterval::constant)
    text += " each time";
  if (sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive)
    text += "; adaptive HEARTBEATs";
  else if (sedp.heartbeat_timer == model::HeartbeatTimerKind::additive)
    text += "; additive HEARTBEAT timers";
  return text;
}

std::string story(const props::Counterexample& counterexample, std::size_t columns) {
  const History history = record(counterexample);
  const Relevance relevance = relevance_of(history);
  const props::Property* property = props::find_property(counterexample.property);

  const auto paragraph = [columns](std::string_view first, std::string_view words) {
    return report::paragraph(first, words, columns);
  };
  std::string text =
      fmt::format("{} is violated at event {}, {}\n", counterexample.property,
                  report::grouped(counterexample.event), props::time_text(counterexample.time));
  if (property != nullptr) {
    text += paragraph("  statement  ",
                      statement_of(*property, model::kind_of(counterexample.scenario.dds)));
  }
  text += paragraph("  why        ", counterexample.reason);
  text += paragraph("  run        ", deployment_text(counterexample.scenario));
  text += paragraph("  timers     ", timers_text(counterexample.scenario));
  text += "\n   event              ms  participant: what it does; what changes\n";
  for (const Selected& selected : select(history, relevance, told_events)) {
    if (!selected.gap)
      text += line_of(history, relevance, selected.step, columns);
    else if (selected.last - selected.step >= 2 || leaves_out_more(relevance, selected))
      text +=
          paragraph("       …                  (", gap_text(history, relevance, selected) + ")");
  }
  for (const std::string& step : counterexample.steps) text += paragraph("  - ", step);
  return text + "\n" + paragraph("The property breaks: ", counterexample.reason);
}

report::Story told(props::Counterexample counterexample) {
  return [run = std::move(counterexample)](std::size_t columns) { return story(run, columns); };
}

}  // namespace stormproof::counterexample
