// The pairs and relations of a deployment, numbered densely: pairs of one source stand together in
// ascending order of the destination, relation 2·pair + stream belongs to the pair's writer side.
// For the paper's protocol only cross-host pairs exist (its set R), because same-host traffic never
// touches the channel; Fast DDS's writers treat all readers alike, so there same-host pairs exist
// too (`discovers_same_host`).
#pragma once

#include <cstdint>
#include <vector>

#include "model/dds_profile.hpp"
#include "model/deployment.hpp"
#include "model/scenario.hpp"

namespace stormproof::model {

/// Whether there are pairs on the same host; and, `with_server`, a Discovery Server: a participant
/// after all others, on host 0, without endpoints, from time 0 on.
enum class SameHostPairs : std::uint8_t { left_out, included, with_server };
/// Which of them runs of the profile have.
[[nodiscard]] SameHostPairs same_host_pairs(const DdsProfile& dds);

/// A directed pair: what `source` advertises, `destination` must learn.
struct Pair {
  std::uint32_t source = 0;
  std::uint32_t destination = 0;
  std::uint32_t reverse = 0;  ///< number of the pair (destination, source)
  bool cross_host = true;
};

class Topology {
 public:
  Topology(const Deployment& deployment, const DescriptorProfile& descriptors,
           SameHostPairs same_host = SameHostPairs::left_out);

  /// With Discovery Servers, which are the last ones.
  [[nodiscard]] std::uint32_t participant_count() const { return participant_count_; }
  [[nodiscard]] bool is_server(std::uint32_t i) const { return i >= first_server_; }
  [[nodiscard]] std::uint32_t first_server() const { return first_server_; }
  [[nodiscard]] std::uint32_t server_count() const { return participant_count_ - first_server_; }
  [[nodiscard]] std::uint32_t pair_count() const {
    return static_cast<std::uint32_t>(pairs_.size());
  }
  [[nodiscard]] std::uint32_t relation_count() const { return 2 * pair_count(); }
  [[nodiscard]] const Pair& pair(std::uint32_t number) const { return pairs_[number]; }

  /// Number of the pair (i, j); it must exist.
  [[nodiscard]] std::uint32_t pair_between(std::uint32_t i, std::uint32_t j) const;

  /// Pairs with source i are [first_pair(i), first_pair(i + 1)), in ascending order of the
  /// destination.
  [[nodiscard]] std::uint32_t first_pair(std::uint32_t i) const { return first_pair_[i]; }
  /// Number of pairs with source i.
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
  /// How many publications i creates late in a run, if it creates endpoints over time.
  [[nodiscard]] std::uint32_t late_publications(std::uint32_t i) const {
    return late_publications_[i];
  }
  [[nodiscard]] Nanoseconds start(std::uint32_t i) const { return start_[i]; }

  /// F: required descriptor deliveries, summed over all cross-host relations (paper, "Structural
  /// Discovery Workload"); with a server those that match something, also of the same host.
  [[nodiscard]] std::uint64_t required_deliveries() const { return required_deliveries_; }
  /// How many descriptors of i are on a topic of which j has the opposite side; with a server.
  [[nodiscard]] std::uint32_t matching_descriptors(std::uint32_t i, std::uint32_t j,
                                                   const DescriptorProfile& defaults) const;

 private:
  std::uint32_t first_server_;  // one more than the last participant, if there is none
  std::uint32_t participant_count_;
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> first_pair_;
  std::vector<std::uint32_t> descriptor_count_;
  std::vector<std::uint32_t> late_publications_;
  std::vector<Nanoseconds> start_;
  std::uint64_t required_deliveries_ = 0;
};

/// As a run of the scenario has it.
[[nodiscard]] Topology topology_of(const Scenario& scenario);

}  // namespace stormproof::model
