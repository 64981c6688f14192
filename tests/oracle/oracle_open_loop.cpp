// The open-loop baseline: the airtime of everything that a discovery has to send once, whatever the
// order and without any feedback. A closed-loop run is compared with it to say how much the
// feedback costs.
#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

// The ACKNACK of the baseline: one word of bitmap on top of an empty one.
constexpr std::int64_t bitmap_word = 4;

Time packet_airtime(const model::WirelessProfile& wireless, bool multicast, std::int64_t payload) {
  Time sum = 0;
  for (std::size_t stage = 0; stage < wireless.stages.size(); ++stage) {
    for (const std::int64_t bytes : cut_into_fragments(wireless, payload)) {
      sum += airtime(wireless, stage, multicast, bytes);
    }
  }
  return sum;
}

// The payloads of the packets that carry all descriptors of one relation.
std::vector<std::int64_t> data_payloads(const model::Scenario& scenario, Id i, int s) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  const bool alone = sedp.grouping == model::Grouping::single;
  std::vector<std::int64_t> payloads;
  for (Id d = 0; d < descriptor_count(scenario, i, s); ++d) {
    const std::int64_t z = descriptor_bytes(scenario, s, d);
    const std::int64_t more = z - sedp.shared_header_bytes.count();
    if (payloads.empty() || alone || payloads.back() + more > grouping_limit(sedp)) {
      payloads.push_back(z);
    } else {
      payloads.back() += more;
    }
  }
  return payloads;
}

Time relation_airtime(const model::Scenario& scenario, Id i, int s) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  Time sum = packet_airtime(scenario.wireless, false, sedp.heartbeat_bytes.count()) +
             packet_airtime(scenario.wireless, false, sedp.acknack_bytes.count() + bitmap_word);
  for (const std::int64_t payload : data_payloads(scenario, i, s)) {
    sum += packet_airtime(scenario.wireless, false, payload);
  }
  return sum;
}

Time announcement_airtime(const model::Scenario& scenario, std::int64_t peers) {
  const std::int64_t payload = scenario.dds.spdp.payload_bytes.count();
  return (1 + peers) * packet_airtime(scenario.wireless, true, payload) +
         peers * (peers + 1) / 2 * packet_airtime(scenario.wireless, false, payload);
}

}  // namespace

std::int64_t open_loop_ns(const model::Scenario& scenario) {
  const std::vector<model::Participant>& participants = scenario.deployment.participants;
  Time sum = 0;
  for (Id i = 0; i < participants.size(); ++i) {
    std::int64_t peers = 0;
    for (const model::Participant& other : participants) {
      if (other.host != participants.at(i).host) ++peers;
    }
    sum += announcement_airtime(scenario, peers);
    for (int s = 0; s < 2; ++s) sum += peers * relation_airtime(scenario, i, s);
  }
  return sum;
}

}  // namespace stormproof::oracle
