// Which sides of control-only relations there are, and what each of them needs in order to open
// (`OpenTopics` of fsm/composition/control.hpp). Liveliness needs that its participant has
// recognised the other one. A topic needs that it has created its endpoint there and has been
// notified of the other's.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "model/engine/topology.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::props {

class ControlSides {
 public:
  explicit ControlSides(const model::Topology& topology) : topology_{topology} {
    for (std::uint32_t pair = 0; pair < topology.pair_count(); ++pair) {
      first_.push_back(next_);
      const model::Pair& ends = topology.pair(pair);
      if (!ends.cross_host) continue;
      const std::uint32_t topics = count_of(ends);
      next_ += topics;
      for (const model::Stream stream : model::streams) {
        std::vector<std::uint32_t>& on = descriptors_[model::index_of(stream)];
        for (std::uint32_t topic = static_cast<std::uint32_t>(on.size()); topic < topics; ++topic) {
          const bool has_some = topic != model::fastdds::topic::liveliness;
          on.push_back(has_some ? model::fastdds::descriptor_on(topic, stream) : 0);
        }
      }
    }
    first_.push_back(next_);
  }

  [[nodiscard]] std::uint32_t count() const { return next_; }
  /// The pair that the relation is of.
  [[nodiscard]] std::uint32_t pair_of(std::uint32_t number) const {
    const auto after = std::ranges::upper_bound(first_, number);
    return static_cast<std::uint32_t>(after - first_.begin()) - 1;
  }

  [[nodiscard]] bool is_liveliness(std::uint32_t number) const {
    return number - first_[pair_of(number)] == model::fastdds::topic::liveliness;
  }

  /// What a side at participant i needs. `pair` leads from the other end to i.
  struct Needs {
    std::uint32_t pair = 0;
    bool liveliness = false;
    // A topic: i's descriptor, and the one of the pair's `stream` that i must know.
    std::uint32_t writer = 0;
    std::uint32_t created = 0;
    std::uint32_t stream = 0;
    std::uint32_t notified = 0;
  };
  /// Calls `visit(number, needs)` for each relation of the pair, whose writer is at its source: for
  /// the side of the writer, or of the reader.
  template <class Visit>
  void for_each(std::uint32_t pair, bool of_writer, Visit&& visit) const {
    const model::Pair& ends = topology_.pair(pair);
    const std::uint32_t own = of_writer ? 0 : 1;
    Needs needs;
    needs.pair = of_writer ? ends.reverse : pair;
    needs.writer = 2 * (of_writer ? ends.source : ends.destination) + own;
    needs.stream = 1 - own;
    for (std::uint32_t number = first_[pair]; number < first_[pair + 1]; ++number) {
      const std::uint32_t topic = number - first_[pair];
      needs.liveliness = topic == model::fastdds::topic::liveliness;
      if (!needs.liveliness) {
        needs.created = descriptors_[own][topic];
        needs.notified = descriptors_[needs.stream][topic];
      }
      visit(number, needs);
    }
  }

 private:
  /// Liveliness, and the topics that both ends have; a Discovery Server has none.
  [[nodiscard]] std::uint32_t count_of(const model::Pair& ends) const {
    namespace fastdds = model::fastdds;
    const std::uint32_t publications = topology_.descriptor_count(ends.source, model::Stream::pub);
    const std::uint32_t subscriptions =
        topology_.descriptor_count(ends.destination, model::Stream::sub);
    if (publications == 0 || subscriptions == 0) return 1;
    return fastdds::topic::first_user + std::min(publications - fastdds::default_publications,
                                                 subscriptions - fastdds::default_subscriptions);
  }

  const model::Topology& topology_;
  std::vector<std::uint32_t> first_;                       // by pair
  std::array<std::vector<std::uint32_t>, 2> descriptors_;  // of a stream, by topic
  std::uint32_t next_ = 0;
};

}  // namespace stormproof::props
