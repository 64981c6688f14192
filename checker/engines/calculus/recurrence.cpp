// The counts.
#include "checker/engines/calculus/recurrence.hpp"

#include <algorithm>

namespace stormproof::calculus {

std::int64_t times(std::int64_t a, std::int64_t b) {
  std::int64_t product = 0;
  return __builtin_mul_overflow(a, b, &product) ? endless : product;
}

std::int64_t plus(std::int64_t a, std::int64_t b) {
  std::int64_t sum = 0;
  return __builtin_add_overflow(a, b, &sum) ? endless : sum;
}

namespace {

/// How many of `first`, 3·first, 7·first, … or of the multiples of `first` are below `limit`.
std::int64_t attempts_before(std::int64_t limit, std::int64_t first, bool doubling) {
  if (!doubling) return limit <= 0 ? 0 : (limit - 1) / first;
  std::int64_t count = 0;
  for (std::int64_t at = first; at < limit; at = plus(times(at, 2), first)) ++count;
  return count;
}

/// The distances from the first attempt are 2, 6, 14, … times its delay.
std::int64_t attempts_within(std::int64_t window, std::int64_t first, bool doubling) {
  if (!doubling) return 1 + window / first;
  std::int64_t count = 1;
  for (std::int64_t at = times(first, 2); at <= window && at != endless;
       at = plus(times(at, 2), times(first, 2))) {
    ++count;
  }
  return count;
}

std::int64_t announcements_within(std::int64_t window, const Recurrence& r) {
  if (r.startup == 0) return 1 + window / r.period;
  if (r.period < r.startup_period) return 1 + window / std::min(r.period, r.startup_period);
  const std::int64_t early = std::min(r.startup, window / r.startup_period);
  const std::int64_t rest = window - times(r.startup, r.startup_period);
  return 1 + early + (rest > 0 ? rest / r.period : 0);
}

}  // namespace

std::int64_t Recurrence::most(std::int64_t window, std::int64_t delay) const {
  const std::int64_t stretched = plus(window, times(packets, delay));
  switch (kind) {
    case Kind::once:
      return 1;
    case Kind::periodic:
      return plus(1, stretched / period);
    case Kind::announcements:
      return announcements_within(stretched, *this);
    case Kind::attempts:
      return attempts_within(stretched, period, doubling);
    case Kind::unheard:
      return attempts_before(delay, period, doubling);
  }
  return endless;
}

Recurrence Recurrence::answered() const {
  Recurrence answer = *this;
  ++answer.packets;
  return answer;
}

Recurrence Recurrence::every(model::Nanoseconds period) {
  Recurrence r;
  r.kind = Kind::periodic;
  r.period = period.count();
  return r;
}

Recurrence Recurrence::announcements(const model::SpdpProfile& spdp) {
  Recurrence r;
  r.kind = Kind::announcements;
  r.period = spdp.period.count();
  r.startup_period = spdp.startup_period.count();
  r.startup = spdp.startup_announcements;
  return r;
}

Recurrence Recurrence::attempts(const model::SedpProfile& sedp) {
  Recurrence r;
  r.kind = Kind::attempts;
  r.period = sedp.initial_acknack_delay.count();
  r.doubling = sedp.initial_acknack_interval == model::InitialAckNackInterval::doubling;
  return r;
}

Recurrence Recurrence::unheard(const model::SedpProfile& sedp) {
  Recurrence r = attempts(sedp);
  r.kind = Kind::unheard;
  return r;
}

}  // namespace stormproof::calculus
