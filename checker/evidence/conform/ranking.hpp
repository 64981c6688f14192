// Which of several profiles explains a capture best: each is held against it, for a bounded time,
// and they are put in order. A capture that two of them explain does not tell them apart, and no
// order between those is more than a matter of taste.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "checker/evidence/conform/conform.hpp"

namespace stormproof::conform {

struct Candidate {
  std::string name;
  model::DdsProfile dds;
};

struct Ranked {
  std::string name;
  Conformance result;
};

struct NotHeld {
  std::string name;
  std::string why;
};

struct Ranking {
  std::vector<Ranked> ranked;     ///< best first
  std::size_t best = 0;           ///< how many of these the capture does not tell from the first
  std::vector<NotHeld> not_held;  ///< candidates that no capture can be held against
  std::size_t left_out = 0;       ///< candidates that an interruption left no time for

  /// That of the best; inconclusive if there is none.
  [[nodiscard]] Verdict verdict() const;
};

struct RankingRequest {
  const capture::Conversation& conversation;
  std::int64_t until_ns = INT64_MAX;
  Bounds bounds{};
  std::vector<Candidate> candidates;
  std::chrono::milliseconds each{20'000};  ///< after which a profile is inconclusive
  /// Called before each relation of each candidate; false stops everything.
  std::function<bool(const std::string& name, std::size_t done, std::size_t all)> progress{};
};

/// First those that conform, then those of which it is not known, then by the share of events that
/// are explained. Errors: as `conform`, of the capture.
[[nodiscard]] model::config::Result<Ranking> rank(const RankingRequest& request);

}  // namespace stormproof::conform
