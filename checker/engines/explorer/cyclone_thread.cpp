// The event threads of Cyclone DDS's participants (model/cyclone/sender.cpp, if sending takes no
// time), what waits for them, and what is over after an event.
#include <algorithm>

#include "checker/engines/explorer/cyclone_messages.hpp"
#include "checker/engines/explorer/cyclone_packing.hpp"

namespace stormproof::explorer {
namespace {

constexpr bool carries_heartbeat(const Slot& slot) {
  return slot.what == What::heartbeat ||
         (slot.what == What::data && slot.has(Slot::carries_heartbeat));
}
/// Its count is compared with others of `kind`: HEARTBEATs, or ACKNACKs that are not pre-emptive.
constexpr bool is_counted(const Slot& slot, What kind) {
  if (kind == What::heartbeat) return carries_heartbeat(slot);
  return slot.what == What::acknack && !slot.has(Slot::initial);
}

}  // namespace

// Messages.

/// DATA is queued, an answer is kept, and the rest is what a timer gives to its thread.
bool CyclonePacking::leaves(const Slot& packet, RuleRunner& w) {
  Slot message = packet;
  if (message.what == What::data) {
    if (!message.has(Slot::to_set)) message.flags |= Slot::from_repair;
    enqueue(message, w);
  } else if (message.has(Slot::directed)) {
    w.state().set(kept_, message);
    *w.state().at(keeps_) = 1;
  } else {
    if (!works_) w.frame().overflow();  // a mistake that is not explored
    given_.push_back(message);
  }
  return true;
}
void CyclonePacking::enqueue(const Slot& message, RuleRunner& w) {
  Queue waiting = queue(w.state());
  if (waiting.count == most_queued) return w.frame().overflow();
  waiting.messages.at(waiting.count++) = message;
  w.state().set(queue_, waiting);
}
void CyclonePacking::let_answer_go(RuleRunner& w) {
  if (*w.state().at(keeps_) == 0) return;
  enqueue(w.state().get<Slot>(kept_), w);
  w.state().set(kept_, Slot{});
  *w.state().at(keeps_) = 0;
}

// The thread (model/cyclone/sender.cpp, if sending takes no time).

void CyclonePacking::work(RuleRunner& w) {
  model::cyclone::Packer packer{sedp()};
  works_ = true;
  while (true) {
    packer.open_held();
    if (!next_task(w)) {
      if (!packer.has_open()) break;
      send(packer.take_open(), w);
      continue;
    }
    while (!given_.empty() && !packer.is_complete()) {
      packer.add(message_of(given_.front()));
      given_.pop_front();
    }
    if (packer.is_complete()) send(packer.take_open(), w);
  }
  works_ = false;
  w.raise("ThreadSleeps", w.relation());
}
bool CyclonePacking::next_task(RuleRunner& w) {
  if (!given_.empty()) return true;
  const unsigned i = w.relation();
  if (std::uint8_t& listed = *w.state().at(listed_, i); listed > 0) {
    --listed;
    w.raise(i == 0 ? "HeartbeatTimerFires" : "AckTimerFires", 0);
    return true;
  }
  Queue waiting = queue(w.state());
  if (i != 0 || waiting.count == 0) return false;
  given_.push_back(waiting.messages.front());
  std::ranges::copy(waiting.messages.begin() + 1, waiting.messages.end(), waiting.messages.begin());
  waiting.messages.at(--waiting.count) = {};
  w.state().set(queue_, waiting);
  return true;
}
void CyclonePacking::send(const model::cyclone::Bundle& bundle, RuleRunner& w) {
  for (const model::Submessage& m : bundle.contents) {
    if (m.kind != model::Submessage::Kind::data) continue;
    const auto up_to = static_cast<Members>(member(m.sample + 1) - 1);
    w.state().set(sent_, static_cast<Members>(w.state().get<Members>(sent_) | up_to));
    w.note_generated(0, member(m.sample), !bundle.to.is_set);
  }
  const std::vector<Slot> parts = parts_of(bundle.contents);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k == 0) {
      w.frame().emit(parts[k]);
    } else {
      w.frame().emit_part(parts[k]);
    }
  }
}

// What is over.

void CyclonePacking::settle(RuleRunner& w) {
  Frame& frame = w.frame();
  for (unsigned k = frame.count(); k-- > 0;) {
    const What what = frame.slot(k).what;
    if (!is_mark(what) || what <= What::completed) continue;
    const std::int64_t end = what == What::last_heartbeat ? -interval(w.state()) : 0;
    if (frame.zone().bound(k + 1, 0) <= end) frame.erase(k);
  }
  keep_counts_small(w, What::heartbeat, counts_[0].first, counts_[0].second);
  keep_counts_small(w, What::acknack, counts_[1].first, counts_[1].second);
}
/// What is under way and `made`, the last count that was given, are numbered from 1; `last`, the
/// last one that was accepted, is only compared with them.
void CyclonePacking::keep_counts_small(RuleRunner& w, What kind, Kept made, Kept last) {
  WorldState& state = w.state();
  Frame& frame = w.frame();
  Queue waiting = queue(state);
  auto kept = state.get<Slot>(kept_);
  const bool is_kept = *state.at(keeps_) != 0;
  std::vector<std::int64_t> counts;
  if (state.get<std::int64_t>(made) > 0) counts.push_back(state.get<std::int64_t>(made));
  for (unsigned k = 0; k < frame.count(); ++k) {
    if (is_counted(frame.slot(k), kind)) counts.push_back(frame.slot(k).count);
  }
  for (const Slot& m : waiting.waiting()) {
    if (is_counted(m, kind)) counts.push_back(m.count);
  }
  if (is_kept && kind == What::heartbeat) counts.push_back(kept.count);
  std::ranges::sort(counts);
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  const auto small = [&](std::int64_t count) -> std::int64_t {
    return std::ranges::upper_bound(counts, count) - counts.begin();
  };
  const auto renew = [&](Slot& m) {
    if (is_counted(m, kind)) m.count = static_cast<std::uint16_t>(small(m.count));
  };
  state.set(made, small(state.get<std::int64_t>(made)));
  state.set(last, small(state.get<std::int64_t>(last)));
  for (unsigned k = 0; k < frame.count(); ++k) {
    Slot renewed = frame.slot(k);
    renew(renewed);
    frame.set_count(k, renewed.count);
  }
  for (Slot& m : waiting.waiting()) renew(m);
  if (is_kept) renew(kept);
  state.set(queue_, waiting);
  state.set(kept_, kept);
}

}  // namespace stormproof::explorer
