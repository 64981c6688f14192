// The report for people: how far model and observation agree, figure by figure and over time, what
// is compared, and what the capture has that the model has not.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "checker/evidence/validate/validate.hpp"
#include "checker/experiments/trials/usual_hosts.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/text/figures.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/implementations.hpp"

namespace stormproof::validate {

namespace {

using report::Column;
using report::grouped;
using report::plural;
using report::Table;
using report::Tone;

constexpr auto to_the_right = Column::Align::right;

std::string value_text(Figure figure, const std::optional<double>& value, const char* absent) {
  if (!value) return absent;
  if (is_time(figure)) return report::time_figure(*value);
  return report::count_figure(*value);
}

std::string position_text(const Row& row) {
  switch (row.position) {
    case Position::below:
      return "below the model's range";
    case Position::inside:
      return "inside";
    case Position::above:
      return "above the model's range";
    case Position::unknown:
      break;
  }
  return "";
}

/// A kind of the messages, or a part of the time, that another row has as a whole.
bool is_part(Figure figure) {
  const bool is_kind = figure >= Figure::initial_pulled && figure <= Figure::acknack_positive;
  return is_kind || figure == Figure::last_open || figure == Figure::last_initial;
}

/// The parts of a figure stand below it.
std::vector<Figure> parts_of(Figure figure) {
  switch (figure) {
    case Figure::completion:
      return {Figure::last_open, Figure::last_initial};
    case Figure::initial_data:
      return {Figure::initial_pulled};
    case Figure::heartbeat:
      return {Figure::heartbeat_open, Figure::heartbeat_reply, Figure::heartbeat_piggyback,
              Figure::heartbeat_periodic};
    case Figure::acknack:
      return {Figure::acknack_initial, Figure::acknack_negative, Figure::acknack_positive};
    default:
      return {};
  }
}

Table::Row figure_row(const Report& report, const Row& row) {
  const bool has_runs = row.median || row.low || (report.runs > 0 && report.complete < report.runs);
  const char* absent = has_runs ? "> limit" : "–";
  Table::Row shown{{std::string{is_part(row.figure) ? "· " : ""} + label_of(row.figure),
                    value_text(row.figure, row.observed, "–"),
                    value_text(row.figure, row.median, absent)}};
  if (report.is_drawn) {
    shown.cells.emplace_back(value_text(row.figure, row.low, absent));
    shown.cells.emplace_back(value_text(row.figure, row.high, absent));
  }
  shown.cells.emplace_back(row.ratio ? fmt::format("{:.2f}", *row.ratio) : "–");
  shown.cells.emplace_back(position_text(row));
  return shown;
}

report::Section figures(const Report& report) {
  Table table{{{"figure"}, {"observed", to_the_right}}, {}};
  table.columns.push_back({report.is_drawn ? "median" : "one run", to_the_right});
  if (report.is_drawn) {
    table.columns.push_back({"5 %", to_the_right});
    table.columns.push_back({"95 %", to_the_right});
  }
  table.columns.push_back({"ratio", to_the_right});
  table.columns.push_back({"observation"});
  for (const Row& row : report.rows) {
    if (is_part(row.figure) || !is_shown(report, row.figure)) continue;
    table.rows.push_back(figure_row(report, row));
    for (const Figure part : parts_of(row.figure)) {
      table.rows.push_back(figure_row(report, report.of(part)));
    }
  }
  return {"Model beside observation", "figures", {std::move(table)}};
}

/// A few instants of the growth: observed, and the model's median beside it.
report::Section over_time(const Report& report) {
  constexpr std::array<std::size_t, 5> curves{0, 1, 2, 3, growth_curves - 1};  // without SPDP; all
  constexpr std::size_t instants = 8;
  Table table{{{"until", to_the_right}}, {}};
  for (const std::size_t curve : curves) {
    table.columns.push_back({label_of(figure_of_curve(curve)), to_the_right});
  }
  const Growth& growth = report.observation.growth;
  for (std::size_t k = 1; k <= instants; ++k) {
    const std::size_t step = k * growth.points.size() / instants - 1;
    Table::Row row{
        {report::time_figure(static_cast<double>(growth.step_ns) * static_cast<double>(step + 1))}};
    for (const std::size_t index : curves) {
      const auto median =
          static_cast<std::uint64_t>(std::llround(report.bands[step][index].median));
      row.cells.emplace_back(
          fmt::format("{} | {}", grouped(growth.points[step][index]), grouped(median)));
    }
    table.rows.push_back(std::move(row));
  }
  table.caption = "observed | model's median";
  return {
      "Sent so far",
      "time",
      {std::move(table),
       {report::Drawing{to_svg(report), "Messages over time, model beside observation", "growth"},
        report::Audience::page}}};
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

/// "the air: busy 93 % of the time (…)".
std::string limit_text(const Limiting& limiting) {
  const auto percent = [](double share) { return fmt::format("{:.0f} %", 100 * share); };
  const Shares& shares = limiting.median;
  const std::string all = fmt::format(
      "at the median the air is busy for {} of a run, a sender waits for room for {}, and packets "
      "wait for a thread for {}",
      percent(shares.air), percent(shares.sender), percent(shares.processor));
  switch (limiting.limit) {
    case Limit::air:
      return "the air: " + all;
    case Limit::sender:
      return "the sender: " + all;
    case Limit::processor:
      return "the processor: " + all;
    case Limit::none:
      break;
  }
  return "start times and timers: " + all;
}

report::Facts head(const Report& report, const Heading& heading) {
  const Observation& observation = report.observation;
  model::Nanoseconds last_start;
  std::uint64_t endpoints = 0;
  for (const CapturedParticipant& one : observation.deployment.participants) {
    last_start = std::max(last_start, one.start);
    endpoints += one.publications + one.subscriptions;
  }
  report::Facts facts;
  for (const std::string& name : heading.captures) facts.rows.emplace_back("capture", name);
  facts.rows.emplace_back(
      "discovery",
      fmt::format("{}, {}, {} endpoints; participants start within {}; {}",
                  plural(observation.deployment.hosts, "host"),
                  plural(observation.deployment.participants.size(), "participant"),
                  grouped(endpoints), report::duration(last_start), creation_text(report)));
  if (!observation.complete) {
    facts.rows.emplace_back("incomplete",
                            fmt::format("{} of {} descriptors were not sent until the cut, so the "
                                        "figures observed are lower bounds",
                                        grouped(observation.counting.missing_count),
                                        grouped(observation.counting.required)));
  }
  facts.rows.emplace_back(
      "model",
      fmt::format("{} over {}, {}", report.request.dds, report.request.wireless,
                  report.is_drawn ? fmt::format("{} of {} runs finished, {} complete", report.runs,
                                                report.wanted, report.complete)
                                  : "one run: nothing is left to draw"));
  if (report.usual_hosts) {
    facts.rows.emplace_back("hosts", fmt::format("{}, as starts are spread and --set hosts=… says "
                                                 "nothing else",
                                                 trials::usual_hosts));
  }
  if (report.runs > 0) facts.rows.emplace_back("limited by", limit_text(report.limiting));
  return facts;
}

/// "15 % slower", "3 % fewer messages".
std::string difference(std::optional<double> ratio, const char* more, const char* less,
                       const char* same) {
  if (!ratio) return "not comparable";
  const double percent = 100 * (*ratio - 1);
  if (std::abs(percent) < 0.5) return same;
  return fmt::format("{:.0f} % {}", std::abs(percent), percent > 0 ? more : less);
}

report::Text answer(const Report& report) {
  const std::string ratios = fmt::format(
      "the model's completion is {}, and it sends {} than observed",
      difference(report.of(Figure::completion).ratio, "later", "earlier", "as observed"),
      difference(report.of(Figure::total).ratio, "more messages", "fewer messages",
                 "no more or fewer messages"));
  switch (report.agreement) {
    case Agreement::not_asked:
      break;
    case Agreement::within:
      return fmt::format("WITHIN a factor of {}: {}.", *report.request.within, ratios);
    case Agreement::beyond:
      return fmt::format("BEYOND a factor of {}: {}.", *report.request.within, ratios);
    case Agreement::undecided:
      return fmt::format("UNDECIDED: {}; {}.", ratios,
                         report.observation.complete ? "too few runs of the model completed"
                                                     : "the observation is incomplete");
  }
  return "T" + ratios.substr(1) + ".";
}

Tone tone_of(Agreement agreement) {
  switch (agreement) {
    case Agreement::within:
      return Tone::good;
    case Agreement::beyond:
      return Tone::bad;
    case Agreement::undecided:
      return Tone::warn;
    case Agreement::not_asked:
      break;
  }
  return Tone::plain;
}

report::Section compared(const Report& report) {
  report::Bullets list{
      {report.observation.cut == Cut::given
           ? "completion: from the first announcement to --until in the capture, to the reception "
             "of the last missing descriptor (T_disc) in the model; all counts end there"
           : "completion: from the first announcement to the instant when the last descriptor that "
             "somebody needs was sent for the first time, in the capture and in the model; all "
             "counts end there",
       "messages count when they are sent: at the interface in the capture, at generation in the "
       "model",
       "the model's participants start at their first captured announcement"}};
  const auto unseen = std::ranges::count(report.observation.deployment.participants, false,
                                         &CapturedParticipant::is_seen);
  if (unseen > 0) {
    list.items.emplace_back(fmt::format(
        "{} on the host of the Discovery Server, not on the link: {}",
        plural(static_cast<std::uint64_t>(unseen), "participant"),
        report.request.record.participants.empty()
            ? "taken to start with the first that is seen, and to create endpoints as those do; "
              "--record gives their times"
            : "start and creation come from " + report.request.record.name));
  }
  if (model::traits_of(report.scenario.dds).creates_endpoints_over_time) {
    list.items.emplace_back(
        fmt::format("endpoints are created at equal intervals until the last one, {}; packets to "
                    "the same host take {}",
                    report.request.endpoints_done
                        ? "which is drawn from --endpoints-done"
                        : "which is drawn from what HEARTBEATs and pushed DATA prove, "
                          "give or take how uneven the creations seen are",
                    report::duration(report.scenario.deployment.loopback_delay)));
  }
  list.items.emplace_back(
      report.request.sampling.loss > 0
          ? fmt::format("each packet is lost with probability {}", report.request.sampling.loss)
          : std::string{"no packet is lost"});
  return {"What is compared", "compared", {std::move(list)}};
}

report::Section differences(const Report& report) {
  report::Bullets list;
  for (const Difference& one : report.differences) list.items.emplace_back(one.text);
  return {"In the capture, not in the model", "differences", {std::move(list)}};
}

}  // namespace

report::Document document_of(const Report& report, const Heading& heading) {
  report::Document document;
  document.title = "stormproof validate";
  for (const std::string& name : heading.captures) document.title += " " + name;
  document.tone = tone_of(report.agreement);
  document.answer = answer(report);
  document.blocks.emplace_back(head(report, heading));
  document.blocks.emplace_back(figures(report));
  if (!report.bands.empty())
    document.blocks.emplace_back(over_time(report), report::Audience::verbose);
  document.blocks.emplace_back(compared(report), report::Audience::verbose);
  if (!report.differences.empty()) document.blocks.emplace_back(differences(report));
  report::add_unmodelled(document, report.scenario.dds);
  document.complete = !report.interrupted();
  return document;
}

}  // namespace stormproof::validate
