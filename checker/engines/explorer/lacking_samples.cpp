// Counts the samples that the reader takes.
#include "checker/engines/explorer/lacking_samples.hpp"

#include <set>

#include <fmt/core.h>

#include "props/monitors/describe.hpp"
#include "props/monitors/observer.hpp"
#include "props/monitors/received_submessages.hpp"

namespace stormproof::explorer {

namespace {

class LackingSamples : public props::Observer {
 public:
  explicit LackingSamples(unsigned samples) : Observer{"live.no-stall"}, samples_{samples} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    heard_.reset(topology);
  }
  void received(const model::Packet& packet, std::uint32_t) override { heard_.arriving(packet); }
  void transition(const model::MachineRef& machine, std::string_view event, std::string_view,
                  std::string_view, std::uint32_t, std::uint64_t) override {
    const model::Submessage* heard = heard_.heard(machine, event);
    if (heard == nullptr || event != "DataReceived" || machine.subject != 0) return;
    received_.insert(heard->sample);
  }
  void finish(model::Nanoseconds end) override {
    for (unsigned d = 0; d < samples_ && !violation(); ++d) {
      if (received_.contains(d)) continue;
      object(event(), end,
             fmt::format("Until {} nothing has brought participant 1 sample {} of the publications "
                         "of participant 0, although no packet has been lost for long.",
                         props::time_text(end), d + 1));
    }
  }

 private:
  const unsigned samples_;
  props::ReceivedSubmessages heard_;
  std::set<std::uint32_t> received_;
};

}  // namespace

props::MonitorPtr watch_lacking_samples(const Scope& scope) {
  return props::attentive<LackingSamples>(scope.descriptors);
}

model::Nanoseconds long_enough(const model::DdsProfile& dds) {
  const model::SedpProfile& sedp = dds.sedp;
  return (sedp.heartbeat_interval_max + sedp.auto_resched_nack_delay + sedp.nack_delay) * 3;
}

}  // namespace stormproof::explorer
