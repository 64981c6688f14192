// A part ends when the clock has as much left as it leaves to others.
#include "checker/experiments/trials/budget.hpp"

#include <algorithm>

namespace stormproof::trials {

Budget::Budget(Clock clock) {
  if (!clock || !clock()) return;
  clock_ = std::move(clock);
  whole_ = left();
}

double Budget::left() const {
  if (!is_limited()) return std::numeric_limits<double>::infinity();
  return std::max(0.0, clock_().value_or(0) - reserved_);
}

double Budget::used() const {
  if (!is_limited()) return 0;
  return whole_ > 0 ? std::min(1.0, 1 - left() / whole_) : 1;
}

Budget Budget::part(double share) const {
  Budget made = *this;
  if (!is_limited()) return made;
  made.whole_ = share * left();
  made.reserved_ += left() - made.whole_;
  return made;
}

std::size_t Pace::fitting(const Budget& rest, std::size_t made) const {
  constexpr double careful = 0.75;  // of the time, what is planned for
  constexpr double most = 1e9;
  if (!rest.is_limited()) return static_cast<std::size_t>(most);
  const double took = std::max(left_ - budget_.left(), 1e-6);
  const auto runs = static_cast<double>(std::max(made, made_ + 1) - made_);
  return static_cast<std::size_t>(std::clamp(careful * rest.left() / took * runs, 1.0, most));
}

}  // namespace stormproof::trials
