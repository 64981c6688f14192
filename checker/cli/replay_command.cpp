// Replays the trace and prints the verdict.
#include "checker/cli/replay_command.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/exit_code.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/json/dumped.hpp"
#include "checker/verification/counterexample/observe.hpp"
#include "checker/verification/counterexample/replay_report.hpp"
#include "model/trace/replay.hpp"

namespace stormproof::cli {

namespace {

using model::trace::Replay;
using model::trace::Verdict;

int exit_code(const Replay& replay) {
  switch (replay.verdict) {
    case Verdict::identical:
      return established;
    case Verdict::different:
      // A counterexample that does not happen again says nothing about its property.
      return replay.expected ? inconclusive : violated;
    case Verdict::violated:
      return violated;
    case Verdict::not_violated:
    case Verdict::ends_early:
    case Verdict::stopped:
      return inconclusive;
  }
  return internal_error;
}

}  // namespace

int replay(const ReplayArguments& arguments) {
  const InterruptGuard guard;
  const auto result = [&] {
    ProgressLine progress{isatty(STDERR_FILENO) != 0};
    return model::trace::replay(
        arguments.file, model::config::SpecPath::standard(),
        [&](const model::Progress& state) {
          progress.update(state);
          return !InterruptGuard::interrupted();
        },
        counterexample::catalogue_watches());
  }();
  if (!result) {
    fmt::print(stderr, "stormproof: {}\n", to_string(result.error()));
    return bad_input;
  }
  fmt::print("{}", arguments.json ? report::dumped(counterexample::to_json(arguments.file, *result))
                                  : to_text(counterexample::document_of(arguments.file, *result)));
  return exit_code(*result);
}

}  // namespace stormproof::cli
