// How much of its piggyback budget a writer can have used up, at most, as the sender charges it
// (specs/guide/fastdds.md): a DATA with its own bytes; cumulative, and if it was asked for, with
// all bytes that the participant has sent for requests, each message once, and those of its own
// message until then. What went to the participant's own host is not in the capture; how much that
// can have been is bounded (same_host.hpp).
//
// With `piggyback: group` a participant counts the bytes of what it has sent for requests, its
// questions and answers about types among them, and a writer has used up what exceeds the
// threshold since it last looked: at its last DATA, with or without a HEARTBEAT. A message counts
// once it has left, so not for what rides in it. What it pushes makes it look anew, from the
// beginning.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "checker/evidence/conform/lookup_bytes.hpp"
#include "checker/evidence/conform/messages.hpp"
#include "checker/evidence/conform/same_host.hpp"
#include "checker/evidence/conform/sent_heartbeats.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::conform {

class PiggybackBudget {
 public:
  PiggybackBudget(const Dialogue& dialogue, const WriterRelations& writer,
                  const model::DdsProfile& dds, const Bounds& bounds);

  /// Charges the DATA that was sent before `event`; calls `sent_data` with the time of each.
  void charge_until(std::size_t event, const auto& sent_data) {
    while (message_ < messages_.size() && next_event() < event) {
      if (charge_next()) sent_data(*last_data_ns_);
    }
  }
  /// A HEARTBEAT of the writer was sent: the budget is full again. `surely_rides`: on its DATA, and
  /// for no other reason; of a group only these count.
  void refill(const SentHeartbeat& one, bool surely_rides);

  /// By captured DATA.
  [[nodiscard]] bool can_be_used_up(const SentHeartbeat& one) const;
  /// By that and so many DATA to the own host; nothing: there cannot have been so many.
  [[nodiscard]] std::optional<std::int64_t> needed_on_own_host(const SentHeartbeat& one) const;
  void suppose_on_own_host(std::int64_t data) { same_host_.suppose(stream_index(writer_), data); }

  [[nodiscard]] std::int64_t spent_before(const SentHeartbeat& one) const;
  /// When the writer last sent DATA.
  [[nodiscard]] std::optional<std::int64_t> last_data_ns() const { return last_data_ns_; }
  /// Whether it pushed it, because the endpoint had just been created.
  [[nodiscard]] bool last_data_is_pushed() const { return last_data_is_pushed_; }

 private:
  [[nodiscard]] std::size_t next_event() const { return messages_[message_].parts[part_].event; }
  /// Whether it is DATA of this writer.
  bool charge_next();
  void end_message(const Message& message);
  /// What a DATA that is asked for is charged for what was sent before its message, at most.
  [[nodiscard]] std::int64_t before_message() const;

  /// Of a group: the most that has been sent, and how often the threshold fits into what surely
  /// has, counted from 0 on.
  [[nodiscard]] std::int64_t most_in_group(std::size_t event) const;
  [[nodiscard]] std::int64_t least_number() const;
  void look_at_group(const Message& message);
  [[nodiscard]] std::int64_t number_before(std::int64_t time_ns) const;

  bool is_cumulative_;
  bool is_group_;
  std::int64_t threshold_;
  std::int64_t most_send_lag_ns_;
  capture::EntityId writer_;
  SameHost same_host_;
  LookupBytes lookups_;
  std::vector<Message> messages_;
  std::size_t message_ = 0;  ///< the next submessage to charge
  std::size_t part_ = 0;
  std::optional<std::int64_t> last_data_ns_;
  bool last_data_is_pushed_ = false;
  std::int64_t sent_bytes_ = 0;     ///< by the participant, for requests, at most
  std::int64_t surely_sent_ = 0;    ///< and at least
  std::int64_t message_bytes_ = 0;  ///< of the message so far
  std::int64_t message_spent_ = 0;  ///< what its DATA is charged
  std::int64_t spent_ = 0;
  std::uint32_t count_ = 0;  ///< of the HEARTBEAT that filled it last
  /// What was used up before a HEARTBEAT, by its count, if not all before it had been captured: one
  /// may have been kept waiting after it was made.
  std::map<std::uint32_t, std::int64_t> overtaking_;
  /// Of a group: numbers that the writer has surely seen, by when. They count for HEARTBEATs that
  /// were captured later by more than the send lag: those before may ride on the DATA at which it
  /// looked.
  std::map<std::int64_t, std::int64_t> numbers_;
};

}  // namespace stormproof::conform
