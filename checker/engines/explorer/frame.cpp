// Scheduling, emission and the order of events in a frame.
#include "checker/engines/explorer/frame.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

namespace stormproof::explorer {

EventRules::EventRules(std::span<const model::EventMutation> mutations, bool receives_separately) {
  for (std::size_t k = 0; k < rules.size(); ++k) {
    const auto what = static_cast<What>(k);
    if (is_mark(what)) continue;
    const model::EventKind kind = kind_of(what, receives_separately);
    rules[k].event_class = model::class_of(kind);
    for (const model::EventMutation& mutation : mutations) {
      if (mutation.kind != kind) continue;
      switch (mutation.change) {
        case model::EventMutation::Change::forget:
          rules[k].copies = 0;
          break;
        case model::EventMutation::Change::shift:
          rules[k].shift += mutation.by.count();
          break;
        case model::EventMutation::Change::duplicate:
          if (rules[k].copies > 0) ++rules[k].copies;
          break;
        case model::EventMutation::Change::reclass:
          rules[k].event_class = mutation.event_class;
          break;
      }
    }
  }
}

/// Of two events at the same time the one of lower rank comes first: class, then insertion.
std::uint64_t Frame::rank(unsigned k) const {
  return static_cast<std::uint64_t>(rules_->of(slots_[k].what).event_class) << 32 | k;
}

Zone::Limits Frame::limits(unsigned k) const {
  Zone::Limits limits;
  limits.fill(Zone::free);
  const std::uint64_t own = rank(k);
  for (unsigned f = 0; f < count(); ++f) {
    if (!is_mark(slots_[f].what)) limits[f + 1] = own < rank(f) ? 0 : -1;
  }
  return limits;
}

bool Frame::can_be_next(unsigned k) const { return zone_.can_be_next(k + 1, limits(k)); }

Slot Frame::advance(unsigned k, unsigned loss_mask, unsigned choices) {
  const Slot slot = slots_[k];
  const Zone::Limits order = limits(k);
  if (log_ != nullptr) {
    for (unsigned f = 0; f < count(); ++f) {
      if (f != k && order[f + 1] != Zone::free) {
        log_->constraints.push_back({ids_[k], ids_[f], order[f + 1]});
      }
    }
    log_->fired.push_back({slot, ids_[k]});
  }
  now_id_ = ids_[k];
  zone_.advance(k + 1, order);
  const unsigned left = count();
  for (unsigned f = k; f < left; ++f) {
    slots_[f] = slots_[f + 1];
    ids_[f] = ids_[f + 1];
  }
  loss_mask_ = loss_mask;
  choices_ = choices;
  chosen_ = 0;
  emitted_ = 0;
  generated_ = 0;
  objections_ = 0;
  losses_left_ -= static_cast<unsigned>(std::popcount(loss_mask));
  return slot;
}

bool Frame::holds(unsigned a, unsigned b, std::int64_t c) {
  constexpr unsigned most = 8;  // bits of a label
  if (!zone_.admits(a, b, c)) return false;
  if (!zone_.admits(b, a, -c - 1)) return true;
  if (chosen_ == most) overflowed_ = true;
  const bool holds = chosen_ >= most || (choices_ >> chosen_++ & 1) == 0;
  const Constraint known = holds ? Constraint{a, b, c} : Constraint{b, a, -c - 1};
  zone_.constrain(known.a, known.b, known.c);
  if (log_ != nullptr) log_->constraints.push_back({id_of(known.a), id_of(known.b), known.c});
  return holds;
}

unsigned Frame::append(Slot slot, std::int64_t low, std::int64_t high) {
  const unsigned k = count();
  zone_.add(low, high);
  slots_[k] = slot;
  if (log_ != nullptr) {
    ids_[k] = log_->variables++;
    log_->scheduled.push_back({slot, ids_[k]});
    log_->constraints.push_back({ids_[k], now_id_, high});
    log_->constraints.push_back({now_id_, ids_[k], -low});
  }
  return k;
}

void Frame::relate(unsigned a, unsigned b, std::int64_t c) {
  zone_.constrain(a + 1, b + 1, c);
  if (log_ != nullptr) log_->constraints.push_back({ids_[a], ids_[b], c});
}

void Frame::schedule_between(Slot slot, std::int64_t low, std::int64_t high) {
  const EventRules::Rule& rule = rules_->of(slot.what);
  for (unsigned copy = 0; copy < rule.copies; ++copy) {
    if (count() == capacity) {
      overflowed_ = true;
      return;
    }
    // Whatever the mistake, the clock does not run backwards.
    append(slot, std::max<std::int64_t>(0, low + rule.shift),
           std::max<std::int64_t>(0, high + rule.shift));
  }
}

void Frame::schedule_with(Slot slot, unsigned k) {
  const unsigned before = count();
  const std::int64_t shift = rules_->of(slot.what).shift;
  schedule_between(slot, -zone_.bound(0, k + 1), zone_.bound(k + 1, 0));
  for (unsigned copy = before; copy < count(); ++copy) {
    relate(copy, k, shift);
    relate(k, copy, -shift);
  }
}

void Frame::emit(Slot packet) {
  const bool lost = (loss_mask_ >> emitted_++ & 1) != 0;
  const unsigned before = count();
  const bool leaves_later = packet.has(Slot::from_repair);
  if (leaves_later) {
    Slot completion = packet;
    completion.what = What::source_completion;
    schedule_between(completion, 0, scope_->leaves_within.count());
    for (unsigned k = 0; k < before && count() > before; ++k) {
      if (slots_[k].what == What::source_completion) relate(k, before, 0);
    }
  }
  const unsigned arrival = count();
  if (!lost) {
    schedule_between(packet, scope_->least_delay.count(), scope_->largest_delay.count());
    if (arrival > before && count() > arrival) relate(before, arrival, 0);
    for (unsigned k = 0; scope_->fifo && count() > arrival && k < before; ++k) {
      if (!is_packet(slots_[k].what)) continue;
      if (have_one_source(slots_[k], packet, scope_->writers)) relate(k, arrival, 0);
    }
  }
  arrival_ = count() > arrival ? arrival : capacity;
  if (log_ == nullptr) return;
  PathLog::Emission emission{packet, now_id_, PathLog::none, PathLog::none};
  if (arrival > before) emission.left_source = ids_[before];
  if (count() > arrival) emission.received = ids_[arrival];
  log_->emissions.push_back(emission);
}

void Frame::emit_part(Slot part) {
  const unsigned before = count();
  if (arrival_ != capacity) {
    schedule_between(part, -zone_.bound(0, arrival_ + 1), zone_.bound(arrival_ + 1, 0));
  }
  if (count() > before) {
    relate(before, arrival_, 0);
    relate(arrival_, before, 0);
  }
  if (log_ == nullptr) return;
  PathLog::Emission emission{part, now_id_, PathLog::none, PathLog::none};
  if (count() > before) emission.received = ids_[before];
  log_->emissions.push_back(emission);
}

/// Of slots k and k + 1: whether the second comes first in the order that `sort` makes.
bool Frame::belong_the_other_way(unsigned k) const {
  const Slot& a = slots_[k];
  const Slot& b = slots_[k + 1];
  if (is_mark(a.what) || is_mark(b.what)) {
    const auto key = [](const Slot& slot) {
      return is_mark(slot.what) ? std::tuple{slot.what, slot.relation, slot.set}
                                : std::tuple{What{}, std::uint8_t{}, std::uint16_t{}};
    };
    return key(b) < key(a);
  }
  const auto first = rules_->of(a.what).event_class;
  const auto second = rules_->of(b.what).event_class;
  return first != second ? second < first : zone_.bound(k + 2, k + 1) < 0;
}

void Frame::sort() {
  for (unsigned end = 1; end < count(); ++end) {
    for (unsigned k = end; k-- > 0 && belong_the_other_way(k);) {
      std::swap(slots_[k], slots_[k + 1]);
      std::swap(ids_[k], ids_[k + 1]);
      zone_.exchange(k + 1, k + 2);
    }
  }
}

void Frame::mark(Slot slot, std::int64_t delay) {
  if (count() == capacity) {
    overflowed_ = true;
    return;
  }
  const unsigned k = count();
  zone_.add(delay, delay);
  slots_[k] = slot;
  ids_[k] = now_id_;
  if (log_ == nullptr || delay == 0) return;
  ids_[k] = log_->variables++;
  log_->constraints.push_back({ids_[k], now_id_, delay});
  log_->constraints.push_back({now_id_, ids_[k], -delay});
}

void Frame::erase(unsigned k) {
  zone_.remove(k + 1);
  for (unsigned f = k; f < count(); ++f) {
    slots_[f] = slots_[f + 1];
    ids_[f] = ids_[f + 1];
  }
}

void Frame::erase_marks(What what, std::uint16_t set, unsigned relation) {
  for (unsigned k = count(); k-- > 0;) {
    const Slot& slot = slots_[k];
    if (slot.what == what && slot.relation == relation && (slot.set & ~set) == 0) erase(k);
  }
}

unsigned Frame::find(What what, std::uint16_t set, unsigned relation) const {
  for (unsigned k = 0; k < count(); ++k) {
    const Slot& slot = slots_[k];
    if (slot.what == what && slot.set == set && slot.relation == relation) return k;
  }
  return count();
}

unsigned Frame::pending(What what, unsigned relation) const {
  unsigned found = 0;
  for (unsigned k = 0; k < count(); ++k) {
    found += slots_[k].what == what && slots_[k].relation == relation ? 1U : 0U;
  }
  return found;
}

bool Frame::any_pending() const {
  for (unsigned k = 0; k < count(); ++k) {
    if (!is_mark(slots_[k].what)) return true;
  }
  return false;
}

void Frame::object_if(Claim claim, unsigned a, unsigned b, std::int64_t c) {
  if (!zone_.admits(a, b, c)) return;
  if (log_ != nullptr && (kept_ & bit(claim)) != 0 && (objections_ & bit(claim)) == 0) {
    log_->constraints.push_back({id_of(a), id_of(b), c});
    zone_.constrain(a, b, c);
  }
  objections_ = static_cast<Claims>(objections_ | bit(claim));
}

}  // namespace stormproof::explorer
