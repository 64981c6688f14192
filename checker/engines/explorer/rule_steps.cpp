// Steps: conditions, loops and effects on the state and the frame.
#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

#include "checker/engines/explorer/rule_runner.hpp"

namespace stormproof::explorer {

using Act = Specialised::Act;
using From = Specialised::From;

void RuleRunner::take(const Step& step) {
  ++step_;
  switch (step.act) {
    case Act::let:
    case Act::decide:
      registers_[step.reg] = number(step.value);
      break;
    case Act::when:
      if (truth(step.value)) run(step.body);
      break;
    case Act::reverse:
      relation_ ^= 1U;
      run(step.body);
      relation_ ^= 1U;
      break;
    case Act::for_readers:
      return for_readers(step);
    case Act::for_descriptors:
      return for_descriptors(step);
    case Act::for_queue:
      return for_queue(step);
    case Act::feed:
      return feed(step, *state_->at(step.kept, relation_));
    case Act::feed_one:
      return feed(step, state_->at(step.kept, relation_)[descriptor_]);
    case Act::feed_each:
      return feed_each(step);
    case Act::set_truth:
      state_->set(step.kept, static_cast<std::uint8_t>(truth(step.value)), relation_);
      break;
    case Act::set_number:
      if (const std::int64_t value = number(step.value); value <= step.most) {
        state_->set(step.kept, value, relation_);
      }
      break;
    case Act::set_member: {
      const unsigned others = get(step.kept) & ~unsigned{member(descriptor_)};
      set(step.kept, truth(step.value) ? others | member(descriptor_) : others);
      break;
    }
    case Act::set_each:
      return set_each(step);
    case Act::set_host:
      host_.set(step.reg, number(step.value), *this);
      break;
    case Act::ask:
      set(remembered_.asked, get(remembered_.asked) | unsigned{packet_->set});
      break;
    case Act::overflow:
      frame_->overflow();
      break;
    case Act::come: {
      const auto scheduled = state_->get<std::uint8_t>(step.kept, relation_);
      const unsigned left = scheduled == 0 ? 0U : scheduled - 1U;  // 0: it was scheduled twice
      state_->set(step.kept, static_cast<std::uint8_t>(left), relation_);
      break;
    }
    case Act::schedule:
      return schedule(step);
    case Act::emit:
      return emit(step);
    case Act::hear:
      return hear(step);
    case Act::perform:
      return perform(step);
    case Act::defer:
      deferred_.emplace(Deferred{step.body, relation_, descriptor_, registers_});
      break;
    case Act::go_on:
      return go_on();
  }
}

void RuleRunner::go_on() {
  if (!deferred_) return;
  Deferred deferred = *std::exchange(deferred_, std::nullopt);
  const unsigned relation = std::exchange(relation_, deferred.relation);
  const unsigned descriptor = std::exchange(descriptor_, deferred.descriptor);
  std::swap(registers_, deferred.registers);
  run(deferred.effect);
  std::swap(registers_, deferred.registers);
  descriptor_ = descriptor;
  relation_ = relation;
}

// Loops.

void RuleRunner::for_readers(const Step& step) {
  const unsigned here = relation_;
  for (Lanes left = open_readers(); left != 0; left &= left - 1) {
    relation_ = here % writers_ + static_cast<unsigned>(std::countr_zero(left)) * writers_;
    run(step.body);
    if (step.first_only) break;
  }
  relation_ = here;
}
/// Ascending, those for which the term holds then.
void RuleRunner::for_descriptors(const Step& step) {
  const unsigned here = descriptor_;
  Lanes from = ~Lanes{0};
  while (const Lanes left = members(step.value) & from) {
    descriptor_ = static_cast<unsigned>(std::countr_zero(left));
    from = ~Lanes{1} << descriptor_;
    run(step.body);
    if (step.first_only) break;
  }
  descriptor_ = here;
}
/// With one relation everything in the queue is sent at once, with several first in, first out.
void RuleRunner::for_queue(const Step& step) {
  const unsigned relation = relation_;
  const unsigned here = descriptor_;
  bool is_first = true;
  const auto visit = [&](unsigned writer, unsigned d) {
    relation_ = writer;
    descriptor_ = d;
    if (std::exchange(is_first, false) || !step.first_only) run(step.body);
  };
  if (remembered_.queue.is_kept()) {
    std::uint8_t* const queue = state_->at(remembered_.queue);
    const unsigned most = queue_capacity();
    while (const unsigned entry = *queue) {
      std::copy(queue + 1, queue + most, queue);
      queue[most - 1] = 0;
      visit((entry - 1) / descriptors_[0], (entry - 1) % descriptors_[0]);
    }
  } else {
    relation_ = 0;
    for (unsigned left = get(remembered_.queued); left != 0; left &= left - 1) {
      visit(0, static_cast<unsigned>(std::countr_zero(left)));
    }
  }
  descriptor_ = here;
  relation_ = relation;
}

// Machines.

void RuleRunner::feed(const Step& step, std::uint8_t& state) {
  for (const Specialised::Register field : step.outbox) registers_[field] = 0;
  for (const Specialised::Row& row : step.rows) {
    if (row.source != state || !truth(row.guard)) continue;
    for (const auto& [field, value] : row.out) registers_[field] = number(value);
    state = row.target;
    return;
  }
}
void RuleRunner::feed_each(const Step& step) {
  for (const Specialised::Register field : step.outbox) registers_[field] = 0;
  Lanes left = members(step.value);
  if (left == 0) return;
  if (step.asked != Specialised::no_term) {
    const auto listed = static_cast<Members>(lanes(step.asked) & left);
    object_to_taken(*frame_, listed, *emitted_);
    set(remembered_.asked, get(remembered_.asked) | unsigned{listed});
  }
  std::uint8_t* const states = state_->at(step.kept, relation_);
  std::array<std::uint8_t, std::numeric_limits<Members>::digits> after{};
  Lanes moved = 0;
  for (const Specialised::Row& row : step.rows) {
    Lanes fires = 0;
    for (Lanes each = left; each != 0; each &= each - 1) {
      if (states[std::countr_zero(each)] == row.source) fires |= each & -each;
    }
    if (fires == 0) continue;
    fires &= lanes(row.guard);
    for (const auto& [field, value] : row.out) {
      registers_[field] |= static_cast<std::int64_t>(fires & lanes(value));
    }
    for (Lanes each = fires; each != 0; each &= each - 1) {
      after.at(static_cast<std::size_t>(std::countr_zero(each))) = row.target;
    }
    moved |= fires;
    left &= ~fires;
  }
  for (; moved != 0; moved &= moved - 1) {
    const int d = std::countr_zero(moved);
    states[d] = after.at(static_cast<std::size_t>(d));
  }
}
void RuleRunner::hear(const Step& step) {
  const auto limit =
      step.event == What::data ? std::bit_width(emitted_->set) : static_cast<int>(emitted_->number);
  const unsigned heard = member(static_cast<unsigned>(limit)) - 1U;
  state_->set(
      remembered_.announced,
      static_cast<Members>(state_->get<Members>(remembered_.announced, emitted_->relation) | heard),
      emitted_->relation);
}

// State, timers and packets.

/// What joins the queue joins its end, ascending, unless it is in it.
void RuleRunner::set_each(const Step& step) {
  const Members those = members(step.value);
  if (step.kept == remembered_.queued && remembered_.queue.is_kept()) {
    std::uint8_t* end = state_->at(remembered_.queue);
    while (*end != 0) ++end;
    for (unsigned fresh = those & ~unsigned{get(step.kept)}; fresh != 0; fresh &= fresh - 1) {
      const auto d = static_cast<unsigned>(std::countr_zero(fresh));
      *end++ = static_cast<std::uint8_t>(writer() * descriptors_[0] + d + 1);
    }
  }
  set(step.kept, those);
}
void RuleRunner::schedule(const Step& step) {
  if (step.kept.is_kept()) {
    const auto scheduled = state_->get<std::uint8_t>(step.kept, relation_);
    state_->set(step.kept, static_cast<std::uint8_t>(scheduled + 1), relation_);
  }
  Slot slot{step.event};
  const auto place = static_cast<std::uint8_t>(step.each ? relation_ : 0);
  (host_.has_two_ends() ? slot.number : slot.relation) = place;
  const std::int64_t time = number(step.value);
  if (!host_.moves(slot, time, *this)) frame_->schedule(slot, time);
}
void RuleRunner::emit(const Step& step) {
  Slot packet{step.event};
  packet.relation = static_cast<std::uint8_t>(relation_);
  for (const Specialised::Says& says : step.says) {
    switch (says.as) {
      case From::flag:
        if (truth(says.value)) packet.flags |= says.flag;
        break;
      case From::count:
        packet.count = static_cast<std::uint16_t>(number(says.value));
        break;
      case From::limit:
        packet.number = static_cast<std::uint8_t>(std::bit_width(members(says.value)));
        break;
      default:
        packet.set = members(says.value);
        break;
    }
  }
  if (kept_back_ != nullptr) {
    kept_back_->push_back(packet);
  } else {
    sent(packet);
  }
}
void RuleRunner::sent(const Slot& packet) {
  if (host_.leaves(packet, *this)) return;
  if (packet.what == What::data) {
    note_generated(packet.relation, packet.set, packet.has(Slot::from_repair));
  } else if (packet.what == What::acknack) {
    std::optional<Members> announced;
    if (remembered_.announced.is_kept()) announced = get(remembered_.announced);
    object_to_listed(*frame_, packet, get(remembered_.received), descriptors(relation_), announced);
  }
  send(packet);
}
void RuleRunner::note_generated(unsigned relation, Members these, bool is_repair) {
  const auto asked = state_->get<Members>(remembered_.asked, relation);
  const auto generated = state_->get<Members>(remembered_.generated, relation);
  object_to_generated(*frame_, these, is_repair, asked, generated);
  state_->set(remembered_.generated, static_cast<Members>(generated | these), relation);
  state_->set(remembered_.asked, static_cast<Members>(asked & ~unsigned{these}), relation);
}
void RuleRunner::perform(const Step& step) {
  Specialised::Call call{.contract = step.body};
  for (std::size_t k = 0; k < step.with.size(); ++k) call.arguments.at(k) = number(step.with[k]);
  step.action(*this, call);
}

}  // namespace stormproof::explorer
