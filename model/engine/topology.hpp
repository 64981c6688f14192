// The cross-host pairs and relations of a deployment, numbered densely: pairs of one source stand together in
// ascending order of the destination, relation 2·pair + stream belongs to the pair's writer side. Only cross-host
// pairs exist for the protocol (the paper's set R); same-host traffic never touches the channel.
#pragma once

#include <cstdint>
#include <vector>

#include "model/dds_profile.hpp"
#include "model/deployment.hpp"

namespace stormproof::model {

/// A directed cross-host pair: what `source` advertises, `destination` must learn.
struct Pair {
  std::uint32_t source = 0;
  std::uint32_t destination = 0;
  std::uint32_t reverse = 0;  ///< number of the pair (destination, source)
};

class Topology {
 public:
  Topology(const Deployment& deployment, const DescriptorProfile& descriptors);

  [[nodiscard]] std::uint32_t participant_count() const { return participant_count_; }
  [[nodiscard]] std::uint32_t pair_count() const { return static_cast<std::uint32_t>(pairs_.size()); }
  [[nodiscard]] std::uint32_t relation_count() const { return 2 * pair_count(); }
  [[nodiscard]] const Pair& pair(std::uint32_t number) const { return pairs_[number]; }

  /// Pairs with source i are [first_pair(i), first_pair(i + 1)), in ascending order of the destination.
  [[nodiscard]] std::uint32_t first_pair(std::uint32_t i) const { return first_pair_[i]; }
  /// Number of cross-host peers of participant i.
  [[nodiscard]] std::uint32_t peer_count(std::uint32_t i) const {
    return first_pair_[i + 1] - first_pair_[i];
  }

  /// D_i,s: how many descriptors participant i advertises on stream s.
  [[nodiscard]] std::uint32_t descriptor_count(std::uint32_t i, Stream s) const {
    return descriptor_count_[2 * i + index_of(s)];
  }
  [[nodiscard]] std::uint32_t descriptor_count(std::uint32_t relation) const {
    return descriptor_count_[2 * pairs_[relation / 2].source + relation % 2];
  }
  [[nodiscard]] Nanoseconds start(std::uint32_t i) const { return start_[i]; }

  /// F: required descriptor deliveries, summed over all relations (paper, "Structural Discovery Workload").
  [[nodiscard]] std::uint64_t required_deliveries() const { return required_deliveries_; }

 private:
  std::uint32_t participant_count_;
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> first_pair_;
  std::vector<std::uint32_t> descriptor_count_;
  std::vector<Nanoseconds> start_;
  std::uint64_t required_deliveries_ = 0;
};

}  // namespace stormproof::model
