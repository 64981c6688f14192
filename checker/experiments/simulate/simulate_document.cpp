// A simulation as a document: the answer first, then what it consists of, then what it means.
#include <algorithm>
#include <numeric>

#include <fmt/core.h>

#include "checker/experiments/simulate/distribution_plot.hpp"
#include "checker/experiments/simulate/simulate_report.hpp"
#include "checker/experiments/trials/tone_of_health.hpp"
#include "checker/experiments/trials/usual_hosts.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/document/unreached.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "checker/verification/check/next_steps.hpp"
#include "model/implementations.hpp"
#include "model/life.hpp"

namespace stormproof::report {

namespace {

using model::Nanoseconds;
using model::RunResult;

constexpr auto to_right = Column::Align::right;

/// Why a run that is not complete ended.
std::string end_text(const Simulation& s) {
  const std::string missing =
      fmt::format("{} of {} descriptor deliveries are missing", grouped(s.result.missing_count),
                  grouped(s.failure_free.initial_data));
  switch (s.result.end) {
    case model::RunEnd::time_limit:
      return fmt::format("At the time limit of {} {}. ", duration(s.scenario.time_limit), missing);
    case model::RunEnd::no_more_events:
      return fmt::format("No event is left after {}: nothing more can happen, and {}. ",
                         duration(s.result.end_time), missing);
    case model::RunEnd::interrupted:
      return fmt::format("The run was interrupted at {}, when {}. ", duration(s.result.end_time),
                         missing);
    case model::RunEnd::completed:
      break;
  }
  return "";
}

/// How long everybody lacked something after the last failure.
std::string recovery_text(const Simulation& s) {
  const std::string last = duration(last_failure(s.scenario.deployment));
  if (!s.result.recovery_time) return fmt::format("Nothing fails after {}. ", last);
  if (s.result.recovery_time->count() == 0) {
    return fmt::format("Nothing fails after {}, when nobody lacks anything. ", last);
  }
  std::string text = fmt::format("The last failure is over at {}, and recovery from it takes {}. ",
                                 last, duration(*s.result.recovery_time));
  if (s.result.until_discovery && model::traits_of(s.scenario.dds).has_living_composition) {
    const model::SentUntil& sent = *s.result.until_discovery;
    text += fmt::format("Until then {} messages are sent from that failure on, {} in all; ",
                        grouped(sent.since_last_failure), grouped(sent.messages()));
    text += fmt::format("{} times somebody's lease ended at somebody else. ", sent.forgotten);
  }
  return text;
}

/// If the run goes on after discovery, that it does; then the open loop.
std::string elaboration(const Simulation& s) {
  const RunResult& result = s.result;
  std::string text = result.completed() ? "" : end_text(s);
  if (result.completed() && result.end != model::RunEnd::completed) {
    text = fmt::format(
        "The run goes on after that, as run_until: {} asks for, and ends after {}; what "
        "follows covers all of it. ",
        s.scenario.run_until == model::RunUntil::quiescence ? "quiescence" : "time_limit",
        duration(result.end_time));
  }
  if (is_mixed(s.scenario)) {
    const auto own = std::ranges::count_if(
        s.scenario.deployment.participants,
        [&](const model::Participant& one) { return one.dds && *one.dds != s.scenario.dds; });
    text += fmt::format("{} of {} participants have a DDS profile of their own. ", own,
                        s.scenario.deployment.size());
  }
  if (s.scenario.deployment.life) text += recovery_text(s);
  if (result.messages_since_last_start) {
    text +=
        fmt::format("From the last start or change of endpoints on ({}) {} messages are sent. ",
                    duration(last_start(s.scenario.deployment)), *result.messages_since_last_start);
  }
  if (const auto graph = s.fragmented_graph_info()) {
    text += fmt::format(
        "Not in the model: ros_discovery_info, sent whole again with each new endpoint, has at "
        "least {} B in the end. ",
        grouped(static_cast<std::uint64_t>(graph->count())));
  }
  if (!s.open_loop) {
    if (model::traits_of(s.scenario.dds).has_server) {
      return text + "No open-loop airtime: it is not defined with a Discovery Server.";
    }
    return text + (model::traits_of(s.scenario.dds).mixes_messages
                       ? "No open-loop airtime: it is not defined for Cyclone DDS's shared packets."
                       : "No open-loop airtime: this profile has a constant delay and no channel.");
  }
  const auto open_loop = static_cast<double>(s.open_loop->count());
  const exact::RunHealth run = exact::health_of(s.scenario, result);
  text += fmt::format("Everything sent once would need {} of airtime (open loop); ",
                      duration(*s.open_loop));
  const std::string took = ratio(static_cast<double>(run.took.count()), open_loop);
  const std::string after =
      run.has_failures ? ", from the last failure or start" : ", from the last start";
  const std::string from = run.last_start.count() > 0 ? after : "";
  return text + (result.completed() ? fmt::format("the closed loop takes {} as long{}.", took, from)
                                    : fmt::format("the run ended after {} of that.", took));
}

/// Each as a row of the table and as a finding.
void add_limits(Document& document, const Simulation& s) {
  if (s.limits.empty()) return;
  Table table{{{"limit"}, {"allowed", to_right}, {"reached", to_right}, {"verdict"}}, {}};
  for (const props::LimitReading& reading : s.limits) {
    const std::string name{reading.id.substr(reading.id.find('.') + 1)};
    const auto print = [&](double value) -> std::string {
      if (name == "completion") return duration(Nanoseconds{static_cast<std::int64_t>(value)});
      if (name == "amplification") return ratio(value, 1);
      return grouped(static_cast<std::uint64_t>(value));
    };
    const std::string reached = reading.reached ? print(*reading.reached) : "not complete";
    const char* word = reading.exceeded ? "exceeded" : reading.reached ? "kept" : "not known";
    const Tone tone = reading.exceeded ? Tone::bad : reading.reached ? Tone::good : Tone::warn;
    table.rows.push_back({{name, print(reading.limit), reached, badge(tone, word)}});
    Finding finding;
    finding.id = reading.id;
    finding.statement =
        fmt::format("The {} of a run is at most that of the scenario's limits.", name);
    finding.outcome = reading.exceeded  ? Finding::Outcome::failed
                      : reading.reached ? Finding::Outcome::passed
                                        : Finding::Outcome::unknown;
    finding.word = word;
    finding.message =
        fmt::format("limit {} {}: {} ({})", name, print(reading.limit), word, reached);
    finding.shown = Finding::Shown::tests;
    document.findings.push_back(std::move(finding));
  }
  document.blocks.emplace_back(std::move(table));
}

Table messages(const Simulation& s) {
  Table table{{{"messages"},
               {"this run", to_right},
               {"failure-free", to_right},
               {"amplification", to_right}},
              {}};
  const auto row = [&](const char* name, std::uint64_t value, std::uint64_t reference) {
    table.rows.push_back({{name, grouped(value), grouped(reference),
                           ratio(static_cast<double>(value), static_cast<double>(reference))}});
  };
  const auto counts = s.result.counts.entries();
  const auto reference = s.failure_free.entries();
  for (std::size_t k = 0; k < counts.size(); ++k) {
    row(words_of(model::message_classes[k]), counts[k].value, reference[k].value);
  }
  const auto of_server = [&](const char* name, std::uint64_t value, std::uint64_t once) {
    if (model::traits_of(s.scenario.dds).has_server) row(name, value, once);
  };
  const model::Counts& all = s.result.counts;
  of_server("DATA(p)", all.pdp_data, s.failure_free.pdp_data);
  of_server("HEARTBEAT(p)", all.pdp_heartbeat, s.failure_free.pdp_heartbeat);
  of_server("ACKNACK(p)", all.pdp_acknack, s.failure_free.pdp_acknack);
  of_server("GAP", all.gap, s.failure_free.gap);
  row("total", s.result.counts.total(), s.failure_free.total());
  if (s.result.user_control > 0) {
    table.rows.push_back({{"user control", grouped(s.result.user_control), "", ""}});
  }
  if (all.lookup > 0) table.rows.push_back({{"lookups", grouped(all.lookup), "", ""}});
  return table;
}

/// One row for each class with a bar of its share of the elapsed time.
void add_channels(Blocks& blocks, const RunResult& result) {
  const auto elapsed = static_cast<double>(result.end_time.count());
  for (const model::ChannelUse& channel : result.channels) {
    const auto busy = static_cast<double>(channel.total_busy().count());
    Table table{{{"channel " + channel.name},
                 {"time", to_right},
                 {"share", to_right},
                 {.head = fmt::format("busy {} of the time", percent(busy, elapsed)),
                  .audience = Audience::terminal}},
                {}};
    const auto row = [&](const char* name, Nanoseconds time) {
      const double share = elapsed > 0 ? static_cast<double>(time.count()) / elapsed : 0;
      table.rows.push_back(
          {{name, duration(time), percent(static_cast<double>(time.count()), elapsed),
            std::string(static_cast<std::size_t>(40 * share + 0.5), '#')}});
    };
    for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
      if (channel.busy[k].count() > 0) {
        row(words_of(static_cast<model::TrafficClass>(k)), channel.busy[k]);
      }
    }
    row("idle", result.end_time - channel.total_busy());
    blocks.emplace_back(std::move(table));
  }
}

/// What queues dropped, by class.
void add_drops(Blocks& blocks, const RunResult& result) {
  if (!result.dropped) return;
  Table table{{{"dropped frames"}, {"at stations", to_right}, {"at access points", to_right}}, {}};
  for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
    const std::uint64_t up = result.dropped->at_stations[k];
    const std::uint64_t down = result.dropped->at_access_points[k];
    if (up + down == 0) continue;
    table.rows.push_back(
        {{words_of(static_cast<model::TrafficClass>(k)), grouped(up), grouped(down)}});
  }
  if (table.rows.empty()) {
    blocks.emplace_back(Paragraph{"queues dropped no frame"});
  } else {
    blocks.emplace_back(std::move(table));
  }
}

