// Decides what a recorded trace and its replay have in common.
#include "model/trace/trace_comparison.hpp"

#include <charconv>
#include <utility>

namespace stormproof::model::trace {

namespace {

constexpr std::string_view end_line_start = R"({"end":)";

std::string cut(std::string_view line) {
  constexpr std::size_t longest = 1'000;
  if (line.size() <= longest) return std::string{line};
  return std::string{line.substr(0, longest)} + " ...";
}

/// The time of an event line, which stands near its start.
Nanoseconds time_of(std::string_view line) {
  constexpr std::string_view key = R"("t":)";
  const std::size_t found = line.find(key);
  std::int64_t time = 0;
  if (found != std::string_view::npos) {
    std::from_chars(line.data() + found + key.size(), line.data() + line.size(), time);
  }
  return Nanoseconds{time};
}

}  // namespace

TraceComparison::TraceComparison(LineReader& reader, std::string file, Json header,
                                 std::optional<TraceViolation> expected)
    : reader_{reader},
      file_{std::move(file)},
      header_(std::move(header)) {  // braces would make an array of it
  replay_.expected = std::move(expected);
  const Json program = header_.value("program", Json{});
  if (program.is_string()) replay_.recorded_by = program.get<std::string>();
}

void TraceComparison::take(std::string_view line) {
  if (decided_ || awaits_violation()) return;
  line.remove_suffix(1);  // the line feed
  if (replay_.lines == 0) {
    take_header(line);
    return;
  }
  const LineReader::Status status = reader_.next();
  switch (status) {
    case LineReader::Status::line:
    case LineReader::Status::unterminated:
      if (reader_.text() == line)
        agree(line);
      else
        take_other(line, status == LineReader::Status::line);
      break;
    case LineReader::Status::end:
      decide(Verdict::ends_early);
      break;
    case LineReader::Status::too_long:
      fail("the line is longer than " + std::to_string(LineReader::max_line_bytes) +
           " bytes; expected the line of one event");
      break;
    case LineReader::Status::unreadable:
      fail("the file cannot be read further");
      break;
  }
}

void TraceComparison::take_header(std::string_view line) {
  Json replayed = parse_line(line).value_or(Json{});
  // Another version of the program may write the same trace. `expect` is not part of the
  // comparison.
  for (const char* key : {"program", "expect"}) {
    header_.erase(key);
    replayed.erase(key);
  }
  if (auto mismatch = first_difference(header_, replayed)) {
    differ(std::move(*mismatch), line);
    return;
  }
  replay_.lines = 1;
}

void TraceComparison::take_other(std::string_view line, bool terminated) {
  const auto recorded = parse_line(reader_.text());
  if (!recorded || !recorded->is_object()) {
    fail(terminated ? "not a JSON object; expected the line of one event"
                    : "the line is cut off; expected a complete line. All lines before it agree");
    return;
  }
  const Json replayed = parse_line(line).value_or(Json{});
  auto mismatch = first_difference(*recorded, replayed);
  if (!mismatch) {
    agree(line);
  } else if (recorded->value("end", Json{}) == "interrupted" &&
             recorded->value("events", Json{}) == replay_.events) {
    ++replay_.lines;
    expect_end_of_file();
    decide(Verdict::ends_early);
  } else {
    differ(std::move(*mismatch), line);
  }
}

void TraceComparison::agree(std::string_view line) {
  ++replay_.lines;
  if (line.starts_with(end_line_start)) {
    expect_end_of_file();
    decide(Verdict::identical);
    return;
  }
  ++replay_.events;
  replay_.last_time = time_of(line);
}

void TraceComparison::stop() { decide(Verdict::stopped); }

void TraceComparison::conclude(std::optional<TraceViolation> violation) {
  replay_.violation = std::move(violation);
  if (!awaits_violation()) return;
  const TraceViolation& expected = *replay_.expected;
  const auto& found = replay_.violation;
  if (!found || found->event != expected.event || found->time != expected.time) {
    decide(Verdict::not_violated);
    return;
  }
  if (reader_.next() == LineReader::Status::end) {
    decide(Verdict::ends_early);
    return;
  }
  const auto recorded = parse_line(reader_.text());
  if (!recorded || !recorded->is_object()) {
    fail("not a JSON object; expected the violation");
    return;
  }
  // The reason is for people; another version of the program may word it otherwise.
  Json replayed{{"violation", to_json(*found)}};
  const Json said = recorded->value("violation", Json{});
  if (said.is_object() && said.contains("reason") && said["reason"].is_string()) {
    replayed["violation"]["reason"] = said["reason"];
  }
  if (auto mismatch = first_difference(*recorded, replayed)) {
    differ(std::move(*mismatch), replayed.dump());
    return;
  }
  ++replay_.lines;
  expect_end_of_file();
  decide(Verdict::violated);
}

void TraceComparison::expect_end_of_file() {
  if (reader_.next() != LineReader::Status::end) {
    fail("a line after the last line of the trace; expected the end of the file");
  }
}

void TraceComparison::differ(Mismatch mismatch, std::string_view replayed) {
  replay_.difference =
      Difference{reader_.number(), std::move(mismatch), cut(reader_.text()), cut(replayed)};
  decide(Verdict::different);
}

void TraceComparison::decide(Verdict verdict) {
  if (decided_) return;
  decided_ = true;
  replay_.verdict = verdict;
}

void TraceComparison::fail(std::string message) {
  decided_ = true;
  error_ = config::InputError{file_ + ":" + std::to_string(reader_.number()), std::move(message)};
}

config::Result<Replay> TraceComparison::result(const RunResult& run) const {
  if (error_) return *error_;
  Replay replay = replay_;
  if (replay.verdict == Verdict::identical) replay.discovery_time = run.discovery_time;
  return replay;
}

}  // namespace stormproof::model::trace
