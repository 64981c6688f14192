// `stormproof survive` without its command line: everything that can happen to a running fleet is
// let happen in runs of the simulator, at several moments of the announcement period, and it is
// noted how soon everybody has everything again. What is not survived is tried with what is known
// to help.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/survive/cures.hpp"
#include "checker/experiments/survive/failures.hpp"
#include "checker/experiments/trials/budget.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "checker/experiments/trials/unasked.hpp"
#include "model/config/spec_path.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::survive {

struct Request {
  std::string scenario;  ///< as it was given
  std::vector<std::string> overrides;
  std::vector<std::string> versions;  ///< DDS profiles that are asked about besides
  std::vector<model::Nanoseconds> lengths;
  model::Nanoseconds limit{60'000'000'000};  ///< what takes longer after a failure and a lease is
                                             ///< not recovered
  std::size_t samples = 5;                   ///< runs of each failure
  std::uint64_t seed = 0;                    ///< run k of each has seed + k
  std::size_t threads = 0;
  trials::Budget time;
  trials::StudyProgress on_progress;  ///< false interrupts
};

/// What came of a failure.
struct Outcome {
  Failure failure;
  std::size_t runs = 0;
  std::size_t recovered = 0;
  statistics::Quantiles recovery;    ///< ns from the end of the failure on
  statistics::Quantiles lost_pairs;  ///< ordered pairs of which one forgot the other
  statistics::Quantiles messages;    ///< from the end of the failure until all is recovered

  [[nodiscard]] bool is_survived() const { return recovered == runs; }
};

/// What a cure does where the failure is not survived.
struct Attempt {
  Failure failure;
  Cure cure;
  std::size_t runs = 0;
  std::size_t recovered = 0;
  statistics::Quantiles recovery;

  [[nodiscard]] bool cures() const { return runs > 0 && recovered == runs; }
};

/// The fleet with one DDS profile.
struct Version {
  std::string name;  ///< "as it is", or the profile's
  model::Scenario scenario;
  std::size_t undiscovered = 0;  ///< runs in which discovery is not complete before anything fails
  std::vector<Outcome> outcomes = {};
  std::vector<Attempt> attempts = {};

  /// The shortest length of the kind from which on every failure is survived, if a shorter one is
  /// not.
  [[nodiscard]] std::optional<model::Nanoseconds> survived_from(Kind kind) const;
};

struct Report {
  std::vector<Version> versions;    ///< the scenario's own first
  bool without_processors = false;  ///< the scenario has hosts, or a full queue that is waited for
  trials::Unasked unasked;
  bool interrupted = false;

  /// Outcomes that are not survived, of all versions or of the first.
  [[nodiscard]] std::size_t unsurvived() const;
};

/// Errors: the scenario's, that it has a life already, and that its rules know none.
[[nodiscard]] model::config::Result<Report> survive(const Request& request,
                                                    const model::config::SpecPath& specs);

}  // namespace stormproof::survive
