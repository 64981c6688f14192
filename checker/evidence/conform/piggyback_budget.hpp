// How much of its piggyback budget a writer can have used up, at most: what captured DATA is
// charged. A capture does not show which DATA went the asynchronous way, nor how bytes were grouped
// when they were charged, so the sum is never less than the writer's. Rule: cumulative charges each
// DATA with all bytes that its participant has ever sent, linear with its own message.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "checker/evidence/conform/sent_heartbeats.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::conform {

class PiggybackBudget {
 public:
  PiggybackBudget(const Dialogue& dialogue, const WriterRelations& writer,
                  const model::SedpProfile& sedp);

  /// Charges the DATA that was sent before `event`; calls `sent_data` with the time of each.
  void charge_until(std::size_t event, const auto& sent_data) {
    for (; charged_ < charges_.size() && charges_[charged_].event < event; ++charged_) {
      if (charge(charges_[charged_])) sent_data(charges_[charged_].time_ns);
    }
  }
  /// A HEARTBEAT of the writer was sent: the budget is full again.
  void refill(const SentHeartbeat& one) {
    // DATA behind it in its message is charged anew.
    spent_ = one.is_behind_data ? datagram_spent_ : 0;
  }

  [[nodiscard]] bool can_be_used_up(const SentHeartbeat& one) const;
  [[nodiscard]] std::int64_t spent() const { return spent_; }
  /// When the writer last sent DATA.
  [[nodiscard]] std::optional<std::int64_t> last_data_ns() const { return last_data_ns_; }
  /// Whether it pushed it, because the endpoint had just been created.
  [[nodiscard]] bool last_data_is_pushed() const { return last_data_is_pushed_; }

 private:
  /// A submessage of one of the participant's SEDP writers.
  struct Charge {
    std::size_t event = 0;
    std::int64_t time_ns = 0;
    std::uint32_t datagram = 0;
    std::int64_t bytes = 0;    ///< UDP payload, if it is the first of its datagram
    bool is_own_data = false;  ///< DATA of this writer
    bool is_pushed = false;    ///< which nobody asked for
  };

  void collect(const Dialogue& dialogue, const Relation& relation, bool is_own);
  /// Whether it is DATA of this writer.
  bool charge(const Charge& one);

  bool is_cumulative_;
  std::int64_t threshold_;
  std::vector<Charge> charges_;  ///< in order
  std::size_t charged_ = 0;
  std::optional<std::int64_t> last_data_ns_;
  bool last_data_is_pushed_ = false;
  std::int64_t sent_bytes_ = 0;            ///< by the participant
  std::optional<std::uint32_t> datagram_;  ///< that was sent last
  std::int64_t datagram_bytes_ = 0;        ///< its payload
  std::int64_t datagram_spent_ = 0;        ///< what its DATA is charged
  std::int64_t spent_ = 0;
};

}  // namespace stormproof::conform
