// Holds the candidates against the capture one after the other.
#include "checker/evidence/conform/ranking.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/core.h>

namespace stormproof::conform {

namespace {

using model::config::Result;
using Clock = std::chrono::steady_clock;

double share(const Conformance& result) {
  return result.checked == 0
             ? 0
             : static_cast<double>(result.explained) / static_cast<double>(result.checked);
}

/// Smaller is better.
auto order(const Ranked& one) {
  const int verdict = one.result.verdict == Verdict::conforms       ? 0
                      : one.result.verdict == Verdict::inconclusive ? 1
                                                                    : 2;
  return std::tuple{verdict, -share(one.result), one.result.lost, one.name};
}

/// Whether nothing in the capture speaks for one rather than the other.
bool indistinguishable(const Conformance& one, const Conformance& other) {
  if (one.verdict != other.verdict) return false;
  if (one.verdict == Verdict::conforms) return true;
  if (one.verdict == Verdict::inconclusive || one.explained != other.explained) return false;
  const auto same = [](const Unexplained& a, const Unexplained& b) {
    return a.event == b.event && a.fault == b.fault;
  };
  return std::ranges::equal(one.unexplained, other.unexplained, same);
}

/// One candidate, for as long as it may take.
Result<Conformance> hold(const RankingRequest& request, const Candidate& candidate,
                         bool& interrupted) {
  const Clock::time_point end = Clock::now() + request.each;
  bool late = false;
  const auto progress = [&](std::size_t done, std::size_t all) {
    interrupted = request.progress && !request.progress(candidate.name, done, all);
    late = !interrupted && Clock::now() > end;
    return !interrupted && !late;
  };
  auto result =
      conform({request.conversation, request.until_ns, candidate.dds, request.bounds, progress});
  if (result && late && result->verdict == Verdict::inconclusive) {
    result->why_inconclusive =
        fmt::format("not done after {:.3g} s", static_cast<double>(request.each.count()) / 1'000);
  }
  return result;
}

}  // namespace

Verdict Ranking::verdict() const {
  return ranked.empty() ? Verdict::inconclusive : ranked.front().result.verdict;
}

Result<Ranking> rank(const RankingRequest& request) {
  Ranking ranking;
  bool interrupted = false;
  for (const Candidate& candidate : request.candidates) {
    if (auto why = refuse_profile(candidate.dds)) {
      ranking.not_held.push_back({candidate.name, *std::move(why)});
      continue;
    }
    if (interrupted) {
      ++ranking.left_out;
      continue;
    }
    auto result = hold(request, candidate, interrupted);
    if (!result) return result.error();
    if (interrupted && result->verdict == Verdict::inconclusive) {
      ++ranking.left_out;
      continue;
    }
    ranking.ranked.push_back({candidate.name, *std::move(result)});
  }
  std::ranges::sort(ranking.ranked, {}, order);
  while (ranking.best < ranking.ranked.size() &&
         (ranking.best == 0 ||
          indistinguishable(ranking.ranked[ranking.best].result, ranking.ranked.front().result))) {
    ++ranking.best;
  }
  return ranking;
}

}  // namespace stormproof::conform
