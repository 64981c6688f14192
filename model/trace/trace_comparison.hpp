// The comparison of a recorded trace with the lines of its replay, as they come: one recorded line
// is in memory at any time. Most lines are the same bytes; only lines that are not get parsed.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "model/trace/line_reader.hpp"
#include "model/trace/replay.hpp"

namespace stormproof::model::trace {

class TraceComparison {
 public:
  /// `reader` has just read the header of the trace `file`, which is a counterexample if something
  /// is `expected`.
  TraceComparison(LineReader& reader, std::string file, Json header,
                  std::optional<TraceViolation> expected = {});

  /// Takes the next line of the replay, the header first.
  void take(std::string_view line);
  /// The replay ends before the trace does, because the caller wants it.
  void stop();

  /// Whether the lines taken so far decide; more of them change nothing.
  [[nodiscard]] bool decided() const { return decided_; }
  /// Whether every event of a counterexample has happened again; `conclude` decides.
  [[nodiscard]] bool awaits_violation() const {
    return !decided_ && replay_.expected && replay_.events > replay_.expected->event;
  }
  /// The replay of a counterexample is over, and this is what its monitor objected to.
  void conclude(std::optional<TraceViolation> violation);

  [[nodiscard]] config::Result<Replay> result(const RunResult& run) const;

 private:
  void take_header(std::string_view line);
  /// A line of the replay meets a recorded line of other bytes.
  void take_other(std::string_view line, bool terminated);
  void agree(std::string_view line);
  void expect_end_of_file();
  void differ(Mismatch mismatch, std::string_view replayed);
  void decide(Verdict verdict);
  void fail(std::string message);

  LineReader& reader_;
  std::string file_;
  Json header_;
  Replay replay_;
  std::optional<config::InputError> error_;
  bool decided_ = false;
};

}  // namespace stormproof::model::trace
