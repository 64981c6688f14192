// Steps the reader's machines through what was chosen.
#include "checker/evidence/conform/reader_replay.hpp"

#include <algorithm>

namespace stormproof::conform {

namespace reader = fsm::discovery_reader;
namespace initial = fsm::initial_acknack;
namespace shot = fsm::single_shot;

std::int64_t ReaderReplay::open(std::int64_t now) {
  is_open_ = true;
  opened_ns_ = now;
  machines_.reader.step<reader::AnnouncementReceived>(state_, {.missing_after = missing()});
  const auto output = machines_.initial.step<initial::ReaderOpened>(
      initial_state_,
      {.now = now, .first_delay = sedp_.initial_acknack_delay.count(), .constant = is_constant()});
  ledger_.hidden(Hidden::Kind::recognised, now, std::nullopt);
  return output.next_delay;
}

std::int64_t ReaderReplay::attempt(const Answer& answer, std::int64_t delay) {
  const auto attempt = machines_.initial.step<initial::AttemptDue>(
      initial_state_, {.now = answer.time_ns,
                       .first_delay = sedp_.initial_acknack_delay.count(),
                       .last_delay = delay,
                       .heartbeat_seen = false,
                       .constant = is_constant()});
  const auto output = machines_.reader.step<reader::InitialAckNackDue>(state_, {});
  confirm(attempt.attempt && output.send_initial, Rule::acknack_initial);
  ledger_.hidden(Hidden::Kind::timer, answer.time_ns, answer.event, "InitialAckNack");
  return attempt.next_delay;
}

void ReaderReplay::reply(const Answer& answer, const Choice& choice) {
  fsm::StateId timer = Tally<fsm::SingleShot>::Fly::initial;
  std::int64_t due = answer.time_ns;
  std::int64_t now = last_reception_ns_;
  const auto arm = [&] {
    const auto output = timers_.step<shot::Requested>(
        timer, {.now = now, .delay = sedp_.heartbeat_response_delay.count()});
    if (output.schedule) due = output.next_at;
  };
  if (!choice.heartbeat_ns) {
    now = std::max(now, last_reply_ns_);
    arm();
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
    if (receive(message)) arm();
  }
  last_reception_ns_ = std::min(now, answer.time_ns);
  last_reply_ns_ = answer.time_ns;
  consumed_ = choice.end;
  const auto fired = timers_.step<shot::Due>(timer, {.now = due});
  const auto output = machines_.reader.step<reader::AckNackDue>(
      state_, {.accepts_unmatched = false, .missing_after = missing()});
  confirm(fired.fire && output.send_acknack && says(answer), Rule::acknack_reply);
  ledger_.used_lateness(answer.time_ns - due - bounds_.most_send_lag_ns);
}

void ReaderReplay::finish() {
  machines_.initial.step<initial::AttemptDue>(initial_state_, {.heartbeat_seen = true});
}

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

/// A submessage arrives at the reader's machine; whether it schedules an ACKNACK.
bool ReaderReplay::receive(const Submessage& message) {
  const bool accepted = knowledge_.take(message);
  const fsm::DiscoveryReaderIo::Input<fsm::Plain> input{.accepts_unmatched = false,
                                                        .missing_after = missing()};
  if (message.descriptor) machines_.reader.step<reader::DataReceived>(state_, input);
  if (!message.heartbeat || !accepted) return false;
  return machines_.reader.step<reader::HeartbeatReceived>(state_, input).schedule_acknack;
}

/// Whether the ACKNACK that the reader sends now is the captured one.
bool ReaderReplay::says(const Answer& answer) const {
  if (knowledge_.base() != answer.base) return false;
  const std::uint32_t end = std::min(knowledge_.announced, answer.base + bitmap_limit);
  for (std::uint32_t d = answer.base; d < end; ++d) {
    if (knowledge_.knows(d) == answer.asks_for(d)) return false;
  }
  return true;
}

bool ReaderReplay::is_constant() const {
  return sedp_.initial_acknack_interval == model::InitialAckNackInterval::constant;
}

/// How many of the writer's descriptors have not arrived.
std::int64_t ReaderReplay::missing() const {
  const std::size_t index = 2 * relation_.place.source + stream_index(relation_.place.writer);
  const auto known = std::count(knowledge_.has.begin(), knowledge_.has.end(), true);
  return static_cast<std::int64_t>(dialogue_.descriptors[index]) - known;
}

}  // namespace stormproof::conform
