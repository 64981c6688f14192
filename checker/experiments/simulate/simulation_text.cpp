// The text form of a simulation: the answer first, then what it consists of, then what it means.
#include <algorithm>
#include <numeric>

#include <fmt/core.h>

#include "checker/experiments/simulate/simulation_report.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::report {

namespace {

using model::Nanoseconds;
using model::RunResult;

const char* label(std::size_t message_class) {
  static constexpr const char* labels[] = {"initial DATA", "repair DATA",    "HEARTBEAT",
                                           "ACKNACK",      "SPDP multicast", "SPDP unicast"};
  return labels[message_class];
}

const char* label(model::TrafficClass traffic) {
  static constexpr const char* labels[] = {"SPDP",      "initial DATA", "repair DATA",
                                           "HEARTBEAT", "ACKNACK",      "user control"};
  return labels[static_cast<std::size_t>(traffic)];
}

std::string plural(std::uint64_t count, const std::string& noun) {
  return grouped(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string headline(const Simulation& s) {
  const RunResult& result = s.result;
  if (result.completed()) {
    const std::string answer =
        fmt::format("Discovery completes after {}.\n", duration(*result.discovery_time));
    if (result.end == model::RunEnd::completed) return answer;
    return answer + fmt::format(
                        "The run goes on after that, as run_until: {} asks for, and ends after {}; "
                        "what follows covers all of it.\n",
                        "time_limit", duration(result.end_time));
  }
  const std::string limit = duration(s.scenario.time_limit);
  std::string reason;
  switch (result.end) {
    case model::RunEnd::time_limit:
      reason = "by the time limit of " + limit;
      break;
    case model::RunEnd::no_more_events:
      reason = "and no event is left";
      break;
    case model::RunEnd::interrupted:
      reason = "by " + duration(result.end_time) + ", when the run was interrupted";
      break;
    case model::RunEnd::completed:
      break;
  }
  return fmt::format(
      "Discovery does NOT complete {}: {} of {} descriptor deliveries are missing.\n", reason,
      grouped(result.missing_count), grouped(s.failure_free.initial_data));
}

std::string deployment(const Simulation& s) {
  return fmt::format("{}: {}, {}, {} to be delivered across hosts\n", s.name,
                     plural(s.scenario.deployment.host_count(), "host"),
                     plural(s.scenario.deployment.size(), "participant"),
                     plural(s.failure_free.initial_data, "descriptor"));
}

std::string baseline(const Simulation& s) {
  if (!s.open_loop) {
    return "No open-loop airtime: this profile has a constant delay and no channel.\n";
  }
  std::string text = fmt::format("Everything sent once would need {} of airtime (open loop)",
                                 duration(*s.open_loop));
  const auto open_loop = static_cast<double>(s.open_loop->count());
  const auto end = static_cast<double>(s.result.discovery_time.value_or(s.result.end_time).count());
  if (s.result.completed()) {
    return text + fmt::format("; the closed loop takes {} as long.\n", ratio(end, open_loop));
  }
  return text + fmt::format("; the run ended after {} of that.\n", ratio(end, open_loop));
}

/// "limit completion 3 s: exceeded (6.263 s)", a line each.
std::string limits(const Simulation& s) {
  std::string text;
  for (const props::LimitReading& reading : s.limits) {
    const std::string name{reading.id.substr(reading.id.find('.') + 1)};
    const auto print = [&](double value) -> std::string {
      if (name == "completion") return duration(Nanoseconds{static_cast<std::int64_t>(value)});
      if (name == "amplification") return ratio(value, 1);
      return grouped(static_cast<std::uint64_t>(value));
    };
    const char* verdict = reading.exceeded ? "exceeded" : reading.reached ? "kept" : "not known";
    text += fmt::format("limit {} {}: {} ({})\n", name, print(reading.limit), verdict,
                        reading.reached ? print(*reading.reached) : "not complete");
  }
  return text;
}

std::string messages(const Simulation& s) {
  std::string text = fmt::format("{}{}{}{}\n", left("messages", 20), right("this run", 14),
                                 right("failure-free", 14), right("amplification", 15));
  const auto row = [&](const std::string& name, std::uint64_t value, std::uint64_t reference) {
    text +=
        fmt::format("{}{}{}{}\n", left("  " + name, 20), right(grouped(value), 14),
                    right(grouped(reference), 14),
                    right(ratio(static_cast<double>(value), static_cast<double>(reference)), 15));
  };
  const auto counts = s.result.counts.entries();
  const auto reference = s.failure_free.entries();
  for (std::size_t k = 0; k < counts.size(); ++k)
    row(label(k), counts[k].value, reference[k].value);
  row("total", s.result.counts.total(), s.failure_free.total());
  if (s.result.user_control > 0) {
    text += fmt::format("{}{}   (matched user endpoints and liveliness; in no class)\n",
                        left("  user control", 20), right(grouped(s.result.user_control), 14));
  }
  return text;
}

/// "SPDP … idle", one line each with a bar of the share of the elapsed time.
std::string channel_use(const RunResult& result) {
  std::string text;
  const auto elapsed = static_cast<double>(result.end_time.count());
  for (const model::ChannelUse& channel : result.channels) {
    const auto busy = static_cast<double>(channel.total_busy().count());
    text +=
        fmt::format("\nchannel {}: busy {} of the time\n", channel.name, percent(busy, elapsed));
    const auto row = [&](const char* name, Nanoseconds time) {
      const double share = elapsed > 0 ? static_cast<double>(time.count()) / elapsed : 0;
      const std::string bar(static_cast<std::size_t>(40 * share + 0.5), '#');
      text +=
          fmt::format("{}{}{}{}{}\n", left(std::string("  ") + name, 20), right(duration(time), 14),
                      right(percent(static_cast<double>(time.count()), elapsed), 10),
                      bar.empty() ? "" : "  ", bar);
    };
    for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
      if (channel.busy[k].count() > 0)
        row(label(static_cast<model::TrafficClass>(k)), channel.busy[k]);
    }
    row("idle", result.end_time - channel.total_busy());
  }
  return text;
}

std::string delays(const RunResult& result) {
  std::string text =
      fmt::format("\n{}{}{}{}{}\n", left("delay of packets", 20), right("received", 12),
                  right("in backlog", 14), right("queue+service", 15), right("longest", 12));
  for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
    const model::Latency& latency = result.latency[k];
    if (latency.packets == 0) continue;
    const auto mean = [&](Nanoseconds sum) {
      return duration(Nanoseconds{sum.count() / static_cast<std::int64_t>(latency.packets)});
    };
    const std::string name = label(static_cast<model::TrafficClass>(k));
    text += fmt::format("{}{}{}{}{}\n", left("  " + name, 20), right(grouped(latency.packets), 12),
                        right(mean(latency.backlog_sum), 14), right(mean(latency.service_sum), 15),
                        right(duration(latency.longest), 12));
  }
  return text;
}

std::string backlogs(const Simulation& s) {
  constexpr std::size_t listed = 12;
  const auto& backlog = s.result.backlog;
  std::vector<std::size_t> order(backlog.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return backlog[a].packets > backlog[b].packets;
  });
  if (backlog[order.front()].packets == 0) {
    return "\nhighest backlog: no packet waited for room in a source queue\n";
  }
  std::string text = fmt::format("\n{}{}{}{}\n", left("highest backlog", 32), right("packets", 12),
                                 right("at", 12), right("at the end", 14));
  for (std::size_t k = 0; k < std::min(order.size(), listed); ++k) {
    const model::BacklogPeak& peak = backlog[order[k]];
    const std::uint32_t host = s.scenario.deployment.participants[order[k]].host.value;
    text += fmt::format("{}{}{}{}\n",
                        left(fmt::format("  participant {} on host {}", order[k], host), 32),
                        right(grouped(peak.packets), 12), right(duration(peak.at), 12),
                        right(grouped(peak.packets_at_end), 14));
  }
  if (order.size() > listed) {
    text += fmt::format("  … and {} more, none higher\n", order.size() - listed);
  }
  return text;
}

