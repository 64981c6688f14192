// What the hosts of a replay have in common (reader_host.hpp, writer_host.hpp): one captured
// relation across hosts, the knobs of the profile, and a clock that the replay sets.
#pragma once

#include <cstdint>

#include "model/engine/running_world.hpp"

namespace stormproof::conform {

class RelationHost {
 public:
  struct OneRelation {
    std::uint32_t count;
    [[nodiscard]] static model::Pair pair(std::uint32_t) { return {0, 1, 0, true}; }
    [[nodiscard]] std::uint32_t descriptor_count(std::uint32_t, model::Stream) const {
      return count;
    }
  };

  // What a RunningWorld asks of every host.
  [[nodiscard]] static fsm::composition::Watcher* watcher() { return nullptr; }
  [[nodiscard]] OneRelation topology() const { return topology_; }
  [[nodiscard]] std::int64_t now() const { return now_ns_; }
  template <class Knob>
  [[nodiscard]] auto knob(Knob knob) const {
    return model::knob_value(knob, dds_);
  }

 protected:
  /// `count`: how many descriptors the writer has.
  RelationHost(const model::DdsProfile& dds, std::uint32_t count) : dds_{dds}, topology_{count} {}

  std::int64_t now_ns_ = 0;

 private:
  const model::DdsProfile& dds_;
  const OneRelation topology_;
};

}  // namespace stormproof::conform
