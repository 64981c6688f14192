// `stormproof survive SCENARIO`: which outages, deaths and restarts the fleet survives, how soon,
// and what cures what it does not survive.
#include <algorithm>

#include "checker/cli/commands.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/experiments/survive/survive_report.hpp"

namespace stormproof::cli {

namespace {

struct SurviveArguments {
  survive::Request request;
  std::string limit;  ///< a duration; empty: 60 s
  std::vector<std::string> lengths;
  OutputFile svg;
};

constexpr model::Nanoseconds longest{1'000'000'000'000};

std::optional<Complaint> complete(SurviveArguments& arguments) {
  survive::Request& request = arguments.request;
  if (!arguments.limit.empty()) {
    const auto limit = parse_positive_duration("--limit", arguments.limit, longest);
    if (!limit) return Complaint{limit.error()};
    request.limit = *limit;
  }
  for (const std::string& text : arguments.lengths) {
    const auto length = parse_positive_duration("--length", text, longest);
    if (!length) return Complaint{length.error()};
    request.lengths.push_back(*length);
  }
  std::ranges::sort(request.lengths);
  return std::nullopt;
}

Outcome run(SurviveArguments& arguments, Session& session) {
  survive::Request& request = arguments.request;
  if (auto complaint = complete(arguments)) return *std::move(complaint);
  request.on_progress = session.on_study();
  request.time = Session::time();
  const auto report = survive::survive(request, model::config::SpecPath::standard());
  if (!report) return report.error();
  Answer answer{document_of(*report, request), to_json(*report, request)};
  Session::note_interruption(answer.document);
  if (arguments.svg.wanted()) arguments.svg.stream() << to_svg(*report);
  return answer;
}

void declare(Options& options, SurviveArguments& arguments) {
  survive::Request& request = arguments.request;
  options.scenario(request.scenario, request.overrides);
  options.texts("--versions", request.versions,
                "Also the fleet with this DDS profile or distribution (repeatable)", "PROFILE");
  options.texts("--length", arguments.lengths,
                "How long somebody is away (repeatable; default: 0.2s to 120s)", "TIME");
  options.text("--limit", arguments.limit,
               "What takes longer after a failure and a lease is not survived (default 60s)",
               "TIME");
  options.number("--samples", request.samples, "Runs of each failure (default 5)", "N")
      .within(1, 100'000);
  options.seed(request.seed, "Seed of the first run (default 0)");
  options.svg(arguments.svg, "Plot recovery over how long somebody is away");
  options.jobs(request.threads);
}

}  // namespace

void declare_survive(Frame& frame) {
  frame.add<SurviveArguments>(
      {"survive",
       "Which outages, deaths and restarts this fleet survives, how soon, and what cures the rest",
       "Exit code: 0 all are survived, 1 some are not, 3 interrupted or never discovered,\n"
       "2 bad input.",
       Formats::pages,
       {survive::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
