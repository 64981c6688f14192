// What happens to participants when, and who hears whom.
#include "model/cyclone/living_protocol.hpp"

namespace stormproof::model::cyclone {

void LivingProtocol::start() {
  for (Number i = 0; i < run_.topology.participant_count(); ++i) {
    const Nanoseconds begin = run_.scenario.deployment.participants[i].start;
    run_.schedule(begin, EventKind::participant_start, i);
    schedule_creations(run_, i, begin);
    Number k =
        topology().descriptor_count(i, Stream::pub) + topology().descriptor_count(i, Stream::sub);
    for (const Change& change : samples_.changes(i)) {
      run_.schedule(change.at, EventKind::endpoint_creation, i, k);
      ++k;
    }
  }
}

void LivingProtocol::handle(const Event& event) {
  if (event.kind == EventKind::endpoint_creation) return change(event.subject, event.detail);
  const Number actor = actor_of_timer(*this, event).value_or(event.subject);
  if (!has_timers(actor, event.kind)) return;
  Below::handle(event);
}

void LivingProtocol::received(const model::Packet& packet, Number receiver) {
  if (hears_packet(packet, receiver)) take_in(packet, receiver);
}

/// To a port where nobody is, which costs the channel nothing on the own host.
void LivingProtocol::send_copy(Number i, Number to) {
  if (to == group || !addresses().is_port(to)) return Below::send_copy(i, to);
  const auto& participants = run_.scenario.deployment.participants;
  const HostId host = addresses().host_of(to);
  if (host == participants[i].host) return;
  const auto somebody = std::ranges::find(participants, host, &model::Participant::host);
  model::Packet packet = packet_of(i, static_cast<Number>(somebody - participants.begin()));
  packet.to_nobody = true;
  sender_.emit(i, std::move(packet));
}

}  // namespace stormproof::model::cyclone
