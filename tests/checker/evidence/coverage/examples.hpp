// Measured runs and predictions for the tests, built from plain numbers.
#pragma once

#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "checker/evidence/coverage/statistics.hpp"

namespace stormproof::prediction {

inline constexpr double never = std::numeric_limits<double>::infinity();

/// A run of 2 × N_P participants that completed after so many ms; with `never`, that did not
/// complete within 100 ms.
inline Observation run_of(double completion_ms, std::uint32_t participants = 1,
                          std::uint32_t endpoints = 2) {
  Observation run;
  run.hosts = 2;
  run.participants_per_host = participants;
  run.endpoints = endpoints;
  run.completed = completion_ms < never;
  run.values[0] = run.completed ? completion_ms : 100;
  return run;
}

inline Configuration configuration_of(const std::vector<double>& completions_ms,
                                      std::uint32_t participants = 1, std::uint32_t endpoints = 2) {
  std::vector<Observation> rows;
  for (const double ms : completions_ms) rows.push_back(run_of(ms, participants, endpoints));
  return configurations(rows).front();
}

inline Prediction prediction_of(const std::vector<double>& completions_ms) {
  Prediction prediction;
  prediction.values.fill(completions_ms);
  for (const double ms : completions_ms) prediction.incomplete += ms == never ? 1 : 0;
  return prediction;
}

inline model::config::Result<Observations> read_text(const std::string& text,
                                                     const ReadOptions& options = {}) {
  std::istringstream input{text};
  return read_observations(input, "runs.jsonl", options);
}

}  // namespace stormproof::prediction
