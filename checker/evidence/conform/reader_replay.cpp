// Runs the reader's rules through what was chosen.
#include "checker/evidence/conform/reader_replay.hpp"

#include <algorithm>

#include "checker/evidence/conform/learner_host.hpp"
#include "checker/evidence/conform/reader_host.hpp"

namespace stormproof::conform {

namespace {

std::unique_ptr<ReplayedReader> host_of(RelationKind kind, const model::DdsProfile& dds,
                                        std::uint32_t count, Machines& machines) {
  switch (kind) {
    case RelationKind::registration:
      return std::make_unique<ReaderHost<OfRegistration>>(dds, count, machines);
    case RelationKind::relay:
      return std::make_unique<ReaderHost<OfRelay>>(dds, count, machines);
    case RelationKind::descriptors:
      break;
  }
  return std::make_unique<ReaderHost<OfDescriptors>>(dds, count, machines);
}

}  // namespace

ReaderReplay::ReaderReplay(const Context& context, const Relation& relation, Ledger& ledger)
    : relation_{relation},
      bounds_{context.bounds},
      ledger_{ledger},
      host_{host_of(kind_of(context.dialogue, relation.place), context.dds,
                    descriptors_of(context.dialogue, relation.place), ledger.machines)} {}

std::int64_t ReaderReplay::open(std::int64_t now) {
  is_open_ = true;
  opened_ns_ = now;
  host_->open(now);
  ledger_.hidden(Hidden::Kind::recognised, now, std::nullopt);
  return host_->take_initial_delay().value_or(0);
}

std::int64_t ReaderReplay::attempt(const Answer& answer) {
  const auto said = host_->attempt(answer.time_ns);
  confirm(said && said->is_initial, host_->explained_by().initial);
  ledger_.hidden(Hidden::Kind::timer, answer.time_ns, answer.event, "InitialAckNack");
  return host_->take_initial_delay().value_or(0);
}

void ReaderReplay::reply(const Answer& answer, const Choice& choice) {
  std::int64_t now = last_reception_ns_;
  if (!choice.heartbeat_ns) {
    now = std::max(now, last_reply_ns_);
    host_->ask_again(now);
  }
  for (std::size_t k = 0; k < choice.arrivals.arrived.size(); ++k) {
    const Submessage& message = relation_.sent[consumed_ + k];
    now = std::max(now, message.time_ns + bounds_.least_delay_ns);
    if (!choice.arrivals.arrived[k]) {
      miss(message);
      continue;
    }
    if (choice.heartbeat_ns && choice.arrivals.heartbeat == k) {
      now = std::max(now, *choice.heartbeat_ns);
    }
    ledger_.hidden(Hidden::Kind::received, now, message.event);
    receive(message, now);
  }
  last_reception_ns_ = std::min(now, answer.time_ns);
  last_reply_ns_ = answer.time_ns;
  consumed_ = choice.end;
  const std::int64_t due = host_->take_reply_due().value_or(answer.time_ns);
  const auto said = host_->reply(due);
  confirm(is_captured(said, answer), host_->explained_by().reply);
  ledger_.used_lateness(answer.time_ns - due - bounds_.most_send_lag_ns);
}

void ReaderReplay::finish() { host_->attempt(last_reception_ns_); }

void ReaderReplay::confirm(bool replayed, Rule rule) {
  replayed ? ledger_.explained(rule) : ledger_.not_replayed();
}

/// A datagram is lost, or was there before the reader side opened.
void ReaderReplay::miss(const Submessage& message) {
  if (missed_ == message.datagram) return;
  missed_ = message.datagram;
  const bool before = message.time_ns + bounds_.least_delay_ns <= opened_ns_;
  ledger_.hidden(before ? Hidden::Kind::dropped : Hidden::Kind::lost, message.time_ns,
                 message.event);
}

/// A submessage arrives at the open reader.
void ReaderReplay::receive(const Submessage& message, std::int64_t now) {
  const bool accepted = knowledge_.take(message);
  if (!message.heartbeat || accepted) host_->receive(message, now);
}

/// Whether the rules send the captured ACKNACK; a packet lists no more than its bitmap can.
bool ReaderReplay::is_captured(const std::optional<MadeAckNack>& said, const Answer& answer) const {
  if (!said || said->is_initial || said->base != answer.base) return false;
  const std::uint32_t end = std::min(knowledge_.announced, answer.base + bitmap_limit);
  for (std::uint32_t d = answer.base; d < end; ++d) {
    const bool listed = (said->listed.word(d / 64) >> d % 64 & 1) != 0;
    if (listed != answer.asks_for(d)) return false;
  }
  return true;
}

}  // namespace stormproof::conform
