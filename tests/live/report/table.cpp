// Runs of the live bed as a table and as JSON.
#include <algorithm>
#include <functional>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "tests/live/report/judgement.hpp"

namespace stormproof::live {

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double seconds_per_ns = 1e-9;

struct Column {
  const char* title;
  int width;
  std::function<std::int64_t(const RunRecord&)> value;
  bool is_duration = false;
};

const std::vector<Column>& columns() {
  static const std::vector<Column> all = {
      {"app s", 9, &RunRecord::app_duration_ns, true},
      {"strict s", 9, &RunRecord::strict_duration_ns, true},
      {"SPDP", 7, [](const RunRecord& run) { return run.counts.spdp; }},
      {"initial", 8, [](const RunRecord& run) { return run.counts.initial_data; }},
      {"repair", 8, [](const RunRecord& run) { return run.counts.repair_data; }},
      {"HEARTBEAT", 10, [](const RunRecord& run) { return run.counts.heartbeat; }},
      {"ACKNACK", 8, [](const RunRecord& run) { return run.counts.acknack; }},
      {"total", 8, [](const RunRecord& run) { return run.counts.total; }}};
  return all;
}

std::string cell(const Column& column, std::int64_t value) {
  if (!column.is_duration) return fmt::format("{:>{}}", value, column.width);
  return fmt::format("{:>{}.3f}", static_cast<double>(value) * seconds_per_ns, column.width);
}

std::string line_of(const RunRecord& run) {
  std::string line = fmt::format("{:<10}", run.name);
  for (const Column& column : columns()) {
    line += column.is_duration && !run.is_complete() ? fmt::format("{:>{}}", "–", column.width)
                                                     : cell(column, column.value(run));
  }
  return line + (run.is_complete() ? "\n" : "  not complete\n");
}

/// The lower median, so that it is one of the values.
std::int64_t quantile(std::vector<std::int64_t> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(static_cast<double>(values.size() - 1) * part)];
}

/// Least, median and most of the complete runs.
std::string range_of(const std::vector<RunRecord>& runs) {
  std::string text;
  for (const auto& [name, part] : {std::pair{"least", 0.0}, {"median", 0.5}, {"most", 1.0}}) {
    text += fmt::format("{:<10}", name);
    for (const Column& column : columns()) {
      std::vector<std::int64_t> values;
      std::transform(runs.begin(), runs.end(), std::back_inserter(values), column.value);
      text += cell(column, quantile(std::move(values), part));
    }
    text += "\n";
  }
  return text;
}

OrderedJson counts_of(const Counts& counts) {
  return {{"spdp", counts.spdp},
          {"initial_data", counts.initial_data},
          {"repair_data", counts.repair_data},
          {"heartbeat", counts.heartbeat},
          {"acknack", counts.acknack},
          {"total", counts.total}};
}

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::as_expected:
      return "as_expected";
    case Outcome::check_failed:
      return "check_failed";
    case Outcome::incomplete:
      return "incomplete";
  }
  return "";
}

OrderedJson json_of(const RunRecord& run) {
  const Judgement judgement = judge(run);
  OrderedJson json = {{"name", run.name},
                      {"link", run.link},
                      {"participants_per_host", run.participants_per_host},
                      {"endpoints_per_participant", run.endpoints_per_participant},
                      {"outcome", name_of(judgement.outcome)},
                      {"app_ns", nullptr},
                      {"strict_ns", nullptr},
                      {"counts", counts_of(run.counts)},
                      {"expected_initial_data", run.expected_initial()},
                      {"missing_keys", run.missing_keys},
                      {"remarks", judgement.remarks},
                      {"notes", judgement.notes}};
  if (run.is_complete()) {
    json["app_ns"] = run.app_duration_ns();
    json["strict_ns"] = run.strict_duration_ns();
  }
  return json;
}

}  // namespace

std::string to_text(const std::vector<RunRecord>& runs) {
  std::string text = fmt::format("{:<10}", "run");
  for (const Column& column : columns()) text += fmt::format("{:>{}}", column.title, column.width);
  text += "\n";
  std::vector<RunRecord> complete;
  for (const RunRecord& run : runs) {
    text += line_of(run);
    if (run.is_complete()) complete.push_back(run);
  }
  if (complete.size() > 1) text += range_of(complete);
  for (const RunRecord& run : runs) {
    const Judgement judgement = judge(run);
    for (const auto* list : {&judgement.remarks, &judgement.notes}) {
      for (const std::string& line : *list) text += fmt::format("{}: {}\n", run.name, line);
    }
  }
  return text;
}

std::string to_json(const std::vector<RunRecord>& runs) {
  OrderedJson json = {{"runs", OrderedJson::array()}};
  for (const RunRecord& run : runs) json["runs"].push_back(json_of(run));
  return json.dump(2) + "\n";
}

}  // namespace stormproof::live
