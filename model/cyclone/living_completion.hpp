// When discovery is complete if participants have a life: every two that are there know each other,
// each has been notified of exactly the endpoints that the other has, and nobody knows one who is
// gone. It keeps the number of what is missing up to date.
// Source: specs/guide/cyclone-life.md, "Complete".
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/cyclone/life_samples.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model::cyclone {

class LivingCompletion {
 public:
  using Number = std::uint32_t;

  LivingCompletion(RunState& run, const LifeSamples& samples);

  /// The pair's destination knows its source, or forgets it with all that it knew of it.
  void recognise(Number pair);
  void forget(Number pair);
  /// The pair's destination has been notified of what a sample of its source says.
  void follow(Number pair, Stream s, Sample said);
  /// Participant i has an endpoint more, or less, as the sample says; or is gone.
  void create(Number i, Stream s, Number sample);
  void remove(Number i, Stream s, Number sample);
  void die(Number i);

  [[nodiscard]] bool owns(Number i, Stream s, Number descriptor) const {
    return of(owned_[i], s)[descriptor];
  }
  [[nodiscard]] bool knows(Number pair, Stream s, Number descriptor) const {
    return of(known_[pair], s)[descriptor];
  }
  /// Of those that are there and known.
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) const;

 private:
  using Set = std::vector<bool>;
  using BothStreams = std::array<Set, 2>;

  static const Set& of(const BothStreams& sets, Stream s) { return sets[index_of(s)]; }
  [[nodiscard]] std::uint64_t lacking(Number pair) const;
  void count(Number pair);
  void count_all(Number i);
  void set(Number i, Stream s, Number sample, bool exists);

  RunState& run_;
  const LifeSamples& samples_;
  std::vector<BothStreams> owned_;      // by participant and descriptor
  std::vector<BothStreams> known_;      // by pair and descriptor
  std::vector<bool> recognised_;        // by pair
  std::vector<bool> gone_;              // by participant
  std::vector<std::uint64_t> lacking_;  // by pair
};

}  // namespace stormproof::model::cyclone
