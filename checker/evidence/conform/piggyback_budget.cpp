// Charges captured DATA against the piggyback budget.
#include "checker/evidence/conform/piggyback_budget.hpp"

#include <algorithm>
#include <iterator>

#include "model/fastdds/endpoints.hpp"

namespace stormproof::conform {

namespace fastdds = model::fastdds;

PiggybackBudget::PiggybackBudget(const Dialogue& dialogue, const WriterRelations& writer,
                                 const model::DdsProfile& dds, const Bounds& bounds)
    : is_cumulative_{dds.sedp.piggyback == model::Piggyback::cumulative},
      is_group_{dds.sedp.piggyback == model::Piggyback::group},
      threshold_{dds.sedp.piggyback_threshold_bytes.count()},
      most_send_lag_ns_{bounds.most_send_lag_ns},
      writer_{writer.place().writer},
      same_host_{dialogue, writer.place().source, dds, bounds},
      lookups_{dialogue, writer.place().source},
      messages_{messages_of(dialogue, writer.place().source, bounds)} {}

bool PiggybackBudget::charge_next() {
  const Message& message = messages_[message_];
  const MessagePart& part = message.parts[part_];
  if (part_ == 0) {
    message_bytes_ =
        fastdds::message_header_bytes + (message.is_named ? fastdds::destination_bytes : 0);
    message_spent_ = 0;
  }
  const bool is_own_data = part.descriptor && message.writer == writer_;
  const std::int64_t bytes = part.bytes + (part.descriptor ? fastdds::timestamp_bytes : 0);
  message_bytes_ += bytes;
  if (is_own_data) {
    const std::int64_t charge = is_cumulative_ && !message.is_pushed
                                    ? before_message() + message_bytes_
                                    : fastdds::message_header_bytes + bytes;
    spent_ += message.most * charge;
    message_spent_ += message.most * charge;
    last_data_ns_ = message.time_ns;
    last_data_is_pushed_ = message.is_pushed;
    if (is_group_) look_at_group(message);
  }
  if (!part.descriptor) {
    same_host_.heartbeat(stream_index(message.writer), part.count, surely_sent_);
  }
  if (++part_ == message.parts.size()) end_message(message);
  return is_own_data;
}

void PiggybackBudget::end_message(const Message& message) {
  if (!message.is_pushed) sent_bytes_ += message.most * message.payload_bytes;
  if (message.has_data() && !message.is_pushed && !message.may_be_copy) {
    surely_sent_ += is_group_ ? message.payload_bytes : message_bytes_;
  }
  ++message_;
  part_ = 0;
}

std::int64_t PiggybackBudget::before_message() const {
  return sent_bytes_ + same_host_.most_sent_bytes();
}

std::int64_t PiggybackBudget::most_in_group(std::size_t event) const {
  const auto of_lookups = lookups_.most_before(event);
  if (!of_lookups) return INT64_MAX;
  return before_message() + *of_lookups;
}

std::int64_t PiggybackBudget::least_number() const {
  return std::max<std::int64_t>(surely_sent_ - 1, 0) / threshold_;
}

void PiggybackBudget::look_at_group(const Message& message) {
  if (message.is_pushed) {
    numbers_.clear();
    return;
  }
  std::int64_t& number = numbers_[message.time_ns];
  number = std::max(number, least_number());
}

std::int64_t PiggybackBudget::number_before(std::int64_t time_ns) const {
  std::int64_t number = 0;
  for (const auto& [since_ns, seen] : numbers_) {
    if (since_ns < time_ns - most_send_lag_ns_) number = std::max(number, seen);
  }
  return number;
}

void PiggybackBudget::refill(const SentHeartbeat& one, bool surely_rides) {
  if (is_group_) {
    if (!surely_rides || last_data_is_pushed_) return;
    // The next one needs another number.
    std::int64_t& number = numbers_[one.time_ns - most_send_lag_ns_];
    number = std::max(number, number_before(one.time_ns) + 1);
    return;
  }
  const std::uint32_t count = one.heartbeat.count;
  if (const auto later = overtaking_.upper_bound(count); later != overtaking_.end()) {
    later->second = 0;
    return;
  }
  if (count > count_ + 1) overtaking_[count] = spent_;
  count_ = count;
  // DATA behind it in its message is charged anew.
  spent_ = one.is_behind_data ? message_spent_ : 0;
}

std::int64_t PiggybackBudget::spent_before(const SentHeartbeat& one) const {
  if (is_group_) {
    const std::int64_t most = most_in_group(one.event);
    if (most == INT64_MAX) return most;
    return most - number_before(one.time_ns) * threshold_;
  }
  const auto later = overtaking_.upper_bound(one.heartbeat.count);
  return spent_ + (later == overtaking_.end() ? 0 : later->second);
}

bool PiggybackBudget::can_be_used_up(const SentHeartbeat& one) const {
  // A datagram may hold several HEARTBEATs, between or behind its DATA.
  return spent_before(one) > threshold_ || (one.is_behind_data && message_spent_ > threshold_);
}

std::optional<std::int64_t> PiggybackBudget::needed_on_own_host(const SentHeartbeat& one) const {
  return same_host_.needed(stream_index(writer_), one.heartbeat.count, one.time_ns,
                           threshold_ - spent_before(one), is_cumulative_ ? before_message() : 0);
}

}  // namespace stormproof::conform
