// Which of the model's channels two TAP devices and one program can be.
#include "tests/live/access_point/serving_profile.hpp"

#include "model/config/scenario_file.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::live {

namespace config = model::config;

std::optional<std::string> why_not_served(const model::WirelessProfile& wireless) {
  if (wireless.kind != model::ServiceKind::shared_channel) {
    return "kind: an access point serves a channel; expected shared_channel";
  }
  if (wireless.order == model::ServiceOrder::datagram_uplink) {
    return "order: an access point sees frames, not datagrams; expected fifo, fifo_uplink or "
           "fifo_downlink";
  }
  const bool by_unit = wireless.service == model::ServedBy::unit;
  if (!by_unit &&
      (wireless.stages.size() != 2 || wireless.stages[0].channel != wireless.stages[1].channel)) {
    return "stages: expected two on one channel, the uplink and the downlink";
  }
  if (!wireless.lost_packets.empty()) {
    return "lost_packets: an access point cannot number the packets of a live run; expected an "
           "empty list, and --loss for random losses";
  }
  if (wireless.loss) {
    return "loss: the access point repeats nothing; expected none, and --loss for random losses";
  }
  return std::nullopt;
}

std::vector<std::string> left_to_the_hosts(const model::WirelessProfile& wireless) {
  std::vector<std::string> remarks;
  if (wireless.fragment_request == model::FragmentRequest::sequential) {
    remarks.emplace_back(
        "fragment_request: sequential in the profile, but a kernel sends all "
        "fragments of a datagram at once (at_admission)");
  }
  if (wireless.source_queue_bytes != model::WirelessProfile::unlimited) {
    remarks.emplace_back(
        "source_queue_bytes: limited in the profile; the access point takes every "
        "frame that a kernel sends (see --station-queue-frames)");
  }
  return remarks;
}

config::Result<model::WirelessProfile> read_serving_profile(const std::string& reference,
                                                            std::vector<std::string> overrides,
                                                            const std::string& overhead) {
  if (!overhead.empty()) {
    if (const auto duration = config::parse_duration(overhead); !duration) {
      return config::InputError{"--overhead", duration.error()};
    }
    overrides.push_back("overhead_unicast=" + overhead);
    overrides.push_back("overhead_multicast=" + overhead);
  }
  auto wireless = config::read_wireless_profile(reference, overrides, config::SpecPath::standard());
  if (!wireless) return wireless;
  if (const auto reason = why_not_served(*wireless)) {
    return config::InputError{reference, *reason};
  }
  return wireless;
}

}  // namespace stormproof::live
