// Tries the mutants and prints who notices them.
#include "checker/cli/mutate_command.hpp"

#include <algorithm>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/exit_code.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/json/dumped.hpp"
#include "checker/verification/mutate/mutate.hpp"
#include "checker/verification/mutate/mutate_report.hpp"
#include "model/config/tree/suggestion.hpp"

namespace stormproof::cli {

namespace {

std::optional<std::string> unknown_mutant(const std::vector<std::string>& ids) {
  std::vector<std::string> known;
  for (const mutate::CatalogueEntry& entry : mutate::mutants()) known.push_back(entry.mutant.id);
  for (const std::string& id : ids) {
    if (std::find(known.begin(), known.end(), id) != known.end()) continue;
    return fmt::format("--mutant {}: no such mutant{}", id, model::config::suggestion(id, known));
  }
  return std::nullopt;
}

}  // namespace

int mutate(const MutateArguments& arguments) {
  if (const auto error = unknown_mutant(arguments.only)) {
    fmt::print(stderr, "stormproof: {}\n", *error);
    return bad_input;
  }
  mutate::MutateOptions options;
  options.only = arguments.only;
  options.solver.timeout =
      std::chrono::milliseconds{static_cast<std::int64_t>(arguments.timeout_seconds * 1000)};
  const mutate::MutationReport mutations = [&] {
    const InterruptGuard guard;
    StatusLine status{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
    options.on_progress = [&](std::string_view what) {
      if (status.due()) status.show(fmt::format("trying {}: {:.0f} s", what, status.seconds()));
      return !InterruptGuard::interrupted();
    };
    return mutate::mutate(options);
  }();
  fmt::print("{}",
             arguments.json ? report::dumped(to_json(mutations)) : to_text(document_of(mutations)));
  if (mutations.interrupted) return inconclusive;
  return mutations.notices_enough() ? established : violated;
}

}  // namespace stormproof::cli