Table delays(const RunResult& result) {
  Table table{{{"delay of packets"},
               {"received", to_right},
               {"in backlog", to_right},
               {"queue+service", to_right},
               {"longest", to_right}},
              {}};
  for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
    const model::Latency& latency = result.latency[k];
    if (latency.packets == 0) continue;
    const auto mean = [&](Nanoseconds sum) {
      return duration(Nanoseconds{sum.count() / static_cast<std::int64_t>(latency.packets)});
    };
    table.rows.push_back(
        {{words_of(static_cast<model::TrafficClass>(k)), grouped(latency.packets),
          mean(latency.backlog_sum), mean(latency.service_sum), duration(latency.longest)}});
  }
  return table;
}

void add_backlogs(Blocks& blocks, const Simulation& s) {
  if (s.result.channels.empty()) return;
  constexpr std::size_t listed = 12;
  const auto& backlog = s.result.backlog;
  std::vector<std::size_t> order(backlog.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return backlog[a].packets > backlog[b].packets; });
  if (backlog[order.front()].packets == 0) {
    blocks.emplace_back(Paragraph{"highest backlog: no packet waited for room in a source queue"});
    return;
  }
  Table table{
      {{"highest backlog"}, {"packets", to_right}, {"at", to_right}, {"at the end", to_right}}, {}};
  for (std::size_t k = 0; k < std::min(order.size(), listed); ++k) {
    const model::BacklogPeak& peak = backlog[order[k]];
    const std::uint32_t host = s.scenario.deployment.participants[order[k]].host.value;
    table.rows.push_back(
        {{fmt::format("participant {} on host {}", order[k], host), grouped(peak.packets),
          duration(peak.at), grouped(peak.packets_at_end)}});
  }
  blocks.emplace_back(std::move(table));
  if (order.size() > listed) {
    blocks.emplace_back(
        Paragraph{fmt::format("… and {} more, none higher", order.size() - listed)});
  }
}

