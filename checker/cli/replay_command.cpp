// `stormproof replay TRACE`: runs the scenario of a trace again and compares every event. Of a
// counterexample it also says whether the violation occurs.
#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/verification/counterexample/observe.hpp"
#include "checker/verification/counterexample/replay_report.hpp"
#include "model/trace/replay.hpp"

namespace stormproof::cli {

namespace {

struct ReplayArguments {
  std::string file;  ///< written by `stormproof simulate --trace` or `stormproof check`
};

ExitCode exit_code(const model::trace::Replay& replay) {
  using model::trace::Verdict;
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

Outcome run(ReplayArguments& arguments, Session& session) {
  const auto result =
      model::trace::replay(arguments.file, model::config::SpecPath::standard(),
                           session.on_simulation(), counterexample::catalogue_watches());
  if (!result) return result.error();
  Answer answer{counterexample::document_of(arguments.file, *result),
                counterexample::to_json(arguments.file, *result)};
  answer.document.exit_code = exit_code(*result);
  return answer;
}

void declare(Options& options, ReplayArguments& arguments) {
  options.text("trace", arguments.file, "File written by simulate --trace or by check", "FILE")
      .required();
}

}  // namespace

void declare_replay(Frame& frame) {
  frame.add<ReplayArguments>(
      {"replay",
       "Run the scenario of a trace or counterexample again and compare every event",
       "Exit code of a trace: 0 identical, 1 different, 3 the trace ends early.\n"
       "Of a counterexample: 1 the violation occurs, 3 it does not. 2 bad input.",
       Formats::pages,
       {counterexample::replay_schema}},
      declare, run);
}

}  // namespace stormproof::cli
