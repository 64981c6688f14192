// Reads the header, runs the scenario, and lets the comparison decide when that is enough.
#include "model/trace/replay.hpp"

#include <filesystem>
#include <utility>

#include "model/config/scenario_file.hpp"
#include "model/trace/probe_list.hpp"
#include "model/trace/trace_comparison.hpp"
#include "model/trace/trace_writer.hpp"

namespace stormproof::model::trace {

namespace {

using config::InputError;
using config::Result;

constexpr const char* expected_header =
    R"(expected a trace, which starts with {"format":"stormproof-trace","version":1,...})";

/// No line of an event is shorter.
constexpr std::uintmax_t shortest_line_bytes = 8;

/// More events than the file has lines, so that replaying a short file is short, whatever its
/// header asks for; 0, no such limit, if the file has no size (a pipe).
std::uint64_t events_beyond(const std::string& file) {
  std::error_code failed;
  const std::uintmax_t bytes = std::filesystem::file_size(file, failed);
  return failed ? 0 : bytes / shortest_line_bytes + 1;
}

/// Reads the first line and what must be in it.
Result<Json> read_header(LineReader& reader, const std::string& file) {
  switch (reader.next()) {
    case LineReader::Status::unreadable:
      return InputError{file, "cannot be read"};
    case LineReader::Status::end:
      return InputError{file, std::string{"the file is empty; "} + expected_header};
    case LineReader::Status::too_long:
      return InputError{file + ":1", std::string{"the line is too long; "} + expected_header};
    case LineReader::Status::line:
    case LineReader::Status::unterminated:
      break;
  }
  const auto header = parse_line(reader.text());
  if (!header || !header->is_object() || header->value("format", Json{}) != "stormproof-trace") {
    return InputError{file + ":1", std::string{"not a trace; "} + expected_header};
  }
  const Json version = header->value("version", Json{});
  if (version != trace_version) {
    return InputError{file + ":1", "version " + version.dump() +
                                       " of the trace format; expected version " +
                                       std::to_string(trace_version)};
  }
  if (!header->contains("scenario") || !(*header)["scenario"].is_object()) {
    return InputError{file + ":1", "the header has no scenario; " + std::string{expected_header}};
  }
  return *header;
}

/// The scenario of the header. Spaces in front of it give errors the column that they have in the
/// file.
Result<Scenario> read_scenario(const Json& header, const std::string& line, const std::string& file,
                               const config::SpecPath& specs) {
  const std::string text = header["scenario"].dump();
  const std::size_t found = line.find(text);
  const std::string indent(found == std::string::npos ? 0 : found, ' ');
  return config::parse_scenario(indent + text, file, {}, specs);
}

/// The violation that a counterexample announces in its header; nothing in any other trace.
Result<std::optional<TraceViolation>> read_expected(const Json& header, const std::string& file) {
  if (!header.contains("expect")) return std::optional<TraceViolation>{};
  const Json& expect = header["expect"];
  const auto wrong = [&](const std::string& key, const Json& value, const char* type) {
    return InputError{file + ":1", "'" + key + "' is " + value.dump() + "; expected " + type};
  };
  if (!expect.is_object()) return wrong("expect", expect, "an object with the violation");
  const auto at = [&](const char* key) { return expect.value(key, Json{}); };
  for (const char* key : {"property", "reason"}) {
    if (!at(key).is_string()) return wrong(std::string{"expect."} + key, at(key), "a text");
  }
  for (const char* key : {"event", "t"}) {
    const Json value = at(key);
    const bool natural = value.is_number_unsigned() && value.get<std::uint64_t>() <= INT64_MAX;
    if (!natural) return wrong(std::string{"expect."} + key, value, "a natural number");
  }
  return std::optional{
      TraceViolation{at("property").get<std::string>(), at("event").get<std::uint64_t>(),
                     Nanoseconds{at("t").get<std::int64_t>()}, at("reason").get<std::string>()}};
}

Result<Replay> run_again(const Scenario& scenario, Effects effects, TraceComparison& comparison,
                         std::uint64_t max_events, ViolationWatch* watch,
                         const std::function<bool(const Progress&)>& on_progress) {
  TraceWriter writer{[&](std::string_view line) { comparison.take(line); }, scenario, effects};
  ProbeList probes;
  probes.add(writer);
  if (watch != nullptr) probes.add(watch->probe());
  const auto enough = [&] {
    return comparison.decided() || (comparison.awaits_violation() && watch->violation());
  };
  RunOptions options;
  options.probe = &probes;
  options.max_events = max_events;
  options.on_progress = [&](const Progress& state) {
    return !enough() && (!on_progress || on_progress(state));
  };
  const RunResult result = simulate(scenario, options);
  const bool stopped = result.end == RunEnd::interrupted;
  if (!stopped) writer.finish(result);
  if (watch != nullptr && (!stopped || enough())) {
    if (!stopped) watch->finish(known_until(result, scenario));
    comparison.conclude(watch->violation());
  }
  if (stopped) comparison.stop();  // changes nothing that is decided
  return comparison.result(result);
}

}  // namespace

Json to_json(const TraceViolation& violation) {
  return {{"property", violation.property},
          {"event", violation.event},
          {"t", violation.time.count()},
          {"reason", violation.reason}};
}

Nanoseconds known_until(const RunResult& result, const Scenario& scenario) {
  const bool cut = result.end == RunEnd::completed || result.end == RunEnd::interrupted;
  return cut ? result.end_time : scenario.time_limit;
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::identical:
      return "identical";
    case Verdict::different:
      return "different";
    case Verdict::ends_early:
      return "ends_early";
    case Verdict::stopped:
      return "stopped";
    case Verdict::violated:
      return "violated";
    case Verdict::not_violated:
      return "not_violated";
  }
  return "";
}

Result<Replay> replay(const std::string& file, const config::SpecPath& specs,
                      const std::function<bool(const Progress&)>& on_progress,
                      const WatchMaker& watch_for) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    return InputError{file, "is a directory; expected a file"};
  }
  LineReader reader{file};
  const auto header = read_header(reader, file);
  if (!header) return header.error();
  const auto scenario = read_scenario(*header, reader.text(), file, specs);
  if (!scenario) return scenario.error();
  const auto expected = read_expected(*header, file);
  if (!expected) return expected.error();
  std::unique_ptr<ViolationWatch> watch;
  if (*expected) {
    const std::string& property = (*expected)->property;
    if (watch_for) watch = watch_for(property, *scenario);
    if (!watch) {
      return InputError{file + ":1", "'expect.property' is '" + property +
                                         "'; expected a property that a replay can observe"};
    }
  }
  const Effects effects =
      header->value("effects", Json{}) == true ? Effects::named : Effects::left_out;
  TraceComparison comparison{reader, file, *header, *expected};
  return run_again(*scenario, effects, comparison, events_beyond(file), watch.get(), on_progress);
}

}  // namespace stormproof::model::trace
