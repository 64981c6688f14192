// Which endpoint each sample of a stream is about, and whether it says that this exists or exists
// no more. When endpoints come and go the deployment says, so the samples of a run are known before
// it. Without a life sample d is descriptor d. Source: specs/guide/cyclone-life.md,
// "Endpoints and participants that go".
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/engine/topology.hpp"
#include "model/scenario.hpp"

namespace stormproof::model::cyclone {

/// A sample of the writer of a stream.
struct Sample {
  std::uint32_t descriptor = 0;
  bool deletes = false;
};

/// What happens to a participant after it has created what it has from the beginning.
struct Change {
  enum class Kind : std::uint8_t { creates, deletes, leaves, dies };

  Nanoseconds at;
  Kind kind{};
  Stream stream{};           ///< of an endpoint
  std::uint32_t sample = 0;  ///< that says so
};

class LifeSamples {
 public:
  LifeSamples(const Scenario& scenario, const Topology& topology);

  /// How many samples the stream of the participant has in the whole run.
  [[nodiscard]] std::uint32_t count(std::uint32_t i, Stream s) const {
    return static_cast<std::uint32_t>(samples(i, s).size());
  }
  [[nodiscard]] Sample of(std::uint32_t i, Stream s, std::uint32_t sample) const {
    return samples(i, s)[sample];
  }
  /// How many endpoints it ever has.
  [[nodiscard]] std::uint32_t endpoints(std::uint32_t i, Stream s) const {
    return endpoints_[i][index_of(s)];
  }
  /// In the order of time.
  [[nodiscard]] const std::vector<Change>& changes(std::uint32_t i) const { return changes_[i]; }
  /// How many samples its liveliness writer has in the whole run.
  [[nodiscard]] std::uint32_t signs_of_life(std::uint32_t i) const { return signs_of_life_[i]; }

 private:
  [[nodiscard]] const std::vector<Sample>& samples(std::uint32_t i, Stream s) const {
    return samples_[i][index_of(s)];
  }
  void plan(std::uint32_t i, const Scenario& scenario);
  void leave(std::uint32_t i, Nanoseconds at, std::vector<Change>& changes);

  std::vector<std::array<std::vector<Sample>, 2>> samples_;
  std::vector<std::array<std::uint32_t, 2>> endpoints_;
  std::vector<std::vector<Change>> changes_;
  std::vector<std::uint32_t> signs_of_life_;
};

}  // namespace stormproof::model::cyclone
