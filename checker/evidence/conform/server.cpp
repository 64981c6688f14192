// What the parts have in common, and what their verdict leaves open.
#include "checker/evidence/conform/server.hpp"

#include <algorithm>
#include <utility>

#include "checker/evidence/conform/server_relay.hpp"

namespace stormproof::conform::server {

model::DdsProfile of_announcements(model::DdsProfile dds) {
  dds.sedp.heartbeat_period = dds.server.pdp_heartbeat_period;
  dds.sedp.nack_response_delay = dds.server.pdp_nack_response_delay;
  dds.sedp.nack_suppression_duration = dds.server.pdp_nack_suppression_duration;
  dds.sedp.heartbeat_response_delay = dds.server.pdp_heartbeat_response_delay;
  return dds;
}

bool tells_of_server(const Context& context, const Submessage& sent) {
  const auto* data = context.dialogue.conversation.events[sent.event].data();
  if (!sent.descriptor || data == nullptr || data->endpoint || !data->participant) return false;
  const capture::Topology& topology = context.dialogue.conversation.topology;
  const capture::Participant* whose = topology.find(*data->participant);
  return whose != nullptr && topology.index_of(*whose) == context.dialogue.server;
}

std::optional<Unexplained> explain_relay(const Context& context, const WriterRelations& relay,
                                         Ledger& ledger) {
  const std::vector<Passed> passed = passed_by(relay);
  std::optional<Unexplained> first;
  for (auto fault : {explain_heartbeats(context, relay, passed, ledger),
                     explain_gaps(context, relay, passed, ledger),
                     check_changes(context, relay, passed, ledger)}) {
    if (fault && (!first || fault->event < first->event)) first = std::move(fault);
  }
  return first;
}

std::vector<std::string> assumptions(const Dialogue& dialogue) {
  std::vector<std::string> all{
      "HEARTBEATs, GAPs and announcements of a server and its clients are each explained by a "
      "cause "
      "that can have arrived and timers that can have fired; that one course of events explains "
      "all of them together is not decided, nor that the server passes on all that it has to"};
  if (dialogue.server && dialogue.has_neighbour[*dialogue.server]) {
    all.emplace_back(
        "clients on the server's host are in no capture between hosts: they can have armed its "
        "timers and made its routine run at any time");
  } else {
    all.emplace_back("on the server's host there is no client of which the server tells nobody");
  }
  return all;
}

}  // namespace stormproof::conform::server
