// What participants know of types, what waits for them, and the samples by which they ask
// (fsm/composition/lookups.hpp): queued by who sends them, and kept by each writer in the order of
// their numbers. Who says how samples become messages is `Protocol` (model/fastdds/lookups.cpp).
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "model/engine/topology.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/fastdds/types.hpp"

namespace stormproof::model::fastdds {

/// One addressee takes a sample up, whoever receives it.
struct Sample {
  std::uint32_t addressee = 0;
  std::uint32_t looked_up = 0;  ///< 2 · type + stream of the descriptors that wait for it
  std::uint32_t stage = 0;      ///< 0 and 2 are questions, 1 and 3 answers
};

class Lookups {
 public:
  /// A descriptor of a relation, whose reader's participant waits for its type.
  using Waiting = std::pair<std::uint32_t, std::uint32_t>;

  Lookups(const Deployment& deployment, const Topology& topology)
      : topology_{topology},
        types_{deployment},
        learned_(topology.participant_count()),
        queues_(topology.participant_count()),
        histories_(control_writers * std::size_t{topology.participant_count()}) {}

  /// What is looked up if the reader of the relation does not know the type of descriptor d.
  [[nodiscard]] std::uint32_t looked_up(std::uint32_t relation, std::uint32_t d) const;
  /// The participant has looked it up, or creates an endpoint with it among its first ones of each
  /// stream.
  [[nodiscard]] bool knows(std::uint32_t participant, std::uint32_t looked_up,
                           std::array<std::uint32_t, 2> created) const;
  void learn(std::uint32_t participant, std::uint32_t looked_up) {
    learned_[participant].insert(looked_up / 2);
  }

  /// Those that wait for the type, of this stream, in the order in which they came.
  [[nodiscard]] std::vector<Waiting>& waiting(std::uint32_t participant, std::uint32_t looked_up) {
    return waiting_[{participant, looked_up}];
  }
  [[nodiscard]] std::vector<Waiting>& waiting_with(std::uint32_t relation, std::uint32_t d) {
    return waiting(topology_.pair(relation / 2).destination, looked_up(relation, d));
  }
  [[nodiscard]] bool waits(std::uint32_t relation, std::uint32_t d) const;

  void queue(std::uint32_t participant, const Sample& sample) {
    queues_[participant].push_back(sample);
  }
  [[nodiscard]] bool has_queued(std::uint32_t participant) const {
    return !queues_[participant].empty();
  }
  /// The oldest sample of the participant's queue leaves it, and is the next one of its writer
  /// (`control_writers`), which is the result.
  std::uint32_t take(std::uint32_t participant);
  /// Sample `number`, from 1, of a writer, and the last one.
  [[nodiscard]] const Sample& sample(std::uint32_t writer, std::uint32_t number) const {
    return histories_[writer][number - 1];
  }
  [[nodiscard]] const Sample& last_sample(std::uint32_t writer) const {
    return histories_[writer].back();
  }
  [[nodiscard]] std::uint32_t sample_count(std::uint32_t writer) const {
    return static_cast<std::uint32_t>(histories_[writer].size());
  }

 private:
  const Topology& topology_;
  const Types types_;
  std::vector<std::set<std::uint32_t>> learned_;  // types, by participant
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Waiting>> waiting_;
  std::vector<std::deque<Sample>> queues_;      // by participant
  std::vector<std::vector<Sample>> histories_;  // by writer
};

}  // namespace stormproof::model::fastdds
