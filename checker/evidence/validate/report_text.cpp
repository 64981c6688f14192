// The report for people.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "checker/evidence/validate/validate.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::validate {

namespace {

using report::grouped;
using report::left;
using report::right;

std::string time_text(double ns) {
  return report::duration(model::Nanoseconds{static_cast<std::int64_t>(std::llround(ns))});
}

std::string value_text(Figure figure, const std::optional<double>& value, const char* absent) {
  if (!value) return absent;
  if (is_time(figure)) return time_text(*value);
  return grouped(static_cast<std::uint64_t>(std::llround(*value)));
}

std::string position_text(const Row& row) {
  switch (row.position) {
    case Position::below:
      return "below the model's range";
    case Position::inside:
      return "inside";
    case Position::above:
      return "above the model's range";
    default:
      return "";
  }
}

std::string row_text(const Report& report, const Row& row, const char* indent) {
  const bool has_runs = row.median || row.low || (report.runs > 0 && report.complete < report.runs);
  const char* absent = has_runs ? "> limit" : "–";
  const auto value = [&](const std::optional<double>& one) {
    return right(value_text(row.figure, one, absent), 12);
  };
  const std::string ratio = row.ratio ? fmt::format("{:.2f}", *row.ratio) : "–";
  std::string line = left(indent + std::string{label_of(row.figure)}, 22) +
                     right(value_text(row.figure, row.observed, "–"), 12) + value(row.median);
  if (report.is_drawn) line += value(row.low) + value(row.high);
  line += right(ratio, 8);
  const std::string position = position_text(row);
  if (!position.empty()) line += "  " + position;
  return line + "\n";
}

std::string rows_text(const Report& report) {
  std::string text =
      left("", 22) + right("observed", 12) + right(report.is_drawn ? "median" : "one run", 12);
  if (report.is_drawn) text += right("5 %", 12) + right("95 %", 12);
  text += right("ratio", 8) + "  observation\n";
  for (const Row& row : report.rows) {
    const bool is_kind =
        row.figure >= Figure::initial_pulled && row.figure <= Figure::acknack_positive;
    const bool is_stage = row.figure == Figure::last_open || row.figure == Figure::last_initial;
    if (is_kind || is_stage) continue;
    text += row_text(report, row, "  ");
    const auto kinds = [&](Figure first, Figure last) {
      for (std::size_t k = index_of(first); k <= index_of(last); ++k) {
        text += row_text(report, report.rows[k], "    ");
      }
    };
    if (row.figure == Figure::completion) kinds(Figure::last_open, Figure::last_initial);
    if (row.figure == Figure::initial_data) kinds(Figure::initial_pulled, Figure::initial_pulled);
    if (row.figure == Figure::heartbeat) kinds(Figure::heartbeat_open, Figure::heartbeat_periodic);
    if (row.figure == Figure::acknack) kinds(Figure::acknack_initial, Figure::acknack_positive);
  }
  return text;
}

/// A few instants of the growth: observed, and the model's median beside it.
std::string over_time_text(const Report& report) {
  if (report.bands.empty()) return "";
  constexpr std::array<std::size_t, 5> curves{0, 1, 2, 3, growth_curves - 1};  // without SPDP; all
  constexpr std::size_t instants = 8;
  std::string text = "\nsent so far, observed | model's median\n" + left("", 12);
  for (const std::size_t curve : curves) {
    text += right(label_of(figure_of_curve(curve)), 17);
  }
  text += "\n";
  const Growth& growth = report.observation.growth;
  for (std::size_t k = 1; k <= instants; ++k) {
    const std::size_t step = k * growth.points.size() / instants - 1;
    text +=
        right(time_text(static_cast<double>(growth.step_ns) * static_cast<double>(step + 1)), 12);
    for (const std::size_t index : curves) {
      text += right(
          fmt::format(
              "{} | {}", grouped(growth.points[step][index]),
              grouped(static_cast<std::uint64_t>(std::llround(report.bands[step][index].median)))),
          17);
    }
    text += "\n";
  }
  return text;
}

std::string creation_text(const Report& report) {
  model::Nanoseconds least = report.observation.deployment.participants.front().created_earliest;
  model::Nanoseconds greatest;
  model::Nanoseconds widest;
  for (const CapturedParticipant& one : report.observation.deployment.participants) {
    least = std::min(least, one.created_earliest);
    greatest = std::max(greatest, one.created_latest);
    widest = std::max(widest, one.created_latest - one.created_earliest);
  }
  const std::string times = fmt::format("last endpoints created between {} and {}",
                                        report::duration(least), report::duration(greatest));
  if (report.request.endpoints_done) return times + ", as given";
  if (widest.count() == 0) return times + ", all of them seen";
  return fmt::format("{}, each known to {} or better", times, report::duration(widest));
}

std::string head_text(const Report& report, const Heading& heading) {
  const Observation& observation = report.observation;
  model::Nanoseconds last_start;
  std::uint64_t endpoints = 0;
  for (const CapturedParticipant& one : observation.deployment.participants) {
    last_start = std::max(last_start, one.start);
    endpoints += one.publications + one.subscriptions;
  }
  std::string text;
  for (const std::string& name : heading.captures) text += name + "\n";
  text +=
      fmt::format("{} hosts, {} participants, {} endpoints; participants start within {};\n{}\n",
                  observation.deployment.hosts, observation.deployment.participants.size(),
                  grouped(endpoints), report::duration(last_start), creation_text(report));
  if (!observation.complete) {
    text += report::paragraph("", fmt::format("The observation is incomplete: {} of {} descriptors "
                                              "were not sent until the cut, so its "
                                              "figures are lower bounds.",
                                              grouped(observation.counting.missing_count),
                                              grouped(observation.counting.required)));
  }
  text += report.is_drawn
              ? fmt::format("model: {} over {}, {} of {} runs finished, {} complete\n\n",
                            report.request.dds, report.request.wireless, report.runs, report.wanted,
                            report.complete)
              : fmt::format("model: {} over {}, one run: nothing is left to draw\n\n",
                            report.request.dds, report.request.wireless);
  return text;
}

std::string verdict_text(const Report& report) {
  const auto of = [&](Figure figure) {
    const std::optional<double> ratio = report.of(figure).ratio;
    return ratio ? fmt::format("{:.2f}", *ratio) : std::string{"unknown"};
  };
  const std::string ratios =
      fmt::format("model/observed is {} for completion and {} for all messages",
                  of(Figure::completion), of(Figure::total));
  switch (report.agreement) {
    case Agreement::not_asked:
      return "";
    case Agreement::within:
      return fmt::format("\nWITHIN a factor of {}: {}.\n", *report.request.within, ratios);
    case Agreement::beyond:
      return fmt::format("\nBEYOND a factor of {}: {}.\n", *report.request.within, ratios);
    case Agreement::undecided:
      return fmt::format("\nUNDECIDED: {}; {}.\n", ratios,
                         report.observation.complete ? "too few runs of the model completed"
                                                     : "the observation is incomplete");
  }
  return "";
}

std::string assumptions_text(const Report& report) {
  const Observation& observation = report.observation;
  std::string text = "\nWhat is compared\n";
  const auto item = [&text](const std::string& words) { text += report::paragraph("  * ", words); };
  item(observation.cut == Cut::given
           ? "completion: from the first announcement to --until in the capture, to the reception "
             "of the last missing descriptor (T_disc) in the model; all counts end there"
           : "completion: from the first announcement to the instant when the last descriptor that "
             "somebody needs was sent for the first time, in the capture and in the model; all "
             "counts end there");
  item(
      "messages count when they are sent: at the interface in the capture, at generation in the "
      "model");
  item("the model's participants start at their first captured announcement");
  if (report.scenario.dds.implementation == model::ImplementationKind::fastdds) {
    item(
        fmt::format("endpoints are created at equal intervals until the last one, {}; packets to "
                    "the same host take {}",
                    report.request.endpoints_done
                        ? "which is drawn from --endpoints-done"
                        : "which is drawn from what HEARTBEATs and pushed DATA prove, "
                          "give or take how uneven the creations seen are",
                    report::duration(report.scenario.deployment.loopback_delay)));
  }
  item(report.request.sampling.loss > 0
           ? fmt::format("each packet is lost with probability {}", report.request.sampling.loss)
           : std::string{"no packet is lost"});
  return text;
}

std::string differences_text(const Report& report) {
  if (report.differences.empty()) return "";
  std::string text = "\nIn the capture, not in the model\n";
  for (const Difference& one : report.differences) {
    text += report::paragraph("  * ", one.text);
  }
  return text;
}

}  // namespace

std::string to_text(const Report& report, const Heading& heading) {
  return head_text(report, heading) + rows_text(report) + over_time_text(report) +
         verdict_text(report) + assumptions_text(report) + differences_text(report) +
         report::unmodelled_text(report.scenario.dds) +
         fmt::format("\nReproduce: {}\n", heading.command);
}

}  // namespace stormproof::validate
