// What every monitor needs: the number and the time of the event that is being processed, and the
// numbering of the deployment. Monitors see a run only through the probe, so that they hold for
// mutated rules, too; whatever they know of X, C and pending timers they gather from what happened.
#pragma once

#include <string>
#include <string_view>

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "props/monitor.hpp"

namespace stormproof::props {

class Observer : public Monitor {
 public:
  explicit Observer(std::string_view property) : property_{property} {}

  [[nodiscard]] std::string_view property() const override { return property_; }

  void run_started(const model::Topology& topology) override { topology_ = &topology; }
  void event_started(const model::Event& event) override {
    event_ = events_++;
    now_ = event.time;
  }

 protected:
  /// Objects to what happens in the current event.
  void object_now(std::string reason) { object(event_, now_, std::move(reason)); }

  [[nodiscard]] std::uint64_t event() const { return event_; }
  [[nodiscard]] std::uint64_t events() const { return events_; }
  [[nodiscard]] model::Nanoseconds now() const { return now_; }
  /// Exists while the run lasts, not in `finish` and `remarks`.
  [[nodiscard]] const model::Topology& topology() const { return *topology_; }

 private:
  std::string_view property_;
  const model::Topology* topology_ = nullptr;
  std::uint64_t event_ = 0;
  std::uint64_t events_ = 0;
  model::Nanoseconds now_;
};

}  // namespace stormproof::props
