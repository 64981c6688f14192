// `stormproof compare-discovery SCENARIO`: the ways to discover side by side, as the deployment
// grows, and the files to deploy each of them.
#include <charconv>
#include <set>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_folder.hpp"
#include "checker/experiments/compare/compare_report.hpp"
#include "checker/experiments/compare/deployment_files.hpp"
#include "model/config/scenario_file.hpp"
#include "props/applicability.hpp"

namespace stormproof::cli {

namespace {

struct CompareArguments {
  compare::Request request;
  std::string sizes;         ///< "2,5,10"
  std::string limit;         ///< a duration
  std::string start_jitter;  ///< empty: that of the scenario's `vary`
  std::string folder;        ///< of the files to deploy; empty: none
};

constexpr std::uint32_t largest_size = 4'000;
constexpr model::Nanoseconds longest_run{1'000'000'000'000};

/// "2,5,10".
model::config::Result<std::vector<std::uint32_t>, std::string> parse_sizes(
    const std::string& text) {
  std::vector<std::uint32_t> sizes;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    std::uint32_t size = 0;
    const auto parsed = std::from_chars(at, end, size);
    const bool goes_on = parsed.ptr != end && *parsed.ptr == ',' && parsed.ptr + 1 != end;
    if (parsed.ec != std::errc{} || size < 1 || size > largest_size ||
        (parsed.ptr != end && !goes_on)) {
      return fmt::format("--sizes {}: expected whole numbers from 1 to {}, such as 2,5,10", text,
                         largest_size);
    }
    sizes.push_back(size);
    at = parsed.ptr + (goes_on ? 1 : 0);
  }
  return sizes;
}

/// What is wrong with the options, or nothing; the request is complete then.
std::optional<Complaint> complete(CompareArguments& arguments,
                                  const model::config::SpecPath& specs) {
  compare::Request& request = arguments.request;
  const auto scenario = model::config::read_scenario(request.scenario, request.overrides, specs);
  if (!scenario) return scenario.error();
  if (const auto why = props::why_profile_is_not_changed(*scenario); !why.empty()) {
    return model::config::InputError{request.scenario, std::string{why}};
  }
  const auto jitter = parse_start_jitter(arguments.start_jitter, *scenario);
  if (!jitter) return Complaint{jitter.error()};
  request.start_jitter = *jitter;
  const auto sizes = parse_sizes(arguments.sizes);
  if (!sizes) return Complaint{sizes.error()};
  request.sizes = *sizes;
  const std::set<std::uint32_t> distinct{sizes->begin(), sizes->end()};
  if (distinct.size() < sizes->size()) {
    return Complaint{
        fmt::format("--sizes {}: a size stands twice; expected each once", arguments.sizes)};
  }
  if (request.grows == compare::Grows::robots && distinct.contains(1)) {
    return Complaint{fmt::format(
        "--sizes {}: a single robot has nobody to discover; expected 2 or more", arguments.sizes)};
  }
  if (arguments.limit.empty()) return std::nullopt;
  const auto limit = parse_duration("--limit", arguments.limit, longest_run);
  if (!limit) return Complaint{limit.error()};
  if (limit->count() == 0) return Complaint{"--limit 0s: expected more than that"};
  request.limit = *limit;
  return std::nullopt;
}

/// Writes the files of every candidate, and notes their names in its row.
std::optional<Complaint> write_files(OutputFolder& folder, compare::Report& report,
                                     const model::config::SpecPath& specs) {
  for (compare::Row& row : report.rows) {
    const compare::Instance instance =
        compare::instance_of(report.candidates, row.candidate, report.grows, report.own_size);
    const auto files = compare::deployment_files(row.candidate, instance.scenario.dds, specs);
    if (!files) return Complaint{files.error()};
    for (const compare::DeploymentFile& file : *files) {
      if (const auto path = folder.write(file.name, file.text)) row.files.push_back(*path);
    }
  }
  return std::nullopt;
}

Outcome run(CompareArguments& arguments, Session& session) {
  const auto specs = model::config::SpecPath::standard();
  if (auto complaint = complete(arguments, specs)) return *std::move(complaint);
  std::optional<OutputFolder> folder;
  if (!arguments.folder.empty()) {
    folder.emplace("--export", arguments.folder, "compare-discovery",
                   std::vector{arguments.request.scenario});
    if (const auto error = folder->prepare()) return Complaint{*error};
  }
  arguments.request.on_progress = session.on_study();
  auto report = compare::compare(arguments.request, specs);
  if (!report) return report.error();
  Answer answer;
  if (folder) {
    if (auto complaint = write_files(*folder, *report, specs)) return *std::move(complaint);
    answer.complaint = folder->error().value_or("");
  }
  answer.document = document_of(*report, arguments.request);
  answer.json = to_json(*report, arguments.request);
  return answer;
}

void declare(Options& options, CompareArguments& arguments) {
  compare::Request& request = arguments.request;
  options.scenario(request.scenario, request.overrides);
  options.choice("--grow", request.grows,
                 {{"robots", compare::Grows::robots},
                  {"participants", compare::Grows::participants},
                  {"endpoints", compare::Grows::endpoints}},
                 "What grows: robots (default), participants of each, or endpoints of these",
                 "WHAT");
  options.text("--sizes", arguments.sizes,
               "How many, such as 2,5,10 (default: the scenario's own and some around it)", "LIST");
  options
      .number("--samples", request.samples,
              "Runs of each way and size, if they can differ (default 5)", "N")
      .within(1, 100'000);
  options.seed(request.seed, "Seed of the first schedule (default 0)");
  options.start_jitter(arguments.start_jitter);
  options.text(
      "--limit", arguments.limit,
      "What takes longer is not complete (default: the scenario's time_limit, at most 20s)",
      "TIME");
  options
      .number("--tune", request.tune_budget,
              "Search settings of the scenario's library with so many runs, as one more way", "N")
      .within(50, 1'000'000);
  options.folder("--export", arguments.folder, "Write the files to deploy each way here");
  options.jobs(request.threads);
}

}  // namespace

void declare_compare_discovery(Frame& frame) {
  frame.add<CompareArguments>(
      {"compare-discovery",
       "Discovery Server, static peers, Cyclone and others side by side, as the deployment grows",
       "Exit code: 0 compared, 3 interrupted, 2 bad input.",
       Formats::pages,
       {compare::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
