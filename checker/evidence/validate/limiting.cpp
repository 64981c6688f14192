// Shares of one run, and of many.
#include "checker/evidence/validate/limiting.hpp"

#include <algorithm>

#include "checker/experiments/statistics/quantiles.hpp"

namespace stormproof::validate {

Shares shares_of(const model::RunResult& run) {
  Shares shares;
  const auto all = static_cast<double>(run.end_time.count());
  if (all <= 0) return shares;
  const auto raise = [&](double& share, model::Nanoseconds time) {
    share = std::max(share, static_cast<double>(time.count()) / all);
  };
  for (const model::ChannelUse& use : run.channels) raise(shares.air, use.total_busy());
  for (const model::Waiting& waiting : run.waiting) {
    raise(shares.sender, waiting.sender);
    raise(shares.processor, waiting.thread);
  }
  return shares;
}

const char* name_of(Limit limit) {
  switch (limit) {
    case Limit::none:
      return "none";
    case Limit::air:
      return "air";
    case Limit::sender:
      return "sender";
    case Limit::processor:
      return "processor";
  }
  return "";
}

namespace {
double median_of(const std::vector<Shares>& runs, double Shares::*share) {
  std::vector<double> values;
  for (const Shares& one : runs) values.push_back(one.*share);
  return statistics::median(std::move(values));
}
}  // namespace

Limiting limiting(const std::vector<Shares>& runs) {
  Limiting result;
  if (runs.empty()) return result;
  result.median = {median_of(runs, &Shares::air), median_of(runs, &Shares::sender),
                   median_of(runs, &Shares::processor)};
  constexpr double half = 0.5;
  double most = half;
  const auto try_one = [&](double share, Limit limit) {
    if (share < most) return;
    most = share;
    result.limit = limit;
  };
  // A sender stalls because the air is busy, so of equals the air says more.
  try_one(result.median.processor, Limit::processor);
  try_one(result.median.sender, Limit::sender);
  try_one(result.median.air, Limit::air);
  return result;
}

}  // namespace stormproof::validate
