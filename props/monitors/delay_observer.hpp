// A monitor that needs the delays of packets. The monitors of one run have them measured once, by a
// probe that hears of everything before they do; a monitor that is alone measures them itself.
#pragma once

#include <memory>

#include "props/monitors/delay_probe.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::props {

class DelayObserver : public Observer {
 public:
  using Feeder = DelayObserver;

  DelayObserver(std::string_view property, const model::Scenario& scenario)
      : Observer{property}, probe_{std::make_shared<DelayProbe>(scenario)} {}

  void join(model::Company& company) override {
    Observer::join(company);
    probe_ = company.gatherer_like(probe_);
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (is_alone()) probe_->delays().emitted(packet, now());
  }
  void arrived(const model::Packet& packet, bool lost) override {
    if (is_alone()) probe_->delays().arrived(packet, lost);
  }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    if (is_alone()) probe_->delays().received(topology(), packet, receiver, now());
  }

 protected:
  [[nodiscard]] const DelayMeter& delays() const { return probe_->delays(); }

 private:
  std::shared_ptr<DelayProbe> probe_;
};

}  // namespace stormproof::props
