// `stormproof mutate`: is every mistake noticed, and by which property?
#include <algorithm>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/engines/explorer/scope.hpp"
#include "checker/verification/mutate/mutate.hpp"
#include "checker/verification/mutate/mutate_report.hpp"
#include "model/config/tree/suggestion.hpp"

namespace stormproof::cli {

namespace {

struct MutateArguments {
  std::vector<std::string> only;   ///< ids of mutants; empty: all
  std::vector<std::string> kinds;  ///< of mutants; empty: all
  bool everybody = false;          ///< asks all, not only until somebody notices
  std::uint32_t readers = 1;       ///< that the explorer looks at together
  double timeout_seconds = 120;    ///< of each query
};

std::optional<std::string> unknown_mutant(const std::vector<std::string>& ids) {
  std::vector<std::string> known;
  for (const mutate::CatalogueEntry& entry : mutate::mutants()) known.push_back(entry.mutant.id);
  for (const std::string& id : ids) {
    if (std::find(known.begin(), known.end(), id) != known.end()) continue;
    return fmt::format("--mutant {}: no such mutant{}; 'stormproof list mutants' has all {}", id,
                       model::config::suggestion(id, known), known.size());
  }
  return std::nullopt;
}

Outcome run(MutateArguments& arguments, Session& session) {
  if (const auto error = unknown_mutant(arguments.only)) return Complaint{*error};
  mutate::MutateOptions options;
  options.only = arguments.only;
  options.everybody = arguments.everybody;
  options.readers = arguments.readers;
  for (const std::string& kind : arguments.kinds) {
    const auto found = std::ranges::find(mutate::kind_names, kind);
    options.kinds.push_back(static_cast<mutate::Kind>(found - mutate::kind_names.begin()));
  }
  options.solver.timeout =
      std::chrono::milliseconds{static_cast<std::int64_t>(arguments.timeout_seconds * 1000)};
  options.solver.interrupted = Session::interrupted;
  options.on_progress = session.on_steps("trying ");
  const mutate::MutationReport report = mutate::mutate(options);
  Answer answer{document_of(report), to_json(report)};
  const ExitCode decided = report.notices_enough() ? established : violated;
  answer.document.exit_code = report.interrupted ? inconclusive : decided;
  return answer;
}

void declare(Options& options, MutateArguments& arguments) {
  options.texts("--mutant", arguments.only, "Try only this mutant (repeatable)", "ID");
  options.texts("--kind", arguments.kinds, "Try only mutants of this kind (repeatable)", "KIND")
      .one_of({mutate::kind_names.begin(), mutate::kind_names.end()});
  options.flag("--everybody", arguments.everybody,
               "Ask all properties and laws of each mutant, not only until one notices (but of\n"
               "mutants of kind effect)");
  options
      .number("--readers", arguments.readers,
              "Let the explorer look at several readers of one writer for effects that nobody "
              "notices: 2 or 3 (default 1)",
              "N")
      .within(1U, explorer::most_readers);
  options.timeout(arguments.timeout_seconds);
}

}  // namespace

void declare_mutate(Frame& frame) {
  frame.add<MutateArguments>(
      {"mutate",
       "Put mistakes into tables and rules, and see which property notices them",
       "Exit code: 0 at least 95 % of the mutants are noticed, and 60 % of those at effects\n"
       "of the paper's and of Fast DDS's rules if these themselves are wrong, 1 fewer,\n"
       "2 bad input, 3 interrupted.",
       Formats::findings,
       {mutate::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