std::string descriptor_text(const model::MissingDescriptor& d) {
  return fmt::format("{} {} of participant {} at participant {}", name_of(d.stream),
                     d.descriptor.value, d.source.value, d.destination.value);
}

void add_last_delivery(Blocks& blocks, const RunResult& result) {
  if (!result.last_delivery) return;
  const model::LastDelivery& last = *result.last_delivery;
  blocks.emplace_back(Paragraph{fmt::format(
      "last descriptor: {}, in {} DATA; generated at {}, {} in the backlog, {} in queue and "
      "service, received at {}",
      descriptor_text(last.descriptor), last.repair ? "repair" : "initial", duration(last.emitted),
      duration(last.admitted - last.emitted), duration(last.received - last.admitted),
      duration(last.received))});
}

void add_missing(Blocks& blocks, const RunResult& result) {
  if (result.missing.empty()) return;
  constexpr std::size_t listed = 5;
  Bullets bullets;
  for (std::size_t k = 0; k < std::min(listed, result.missing.size()); ++k) {
    bullets.items.emplace_back(descriptor_text(result.missing[k]));
  }
  if (result.missing_count > listed) {
    bullets.items.emplace_back(fmt::format("and {} more (--format json lists the first {})",
                                           grouped(result.missing_count - listed),
                                           RunResult::missing_listed));
  }
  blocks.emplace_back(Section{"missing descriptors", "missing", {std::move(bullets)}});
}

