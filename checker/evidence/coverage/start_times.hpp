// When participants start in the samples of a configuration, if more is known of it than the ranges
// of a schedule: when each of them did in the measured runs, or how far apart they were to start.
#pragma once

#include <cstdint>
#include <vector>

#include "checker/evidence/coverage/observation.hpp"
#include "model/deployment.hpp"

namespace stormproof::prediction {

/// Milliseconds of a row as the model counts time, at least 0.
[[nodiscard]] model::Nanoseconds nanoseconds(double ms);

class StartTimes {
 public:
  StartTimes() = default;
  /// `measured`: times of runs that say them of all participants; without any, participants have
  /// what is drawn, later by what was planned.
  StartTimes(const Spread& spread, std::vector<std::vector<Times>> measured)
      : spread_{spread}, measured_{std::move(measured)} {}

  /// How many measured runs say when each participant started.
  [[nodiscard]] std::size_t measured() const { return measured_.size(); }

  /// Gives the participants their times in a sample, after a schedule was drawn. The first samples
  /// have those of one measured run each; the others take the runs again in turn, each participant
  /// up to 1 ms later.
  void put(model::Deployment& deployment, std::size_t sample, std::uint64_t seed) const;

 private:
  Spread spread_;
  std::vector<std::vector<Times>> measured_;
};

}  // namespace stormproof::prediction
