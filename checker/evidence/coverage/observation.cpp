// Reads JSON Lines and refuses, with line and field, whatever is not a measured run.
#include "checker/evidence/coverage/observation.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/evidence/coverage/row.hpp"
#include "model/deployment.hpp"

namespace stormproof::prediction {

namespace {

/// Every class has its short name of the measurements and its name in the reports of this program.
struct ClassName {
  Measure measure;
  const char* short_name;
};
constexpr ClassName class_names[] = {
    {Measure::spdp_multicast, "spdp_m"}, {Measure::spdp_unicast, "spdp_u"},
    {Measure::initial_data, "init"},     {Measure::repair_data, "repair"},
    {Measure::heartbeat, "hb"},          {Measure::acknack, "ack"},
    {Measure::messages, "total"}};

/// Until the completion that is compared. What a row counts apart until the strict one, if that is
/// later, may be a part of the classes.
void read_counts(const Json& json, Row& row, const ReadOptions& options, Observation& run) {
  const bool apart = options.completion == CompletionTime::strict && row.has("at_strict");
  const char* field = apart ? "at_strict" : "counts";
  const auto counts = json.find(field);
  if (counts == json.end() || counts->is_null()) return;
  if (!counts->is_object()) return row.fail(field, "an object of message counts");
  Row fields{*counts};
  constexpr const char* expected = "a number of messages, at least 0";
  for (const auto& [measure, short_name] : class_names) {
    auto& value = run.values[static_cast<std::size_t>(measure)];
    value = fields.number(short_name, 0, Row::max_messages, expected);
    if (!value) value = fields.number(name_of(measure), 0, Row::max_messages, expected);
  }
  if (!fields.error().empty()) return row.fail(field, "in it: " + fields.error());
  auto& total = run.values[static_cast<std::size_t>(Measure::messages)];
  if (total) return;
  double sum = 0;
  for (const auto& [measure, short_name] : class_names) {
    if (measure == Measure::messages) continue;
    const auto& value = run.values[static_cast<std::size_t>(measure)];
    if (!value) return;
    sum += *value;
  }
  total = sum;
}

/// The completion time of a run that completed, the time limit of one that did not.
void read_completion(const Json& json, Row& row, const ReadOptions& options, Observation& run) {
  const char* field = options.completion == CompletionTime::strict ? "T_strict_ms"
                      : row.has("completion_ms")                   ? "completion_ms"
                                                                   : "T_app_ms";
  const auto time = row.number(field, 0, Row::max_ms, "a time in ms from 0 to 3600000");
  run.completed = time.has_value();
  if (row.has("completed")) {
    if (!json["completed"].is_boolean()) return row.fail("completed", "true or false");
    run.completed = json["completed"].get<bool>();
    if (run.completed && !time) row.fail(field, "the completion time in ms, as completed is true");
  } else if (!time) {
    row.fail(field, "the completion time in ms, or completed: false beside it");
  }
  const auto limit = row.number("limit_s", 0, Row::max_ms / 1000, "a time in s from 0 to 3600");
  run.values[static_cast<std::size_t>(Measure::completion)] =
      run.completed ? time : limit.value_or(0) * 1000;
}

/// A process that comes in the place of one that is gone says when it came; the one before it took
/// as long to announce itself and to have its endpoints, from the common start on.
void put_in_place(Times& times, Departure& gone) {
  if (times.start < gone.at) return;
  gone.back = times.start;
  times.start -= gone.planned_return;
  times.endpoints_done -= gone.planned_return;
}

/// When each of its processes announced itself and had its endpoints. When the first and the last
/// one did the former is taken from here only if the row does not say it.
void read_processes(const Json& json, Row& row, Observation& run) {
  if (!row.has("procs")) return;
  if (!json["procs"].is_array()) return row.fail("procs", "a list of objects, one of each process");
  std::optional<Range> starts;
  std::map<std::uint64_t, Times> known;           // by participant
  std::map<std::uint64_t, std::uint64_t> seen{};  // by host: processes
  for (const Json& process : json["procs"]) {
    if (!process.is_object()) return row.fail("procs", "a list of objects, one of each process");
    Row fields{process};
    const auto enabled = fields.number("enabled", 0, Row::max_ms, "a time in ms from 0 to 3600000");
    const auto done = fields.number("endpoints_done", enabled.value_or(0), Row::max_ms,
                                    "a time in ms, up to 3600000 and not before enabled");
    if (enabled && done && fields.has("host")) {
      const std::uint64_t host = fields.count("host", 0, run.hosts - 1);
      const std::uint64_t next = seen[host]++;
      const std::uint64_t id =
          fields.has("id") ? fields.count("id", 0, run.participants_per_host - 1) : next;
      if (id >= run.participants_per_host) continue;  // more than there should be
      Times& times = known[host * run.participants_per_host + id];
      times = {*enabled, *done};
      auto& gone = run.change.departure;
      if (gone && gone->host == host && gone->id == id) put_in_place(times, *gone);
    }
    if (!fields.error().empty()) return row.fail("procs", "in it: " + fields.error());
    if (!enabled || (run.change.departure && *enabled >= run.change.departure->at)) continue;
    const Range all = starts.value_or(Range{*enabled, *enabled});
    starts = Range{std::min(all.low, *enabled), std::max(all.high, *enabled)};
  }
  if (!run.start) run.start = starts;
  if (known.size() != std::uint64_t{run.hosts} * run.participants_per_host) return;
  for (const auto& [participant, times] : known) run.participants.push_back(times);
}

void read_spread(Row& row, Spread& spread) {
  spread.step_ms =
      row.number("step_ms", 0, Row::max_ms, "a time in ms from 0 to 3600000").value_or(0);
  const std::string by = row.text("step_by").value_or("process");
  if (by != "process" && by != "host") row.fail("step_by", "process or host");
  spread.by_host = spread.step_ms > 0 && by == "host";
}

void read_channel(Row& row, Channel& channel) {
  constexpr const char* overhead = "a time in us from 0 to 1000000";
  constexpr const char* rate = "a rate in Mbit/s from 0.001 to 1000000";
  channel.medium = row.text("medium");
  channel.overhead_unicast_us = row.number("O_u_us", 0, 1e6, overhead);
  channel.overhead_multicast_us = row.number("O_m_us", 0, 1e6, overhead);
  channel.rate_unicast_mbps = row.number("R_u_Mbps", 1e-3, 1e6, rate);
  channel.rate_multicast_mbps = row.number("R_m_Mbps", 1e-3, 1e6, rate);
  channel.loss = row.number("loss", 0, 1, "a probability from 0 to 1");
  channel.send_buffer_bytes = row.number("sndbuf_B", 0, 1e12, "a size in bytes, 0 for the default");
}

/// What endpoints say of their types: nothing, types that all participants have, or also some that
/// each has alone, as many as a node has requests and replies of services.
void read_types(Row& row, Observation& run) {
  constexpr std::uint32_t services = 12;
  const std::uint32_t information =
      row.has("type_information") ? row.count("type_information", 0, 2) : 0;
  if (information > 0) run.unknown_types = information == 2 ? services : 0;
  run.looks_up_types = row.text("type_propagation").value_or("enabled") == "enabled";
}

/// What each process runs, by "HOST/ID".
void read_profiles(const Json& json, Row& row, Observation& run) {
  if (!row.has("profiles")) return;
  constexpr const char* expected =
      "an object with what each process runs, by its host and id: {\"0/0\": \"fastdds-3.6\", …}";
  const Json& profiles = json["profiles"];
  if (!profiles.is_object()) return row.fail("profiles", expected);
  for (std::uint32_t host = 0; host < run.hosts; ++host) {
    for (std::uint32_t id = 0; id < run.participants_per_host; ++id) {
      const auto word = profiles.find(fmt::format("{}/{}", host, id));
      if (word == profiles.end() || !word->is_string()) return row.fail("profiles", expected);
      run.profiles.push_back(word->get<std::string>());
    }
  }
}

bool selected(const Json& json, const std::vector<std::string>& select) {
  for (const std::string& wanted : select) {
    const std::size_t equals = wanted.find('=');
    const auto found = json.find(wanted.substr(0, equals));
    if (found == json.end()) return false;
    const std::string value = found->is_string() ? found->get<std::string>() : found->dump();
    if (value != wanted.substr(equals + 1)) return false;
  }
  return true;
}

Observation read_row(const Json& json, Row& row, const ReadOptions& options) {
  Observation run;
  run.set = row.text("set").value_or("");
  run.hosts = row.count("N_H", 2, model::Deployment::max_participants);
  run.participants_per_host = row.count("N_P", 1, model::Deployment::max_participants);
  run.endpoints = row.count("N_E", 0, model::Deployment::max_endpoints);
  read_channel(row, run.channel);
  if (row.has("peer_range")) run.peer_range = row.count("peer_range", 1, 1'000);
  read_types(row, run);
  read_counts(json, row, options, run);
  read_completion(json, row, options, run);
  run.start = row.range("start_ms");
  run.create = row.range("create_ms");
  run.endpoints_done = row.range("ep_done_ms");
  read_spread(row, run.spread);
  read_change(row, run);
  read_processes(json, row, run);
  read_profiles(json, row, run);
  if (run.change.departure) run.create = run.endpoints_done = std::nullopt;  // of the new one, too
  return run;
}

}  // namespace

model::config::Result<Observations> read_observations(std::istream& input, const std::string& name,
                                                      const ReadOptions& options) {
  using model::config::InputError;
  for (const std::string& wanted : options.select) {
    if (wanted.find('=') == std::string::npos || wanted.front() == '=') {
      return InputError{"--select " + wanted, "expected KEY=VALUE, a field of the rows"};
    }
  }
  Observations result;
  std::string line;
  for (std::size_t number = 1; std::getline(input, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string where = fmt::format("{}:{}", name, number);
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_object()) {
      return InputError{where, "not a JSON object; expected one measured run per line"};
    }
    if (!selected(json, options.select)) {
      ++result.not_selected;
      continue;
    }
    Row row{json};
    result.rows.push_back(read_row(json, row, options));
    if (!row.error().empty()) return InputError{where, row.error()};
  }
  if (input.bad()) return InputError{name, "cannot be read"};
  if (result.rows.empty()) {
    return InputError{name, result.not_selected == 0
                                ? "has no rows; expected one measured run per line"
                                : fmt::format("none of its {} rows is selected by --select",
                                              result.not_selected)};
  }
  return result;
}

}  // namespace stormproof::prediction
