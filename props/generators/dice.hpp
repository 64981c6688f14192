// Random choices with integer arithmetic only. The distributions of the standard library differ
// from one implementation to another; std::mt19937_64 and these few lines do not, so a seed means
// the same everywhere.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <vector>

namespace stormproof::props {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_{seed} {}

  /// lo … hi, both included.
  std::int64_t between(std::int64_t lo, std::int64_t hi) {
    const auto span = static_cast<std::uint64_t>(hi - lo) + 1;
    return lo + static_cast<std::int64_t>(engine_() % span);
  }
  std::uint32_t count(std::uint32_t lo, std::uint32_t hi) {
    return static_cast<std::uint32_t>(between(lo, hi));
  }
  /// True in `percent` of 100 cases.
  bool chance(int percent) { return between(0, 99) < percent; }

  template <class T>
  T pick(const std::vector<T>& values) {
    return values[engine_() % values.size()];
  }
  std::int64_t among(std::initializer_list<std::int64_t> values) {
    return values.begin()[engine_() % values.size()];
  }
  /// Any of the first `size` enumerators.
  template <class Enum>
  Enum choice(std::int64_t size) {
    return static_cast<Enum>(between(0, size - 1));
  }

  /// lo … hi, every order of magnitude about as likely as any other. lo ≥ 1.
  std::int64_t magnitude(std::int64_t lo, std::int64_t hi) {
    int decades = 0;
    for (std::int64_t x = lo; x <= hi / 10; x *= 10) ++decades;
    std::int64_t base = lo;
    for (std::int64_t k = between(0, decades); k > 0; --k) base *= 10;
    return between(base, base <= hi / 10 ? base * 10 : hi);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace stormproof::props
