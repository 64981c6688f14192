// `stormproof fix` without its command line: what makes this deployment discover itself in time? It
// tries, kind by kind, what a user can change, the least change first, and stops at the first kind
// that cures. Seeds that nothing was chosen by have the last word, before and after.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "checker/experiments/compare/compare.hpp"
#include "checker/experiments/compare/deployment_files.hpp"
#include "checker/experiments/launch/launch.hpp"

namespace stormproof::fix {

/// What may be changed, in this order.
enum class Kind : std::uint8_t {
  settings,   ///< of the library that the scenario has
  discovery,  ///< another way of this library: a Discovery Server, static peers
  launch,     ///< when processes start, and how many there are on a robot
  vendor      ///< another library
};
inline constexpr Kind kinds[] = {Kind::settings, Kind::discovery, Kind::launch, Kind::vendor};
/// "settings", "discovery", …: what --keep takes.
[[nodiscard]] const char* name_of(Kind kind);

struct Request {
  std::string scenario;  ///< as it was given
  std::vector<std::string> overrides;
  std::set<Kind> keep;                ///< what is not changed
  std::size_t samples = 12;           ///< runs before and after
  std::size_t trials = 5;             ///< runs of what is tried
  std::size_t budget = 200;           ///< runs of the search for settings
  std::uint64_t seed = 0;             ///< of what is tried; before and after have others
  model::Nanoseconds start_jitter{};  ///< each process starts up to this much later
  std::size_t threads = 0;
  trials::Budget time;
  trials::StudyProgress on_progress;  ///< false interrupts
};

/// Something that was tried.
struct Attempt {
  Kind kind{};
  std::string name;              ///< "server on a robot", "tuned, host by host, 400ms apart"
  compare::Candidate candidate;  ///< what it is deployed with
  std::optional<launch::Plan> plan;
  model::Scenario scenario;
  launch::Cell runs;                      ///< under the seeds of what is tried
  std::optional<launch::Cell> confirmed;  ///< under those of `before`, if it cured
  std::string not_run;                    ///< why it has no runs, or not all; empty: it has
};

enum class Answer : std::uint8_t {
  fine,           ///< nothing has to be changed
  cured,          ///< no run fails any more
  nothing_cures,  ///< of what was tried; the nearest may help
  unfinished      ///< interrupted, or no time for the rest: nothing is known that cures
};
[[nodiscard]] const char* name_of(Answer answer);

struct Report {
  Answer answer = Answer::unfinished;
  compare::Candidates candidates;
  launch::Cell before;
  std::vector<Attempt> attempts;      ///< in the order in which they were tried
  std::optional<std::size_t> chosen;  ///< the cure, or what comes nearest and is better than before
  std::vector<Kind> untried;          ///< kinds for which there was no time, wholly or in part
  bool usual_hosts = false;           ///< launch plans had the usual processors
  bool interrupted = false;

  /// The runs that are said of the chosen one.
  [[nodiscard]] const launch::Cell* after() const;
};

/// Runs that storm, are not complete, or exceed limits.completion.
[[nodiscard]] std::size_t failures(const launch::Cell& cell, const model::Scenario& scenario);

/// Errors: the scenario's; that its profile is no product's.
[[nodiscard]] model::config::Result<Report> fix(const Request& request,
                                                const model::config::SpecPath& specs);

/// What to deploy for an attempt: files of the way or settings, and of the launch plan.
[[nodiscard]] model::config::Result<std::vector<compare::DeploymentFile>> files_of(
    const Attempt& attempt, const Request& request, const model::config::SpecPath& specs);

/// The lines of a shell that make use of these files, which are in `folder`.
[[nodiscard]] std::vector<std::string> how_to_load(
    const std::vector<compare::DeploymentFile>& files, const std::string& folder);

}  // namespace stormproof::fix
