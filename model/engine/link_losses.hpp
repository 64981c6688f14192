// Which transmissions of a run fail (specs/guide/wifi.md, "Transmissions that fail"). One generator
// for all links, asked in the order in which transmissions begin.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "model/wireless_profile.hpp"

namespace stormproof::model {

class LinkLosses {
 public:
  LinkLosses(const FrameLoss& loss, std::uint32_t hosts)
      : loss_{loss}, is_worse_(hosts, false), random_{loss.seed} {}

  /// Whether one transmission to or from the station fails.
  [[nodiscard]] bool fails(std::uint32_t host) {
    Ratio probability = loss_.probability;
    if (loss_.bursts) {
      if (happens(is_worse_[host] ? loss_.bursts->end : loss_.bursts->begin)) {
        is_worse_[host] = !is_worse_[host];
      }
      if (is_worse_[host]) probability = loss_.bursts->probability;
    }
    return happens(probability);
  }
  /// Transmissions of a unicast frame, at most.
  [[nodiscard]] std::uint32_t most_transmissions() const { return loss_.retries + 1; }

 private:
  /// By a remainder, because the distributions of the standard library differ between machines.
  bool happens(const Ratio& probability) {
    const auto all = static_cast<std::uint64_t>(probability.denominator);
    return random_() % all < static_cast<std::uint64_t>(probability.numerator);
  }

  FrameLoss loss_;
  std::vector<bool> is_worse_;  // by host
  std::mt19937_64 random_;
};

}  // namespace stormproof::model