Section reading(const RunResult& result) {
  const std::uint64_t all = result.useful_deliveries + result.duplicate_deliveries;
  Bullets bullets;
  if (result.duplicate_deliveries > 0) {
    bullets.items.emplace_back(fmt::format(
        "{} of the descriptor deliveries were repeats of what the receiver already had.",
        percent(static_cast<double>(result.duplicate_deliveries), static_cast<double>(all))));
  }
  if (result.counts.repair_data > 0) {
    bullets.items.emplace_back(fmt::format(
        "{} repairs for {} initial DATA: receivers reported as missing what was still on its way "
        "(or lost), and each repair queued behind the traffic that had delayed the original.",
        grouped(result.counts.repair_data), grouped(result.counts.initial_data)));
  } else {
    bullets.items.emplace_back(
        "No repair was generated: no ACKNACK reported as missing what was still on its way.");
  }
  const std::uint64_t control = result.counts.heartbeat + result.counts.acknack;
  bullets.items.emplace_back(fmt::format(
      "{} of all messages are HEARTBEATs and ACKNACKs.",
      percent(static_cast<double>(control), static_cast<double>(result.counts.total()))));
  return {"reading", "reading", {std::move(bullets)}};
}

void add_footer(Blocks& blocks, const Simulation& s) {
  blocks.emplace_back(Paragraph{fmt::format(
      "{} events. This is the one trajectory of the model for these inputs, exact to the ns; {} "
      "states its rules and assumptions.",
      grouped(s.result.events), model::traits_of(s.scenario.dds).guide)});
  if (s.result.counts.repair_data == 0) return;
  if (trials::starts_are_spread(s.scenario.deployment) && trials::lacks_hosts(s.scenario)) {
    blocks.emplace_back(Paragraph{fmt::format(
        "Starts are spread, and programs take no time here, which makes more repairs than live "
        "runs have: --set hosts={} is nearer to them.",
        trials::usual_hosts)});
  }
  if (!s.samples.empty()) return;
  blocks.emplace_back(Paragraph{
      "A single run of a storm is chaotic: --start-jitter 100ms shows the range of outcomes when "
      "processes start at slightly different times."});
}

}  // namespace

Document document_of(const Simulation& s) {
  const bool exceeded = std::ranges::any_of(s.limits, &props::LimitReading::exceeded);
  Document document;
  document.title = "stormproof simulate " + s.name;
  const exact::Outlook outlook = s.outlook();
  const bool completed = outlook.completed() == outlook.size();
  document.exit_code = exceeded ? 1 : completed ? 0 : 3;
  document.tone = exceeded ? Tone::bad : tone_of(outlook.health());
  document.complete = s.result.end != model::RunEnd::interrupted;
  document.subject = fmt::format("{}: {}, {}, {} to be delivered across hosts", s.name,
                                 plural(s.scenario.deployment.host_count(), "host"),
                                 plural(s.scenario.deployment.size(), "participant"),
                                 plural(s.failure_free.initial_data, "descriptor"));
  document.answer = outlook.headline() + ": " + outlook.sentence();
  if (s.samples.empty()) {
    document.elaboration = elaboration(s);
  } else {
    document.blocks.emplace_back(Paragraph{
        fmt::format("What follows is the run with seed {}, which {}. ", model::own_seed(s.scenario),
                    s.result.completed() ? "completes after " + duration(*s.result.discovery_time)
                                         : std::string{"does not complete"}) +
        elaboration(s)});
  }
  document.next = checker::next_steps(s.words, s.scenario, outlook);
  if (std::string svg = distribution_plot(s.samples, s.scenario.time_limit); !svg.empty()) {
    document.blocks.emplace_back(Drawing{std::move(svg), "The runs by their completion"},
                                 Audience::page);
  }
  add_limits(document, s);
  if (const std::string text = unreached(s.scenario); !text.empty()) {
    document.blocks.emplace_back(Paragraph{text, Tone::warn});
  }
  Blocks& blocks = document.blocks;
  add_definition(blocks, outlook.health() == exact::Health::storm, s.scenario.limits);
  blocks.emplace_back(messages(s));
  if (s.result.user_control > 0) {
    blocks.emplace_back(
        Paragraph{"user control: matched user endpoints and liveliness; in no class"});
  }
  if (s.result.counts.lookup > 0) {
    blocks.emplace_back(Paragraph{
        "lookups: questions about types, and answers, one for each receiver; in no class"});
  }
  add_channels(blocks, s.result);
  add_drops(blocks, s.result);
  add_missing(blocks, s.result);
  blocks.emplace_back(reading(s.result));
  Section waiting{"Where packets wait", "waiting", {delays(s.result)}};
  add_backlogs(waiting.blocks, s);
  add_last_delivery(waiting.blocks, s.result);
  blocks.emplace_back(std::move(waiting), Audience::verbose);
  add_footer(blocks, s);
  add_unmodelled(document, s.scenario);
  return document;
}

}  // namespace stormproof::report
