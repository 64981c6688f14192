// Charges captured DATA against the piggyback budget.
#include "checker/evidence/conform/piggyback_budget.hpp"

#include <algorithm>

#include "checker/evidence/conform/requests.hpp"

namespace stormproof::conform {

PiggybackBudget::PiggybackBudget(const Dialogue& dialogue, const WriterRelations& writer,
                                 const model::SedpProfile& sedp)
    : is_cumulative_{sedp.piggyback == model::Piggyback::cumulative},
      threshold_{sedp.piggyback_threshold_bytes.count()} {
  for (const Relation& relation : dialogue.relations) {
    if (relation.place.source != writer.place().source) continue;
    collect(dialogue, relation, relation.place.writer == writer.place().writer);
  }
  std::sort(charges_.begin(), charges_.end(),
            [](const Charge& a, const Charge& b) { return a.event < b.event; });
}

void PiggybackBudget::collect(const Dialogue& dialogue, const Relation& relation, bool is_own) {
  const std::vector<Transmission> transmissions = transmissions_of(relation);
  auto next = transmissions.begin();
  std::optional<std::uint32_t> datagram;
  for (const Submessage& one : relation.sent) {
    const bool is_data = one.descriptor.has_value();
    Charge charge{one.event, one.time_ns,       one.datagram,
                  0,         is_own && is_data, is_data && (next++)->is_pushed};
    if (datagram != one.datagram) {
      charge.bytes = dialogue.conversation.datagrams[one.datagram].payload_bytes;
    }
    datagram = one.datagram;
    charges_.push_back(charge);
  }
}

bool PiggybackBudget::charge(const Charge& one) {
  sent_bytes_ += one.bytes;
  if (one.datagram != datagram_) datagram_spent_ = 0;
  datagram_ = one.datagram;
  if (one.bytes > 0) datagram_bytes_ = one.bytes;
  if (!one.is_own_data) return false;
  const std::int64_t bytes = is_cumulative_ ? sent_bytes_ : datagram_bytes_;
  spent_ += bytes;
  datagram_spent_ += bytes;
  last_data_ns_ = one.time_ns;
  last_data_is_pushed_ = one.is_pushed;
  return true;
}

bool PiggybackBudget::can_be_used_up(const SentHeartbeat& one) const {
  // A datagram may hold several HEARTBEATs, between or behind its DATA.
  return spent_ > threshold_ || (one.is_behind_data && datagram_spent_ > threshold_);
}

}  // namespace stormproof::conform