std::string last_delivery(const RunResult& result) {
  if (!result.last_delivery) return "";
  const model::LastDelivery& last = *result.last_delivery;
  const model::MissingDescriptor& d = last.descriptor;
  return fmt::format(
      "\nlast descriptor: {} {} of participant {} at participant {}, in {} DATA\n"
      "  generated at {}, {} in the backlog, {} in queue and service, received at {}\n",
      name_of(d.stream), d.descriptor.value, d.source.value, d.destination.value,
      last.repair ? "repair" : "initial", duration(last.emitted),
      duration(last.admitted - last.emitted), duration(last.received - last.admitted),
      duration(last.received));
}

std::string missing(const RunResult& result) {
  if (result.missing.empty()) return "";
  constexpr std::size_t listed = 5;
  std::string text = "\nmissing descriptors:\n";
  for (std::size_t k = 0; k < std::min(listed, result.missing.size()); ++k) {
    const model::MissingDescriptor& m = result.missing[k];
    text += fmt::format("  {} {} of participant {} at participant {}\n", name_of(m.stream),
                        m.descriptor.value, m.source.value, m.destination.value);
  }
  if (result.missing_count > listed) {
    text += fmt::format("  … and {} more (--format json lists the first {})\n",
                        grouped(result.missing_count - listed), RunResult::missing_listed);
  }
  return text;
}

