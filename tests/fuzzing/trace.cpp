// Fuzz target: traces and counterexamples (model/trace/replay.hpp). A replay runs the scenario of
// the header, so inputs whose scenario is not small are left to the scenario target.
#include <nlohmann/json.hpp>

#include "checker/verification/counterexample/observe.hpp"
#include "model/config/scenario_file.hpp"
#include "model/trace/replay.hpp"
#include "model/trace/trace_json.hpp"
#include "tests/fuzzing/checks.hpp"
#include "tests/fuzzing/memory_file.hpp"
#include "tests/fuzzing/targets.hpp"

namespace stormproof::fuzzing {

namespace {

/// Whether the first line has a scenario that takes long to run.
bool asks_for_much(std::string_view input) {
  const auto header = model::trace::parse_line(input.substr(0, input.find('\n')));
  if (!header || !header->is_object() || !header->contains("scenario")) return false;
  const std::string text =
      (*header)["scenario"].dump(-1, ' ', false, model::trace::Json::error_handler_t::replace);
  const auto scenario = model::config::parse_scenario(text, "input", {}, specs());
  return scenario && !is_small(*scenario);
}

}  // namespace

Outcome trace(std::string_view input) {
  if (names_a_device(input) || asks_for_much(input)) return Outcome::refused;
  const MemoryFile file{input};
  const auto replay =
      model::trace::replay(file.path(), specs(), {}, counterexample::catalogue_watches());
  if (!replay) {
    require(replay.error().where.starts_with(file.path()), "an error has a place");
    require(!replay.error().message.empty(), "an error says what is wrong");
    return Outcome::refused;
  }
  require(replay->lines <= input.size(), "no more lines agree than the trace has");
  require((replay->verdict == model::trace::Verdict::different) == replay->difference.has_value(),
          "a different trace comes with its difference");
  require(replay->verdict != model::trace::Verdict::stopped, "nobody stopped this replay");
  return Outcome::accepted;
}

}  // namespace stormproof::fuzzing
