// What laws about lookups of types have in common: who watches runs of Fast DDS in which
// participants ask for types that they do not know, and of which scenarios. A scenario without
// types is given some, so that these laws say something about each.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "model/fastdds/control.hpp"
#include "model/fastdds/types.hpp"
#include "props/laws/families.hpp"
#include "props/laws/sides.hpp"
#include "props/laws/watching.hpp"

namespace stormproof::props {

namespace fastdds = model::fastdds;

class AskingWatch : public SideWatch {
 public:
  AskingWatch(std::string_view law, const model::Scenario& scenario)
      : SideWatch{law, scenario},
        asks_{scenario.deployment.types && fastdds::looks_up_types(scenario.dds)} {}

  void run_started(const model::Topology& topology) override {
    SideWatch::run_started(topology);
    control_.emplace(topology, scenario());
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (is_of_lookups(packet)) said(packet);
  }
  void looped_back(const model::Packet& packet, std::uint32_t) override {
    if (is_of_lookups(packet)) said(packet);
  }

 protected:
  /// A packet of a relation of questions or answers is sent.
  virtual void said(const model::Packet&) = 0;

  [[nodiscard]] bool asks() const { return asks_; }
  [[nodiscard]] const fastdds::ControlRelations& control() const { return *control_; }
  [[nodiscard]] bool is_of_lookups(const model::Packet& packet) const {
    using enum model::PacketKind;
    const bool is_control =
        packet.kind == user_heartbeat || packet.kind == user_acknack || packet.kind == lookup;
    return asks_ && is_control && control_->is_lookup(packet.detail);
  }

 private:
  const bool asks_;
  std::optional<fastdds::ControlRelations> control_;
};

/// Whether participants can ask, and do so at once.
[[nodiscard]] inline bool can_ask(const model::Scenario& scenario) {
  return is_stateful(scenario) && !scenario.hosts && !scenario.deployment.life &&
         scenario.wireless.sender != model::Sender::stalls;
}

/// With types that others do not have, and without losses.
template <class Watch>
[[nodiscard]] std::optional<std::string> broken_with_types(const model::Scenario& scenario,
                                                           const Simulate& simulate) {
  model::Scenario asking = scenario;
  std::uint64_t most = 3;
  for (const model::Participant& p : asking.deployment.participants) {
    most = std::min(most, fastdds::endpoints_with_own_types(p));
  }
  asking.deployment.types = model::EndpointTypes{static_cast<std::uint32_t>(most)};
  asking.dds.version.type_lookup = model::Whether::yes;
  asking.wireless.lost_packets.clear();
  asking.wireless.loss.reset();
  asking.wireless.queue.reset();
  return observed<Watch>(asking, simulate);
}

template <class Watch>
[[nodiscard]] constexpr Law asking_law(std::string_view id, std::string_view statement) {
  return {id, statement, can_ask, broken_with_types<Watch>, watched_by<Watch>};
}

}  // namespace stormproof::props
