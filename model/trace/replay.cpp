// Reads the header, runs the scenario, and lets the comparison decide when that is enough.
#include "model/trace/replay.hpp"

#include <filesystem>
#include <utility>

#include "model/config/scenario_file.hpp"
#include "model/trace/trace_comparison.hpp"
#include "model/trace/trace_writer.hpp"

namespace stormproof::model::trace {

namespace {

using config::InputError;
using config::Result;

constexpr const char* expected_header =
    R"(expected a trace, which starts with {"format":"stormproof-trace","version":1,...})";

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

}  // namespace

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
  }
  return "";
}

Result<Replay> replay(const std::string& file, const config::SpecPath& specs,
                      const std::function<bool(const Progress&)>& on_progress) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    return InputError{file, "is a folder; expected a file"};
  }
  LineReader reader{file};
  const auto header = read_header(reader, file);
  if (!header) return header.error();
  const auto scenario = read_scenario(*header, reader.text(), file, specs);
  if (!scenario) return scenario.error();

  TraceComparison comparison{reader, file, *header};
  TraceWriter writer{[&](std::string_view line) { comparison.take(line); }, *scenario};
  RunOptions options;
  options.probe = &writer;
  options.on_progress = [&](const Progress& state) {
    return !comparison.decided() && (!on_progress || on_progress(state));
  };
  const RunResult result = simulate(*scenario, options);
  if (result.end == RunEnd::interrupted)
    comparison.stop();
  else
    writer.finish(result);
  return comparison.result(result);
}

}  // namespace stormproof::model::trace
