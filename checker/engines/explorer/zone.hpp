// A zone: all assignments of times to a few events that satisfy a set of difference constraints
// x - y <= c, in integer nanoseconds. The explorer keeps the pending events of a state this way, so
// one state stands for every combination of packet delays. The representation is the usual
// difference-bound matrix (Dill 1989), always in canonical form: every entry is the tightest bound
// that follows from all others. Each operation restores that form in O(n^2), because the
// constraints that it adds share a variable, so that a shortest path uses at most one of them.
//
// Variable 0 is the present. Everything else is pending (not before the present) or a mark
// (something past whose time still matters). All times are bounded by construction: there is no
// infinite entry.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace stormproof::explorer {

class Zone {
 public:
  /// Most variables that a zone can have, the present included.
  static constexpr unsigned capacity = 24;

  Zone() { d_[0][0] = 0; }
  /// Copies no more than there is; most zones are small.
  Zone(const Zone& other) { *this = other; }
  Zone& operator=(const Zone& other) {
    size_ = other.size_;
    for (unsigned i = 0; i < size_; ++i) {
      std::copy(other.d_[i].begin(), other.d_[i].begin() + size_, d_[i].begin());
    }
    return *this;
  }

  /// Variables, the present included.
  [[nodiscard]] unsigned size() const { return size_; }
  /// The largest value of x_a - x_b, ns.
  [[nodiscard]] std::int64_t bound(unsigned a, unsigned b) const { return d_[a][b]; }

  /// The largest values of x_a - x_b for all b.
  [[nodiscard]] const std::int64_t* row(unsigned a) const { return d_[a].data(); }

  /// Takes `size` variables, the present included, with these bounds, row by row.
  template <class Bound>
  void assign(unsigned size, const Bound* bounds) {
    size_ = size;
    for (unsigned i = 0; i < size; ++i) {
      std::copy(bounds + i * size, bounds + (i + 1) * size, d_[i].begin());
    }
  }

  /// Adds a variable between `low` and `high` ns after the present; returns its number.
  unsigned add(std::int64_t low, std::int64_t high) {
    const unsigned n = size_++;
    for (unsigned j = 0; j < n; ++j) {
      d_[n][j] = high + d_[0][j];
      d_[j][n] = d_[j][0] - low;
    }
    d_[n][n] = 0;
    return n;
  }

  /// Whether x_a - x_b <= c is possible.
  [[nodiscard]] bool admits(unsigned a, unsigned b, std::int64_t c) const {
    return d_[b][a] + c >= 0;
  }

  /// Adds x_a - x_b <= c. Returns false, and leaves the zone alone, if nothing would remain.
  bool constrain(unsigned a, unsigned b, std::int64_t c) {
    if (!admits(a, b, c)) return false;
    if (d_[a][b] <= c) return true;
    for (unsigned i = 0; i < size_; ++i) {
      for (unsigned j = 0; j < size_; ++j) {
        d_[i][j] = std::min(d_[i][j], d_[i][a] + c + d_[b][j]);
      }
    }
    return true;
  }

  /// Forgets variable v; the variables behind it move up by one.
  void remove(unsigned v) {
    --size_;
    for (unsigned i = 0; i < size_; ++i) {
      const auto& from = d_[i < v ? i : i + 1];
      if (i >= v) std::copy(from.begin(), from.begin() + v, d_[i].begin());
      std::copy(from.begin() + v + 1, from.begin() + size_ + 1, d_[i].begin() + v);
    }
  }

  /// Two variables take each other's numbers.
  void exchange(unsigned a, unsigned b) {
    for (unsigned i = 0; i < size_; ++i) std::swap(d_[a][i], d_[b][i]);
    for (unsigned i = 0; i < size_; ++i) std::swap(d_[i][a], d_[i][b]);
  }

  /// No limit in `Limits`: nothing is said about this variable.
  static constexpr std::int64_t free = INT64_MAX;
  /// By variable f: x_e - x_f <= limit[f], or `free`.
  using Limits = std::array<std::int64_t, capacity>;

  /// Whether event e can be the next one, which it is if it respects all `limits`.
  [[nodiscard]] bool can_be_next(unsigned e, const Limits& limits) const {
    for (unsigned f = 1; f < size_; ++f) {
      if (f != e && limits[f] != free && d_[f][e] + limits[f] < 0) return false;
    }
    return true;
  }

  /// Event e happens next and is the present from then on; the variables behind it move up by one.
  /// `can_be_next(e, limits)` must hold.
  void advance(unsigned e, const Limits& limits) {
    std::array<std::int64_t, capacity> least{};  // tightest new bound of x_e - x_j
    for (unsigned j = 0; j < size_; ++j) {
      least[j] = d_[e][j];
      for (unsigned f = 1; f < size_; ++f) {
        if (f != e && limits[f] != free) least[j] = std::min(least[j], limits[f] + d_[f][j]);
      }
    }
    for (unsigned i = 0; i < size_; ++i) {
      const std::int64_t to_event = d_[i][e];
      for (unsigned j = 0; j < size_; ++j) d_[i][j] = std::min(d_[i][j], to_event + least[j]);
    }
    for (unsigned j = 0; j < size_; ++j) d_[0][j] = d_[e][j];
    for (unsigned i = 0; i < size_; ++i) d_[i][0] = d_[i][e];
    d_[0][0] = 0;
    remove(e);
  }

 private:
  std::array<std::array<std::int64_t, capacity>, capacity> d_;  // the first `size_` of each
  unsigned size_ = 1;
};

}  // namespace stormproof::explorer
