// The JSON of a replay.
#include "checker/presentation/json/schema.hpp"
#include "checker/verification/counterexample/replay_report.hpp"

namespace stormproof::model::trace {

template <class V>
void describe(V& v, const TraceViolation& violation) {
  v("property", violation.property);
  v("event", violation.event);
  v("time_ns", violation.time);
  v("reason", violation.reason);
}

template <class V>
void describe(V& v, const Difference& difference) {
  v("line", difference.line);
  v("key", difference.mismatch.key);
  v("recorded", difference.mismatch.recorded);
  v("replayed", difference.mismatch.replayed);
  v("recorded_line", difference.recorded_line);
  v("replayed_line", difference.replayed_line);
}

}  // namespace stormproof::model::trace

namespace stormproof::counterexample {

namespace {

struct ReplayOfFile {
  const std::string& file;
  const model::trace::Replay& replay;
};

template <class V>
void describe(V& v, const ReplayOfFile& shown) {
  const model::trace::Replay& replay = shown.replay;
  v("verdict", replay.verdict);
  v("trace", shown.file);
  v("recorded_by", replay.recorded_by);
  v("lines_that_agree", replay.lines);
  v("events_that_agree", replay.events);
  v("end_ns", replay.last_time);
  v("t_disc_ns", replay.discovery_time);
  v("expected", replay.expected);
  v("violation", replay.violation);
  v("difference", replay.difference);
}

}  // namespace

nlohmann::ordered_json to_json(const std::string& file, const model::trace::Replay& replay) {
  return report::json_of(ReplayOfFile{file, replay});
}

nlohmann::ordered_json replay_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<ReplayOfFile>(definitions);
}

}  // namespace stormproof::counterexample