std::string reading(const Simulation& s) {
  const RunResult& result = s.result;
  const std::uint64_t all = result.useful_deliveries + result.duplicate_deliveries;
  std::string text = "\nreading\n";
  if (result.duplicate_deliveries > 0) {
    text += fmt::format(
        "  {} of the descriptor deliveries were repeats of what the receiver already had.\n",
        percent(static_cast<double>(result.duplicate_deliveries), static_cast<double>(all)));
  }
  if (result.counts.repair_data > 0) {
    text += fmt::format(
        "  {} repairs for {} initial DATA: receivers reported as missing what was still on its "
        "way\n"
        "  (or lost), and each repair queued behind the traffic that had delayed the original.\n",
        grouped(result.counts.repair_data), grouped(result.counts.initial_data));
  } else {
    text +=
        "  No repair was generated: no ACKNACK reported as missing what was still on its way.\n";
  }
  const std::uint64_t control = result.counts.heartbeat + result.counts.acknack;
  text += fmt::format(
      "  {} of all messages are HEARTBEATs and ACKNACKs.\n",
      percent(static_cast<double>(control), static_cast<double>(result.counts.total())));
  return text;
}

std::string footer(const Simulation& s) {
  const bool fastdds = s.scenario.dds.implementation == model::ImplementationKind::fastdds;
  std::string text = fmt::format(
      "\n{} events. This is the one trajectory of the model for these inputs, exact to the ns;\n"
      "{} states its rules and assumptions.\n",
      grouped(s.result.events), fastdds ? "specs/guide/fastdds.md" : "specs/guide/model.md");
  if (s.result.counts.repair_data > 0) {
    text +=
        s.scenario.deployment.schedule
            ? "A single run of a storm is chaotic: --samples 12 shows the range over start times.\n"
            : "A single run of a storm is chaotic: with start times drawn from ranges\n"
              "(deployment.schedule), --samples 12 shows the range of outcomes.\n";
  }
  return text;
}

}  // namespace

std::string to_text(const Simulation& s) {
  return deployment(s) + headline(s) + baseline(s) + limits(s) + "\n" + messages(s) +
         channel_use(s.result) + delays(s.result) + (s.result.channels.empty() ? "" : backlogs(s)) +
         last_delivery(s.result) + missing(s.result) + reading(s) +
         unmodelled_text(s.scenario.dds) + footer(s);
}

}  // namespace stormproof::report
