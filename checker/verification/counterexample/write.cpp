// The trace writer's lines up to the violating event, between a header that announces the violation
// and a last line that states it.
#include "checker/verification/counterexample/write.hpp"

#include <ostream>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "checker/verification/counterexample/observe.hpp"
#include "model/trace/trace_writer.hpp"

namespace stormproof::counterexample {

namespace {

using model::trace::Json;
using model::trace::TraceViolation;

/// `"key":{…}` of a violation.
std::string member(const char* key, const TraceViolation& violation) {
  return fmt::format("\"{}\":{}", key,
                     to_json(violation).dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// What speaks against the counterexample, given what its monitor found.
std::optional<std::string> objection(const props::Counterexample& counterexample,
                                     const std::optional<props::Violation>& found) {
  if (!found) {
    return fmt::format("{}: the run of the counterexample does not violate it",
                       counterexample.property);
  }
  if (found->event != counterexample.event) {
    return fmt::format("{}: the run violates it at event {}, not at event {}",
                       counterexample.property, found->event, counterexample.event);
  }
  return std::nullopt;
}

/// Why nobody can say.
std::string unobservable(const props::Counterexample& counterexample) {
  return fmt::format("{}: no monitor can observe it in a run", counterexample.property);
}

}  // namespace

std::optional<std::string> refuted(const props::Counterexample& counterexample) {
  const auto monitor = props::make_monitor(counterexample.property, counterexample.scenario);
  if (!monitor) return unobservable(counterexample);
  return objection(counterexample, observe(counterexample.scenario, *monitor));
}

std::optional<std::string> write_counterexample(const props::Counterexample& counterexample,
                                                props::Monitor& monitor, std::ostream& out) {
  const std::uint64_t wanted_lines = counterexample.event + 2;
  std::uint64_t lines = 0;
  std::string header;
  std::string events;
  model::trace::TraceWriter writer{[&](std::string_view line) {
                                     if (lines >= wanted_lines) return;
                                     (lines == 0 ? header : events) += line;
                                     ++lines;
                                   },
                                   counterexample.scenario};
  const auto found = observe(counterexample.scenario, monitor, &writer);
  if (auto wrong = objection(counterexample, found)) return wrong;
  const TraceViolation violation{std::string{monitor.property()}, found->event, found->time,
                                 found->reason};
  header.resize(header.size() - 2);  // the brace and the line feed
  out << header << "," << member("expect", violation) << "}\n"
      << events << "{" << member("violation", violation) << "}\n";
  return std::nullopt;
}

std::optional<std::string> write_counterexample(const props::Counterexample& counterexample,
                                                std::ostream& out) {
  const auto monitor = props::make_monitor(counterexample.property, counterexample.scenario);
  if (!monitor) return unobservable(counterexample);
  return write_counterexample(counterexample, *monitor, out);
}

}  // namespace stormproof::counterexample
