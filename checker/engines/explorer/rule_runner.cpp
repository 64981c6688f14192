// Terms, and what packings ask for.
#include "checker/engines/explorer/rule_runner.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "checker/engines/explorer/slot_fields.hpp"
#include "fsm/program/execution.hpp"

namespace stormproof::explorer {

using From = Specialised::From;
using Op = Specialised::Op;

RuleRunner::RuleRunner(const Specialised& program, const Remembered& remembered, const Scope& scope,
                       std::array<unsigned, most_writers> descriptors, Packing& host)
    : program_{program},
      remembered_{remembered},
      host_{host},
      readers_{scope.readers},
      writers_{scope.writers},
      descriptors_{descriptors},
      registers_(program.registers) {
  for (unsigned s = 0; s < writers_; ++s) {
    valid_.at(s) = (Lanes{1} << descriptors_.at(s)) - 1;
  }
}

void RuleRunner::run(const Slot& slot, const Slot& emitted) {
  relation_ = slot.relation;
  packet_ = &slot;
  emitted_ = &emitted;
  run(program_.rule(slot.what));
}

void RuleRunner::run_at(unsigned participant, const Slot& slot) {
  relation_ = participant;
  run(program_.rule(slot.what));
}
void RuleRunner::raise(std::string_view occasion, unsigned participant) {
  const auto rule =
      std::ranges::find(program_.occasions, occasion, &std::pair<std::string_view, Steps>::first);
  const unsigned here = std::exchange(relation_, participant);
  const Slot* const packet = std::exchange(packet_, nullptr);
  run(rule->second);
  packet_ = packet;
  relation_ = here;
}
Slot RuleRunner::said_now(const Slot& acknack) {
  relation_ = acknack.relation;
  emitted_ = &acknack;
  const std::vector<Slot> said = emitted_by(program_.acknacks.at(acknack.has(Slot::initial)));
  return said.empty() ? Slot{} : said.back();
}
std::vector<Slot> RuleRunner::emitted_by(const Steps& contract) {
  std::vector<Slot> packets;
  std::vector<Slot>* const outer = std::exchange(kept_back_, &packets);
  run(contract);
  kept_back_ = outer;
  return packets;
}

/// By reader, bit r is reader r.
RuleRunner::Lanes RuleRunner::open_readers() const {
  Lanes open = 0;
  for (unsigned r = 0; r < readers_; ++r) {
    open |= Lanes{state_->get<std::uint8_t>(remembered_.open, writer() + r * writers_)} << r;
  }
  return open;
}
std::vector<unsigned> RuleRunner::readers() const {
  std::vector<unsigned> relations;
  for (Lanes left = open_readers(); left != 0; left &= left - 1) {
    relations.push_back(writer() + static_cast<unsigned>(std::countr_zero(left)) * writers_);
  }
  return relations;
}

// Terms as one value.

std::int64_t RuleRunner::read(const Term& term) {
  switch (term.from) {
    case From::truth:
      return state_->get<std::uint8_t>(term.kept, relation_);
    case From::members:
      return get(term.kept) >> descriptor_ & 1;
    case From::number:
      return state_->get<std::int64_t>(term.kept, relation_);
    case From::host:
      return host_.read(static_cast<unsigned>(term.value), *this);
    case From::flag:
      return packet_->has(static_cast<std::uint8_t>(term.value)) ? 1 : 0;
    case From::count:
      return packet_->count;
    default:
      return members_said(term.from, *packet_) >> descriptor_ & 1;
  }
}

std::int64_t RuleRunner::number(Ref ref) {
  const Term& term = program_.terms[ref];
  switch (term.op) {
    case Op::integer:
      return term.value;
    case Op::let:
      return registers_[term.reg];
    case Op::read:
      return read(term);
    case Op::pending:
      return state_->get<std::uint8_t>(term.kept, relation_);
    case Op::in_state:
      return state_->at(term.kept, relation_)[term.from == From::members ? descriptor_ : 0] ==
             term.value;
    case Op::subject:
      return 1;
    case Op::is_in:
      return number(term.a) >> descriptor_ & 1;
    case Op::all_up_to:
    case Op::some_from_here:
      return static_cast<std::int64_t>(lanes(ref) >> descriptor_ & 1);
    case Op::any:
    case Op::negation:
      return (number(term.a) != 0) == (term.op == Op::any);
    case Op::both:
      return truth(term.a) && truth(term.b);
    case Op::either:
      return truth(term.a) || truth(term.b);
    case Op::select:
      return selected(term, ref);
    case Op::set_of:
      return members(term.a);
    case Op::some:
      return members(term.a) != 0;
    case Op::all:
      return members(term.a) == valid();
    case Op::count:
      return std::popcount(members(term.a));
    case Op::some_reader:
      return count_readers(term.a) != 0;
    case Op::count_readers:
      return count_readers(term.a);
    case Op::some_entry:
      return some_entry(term);
    default: {
      const std::int64_t a = number(term.a);
      return fsm::program::of_numbers<std::int64_t>(term.op, a, number(term.b));
    }
  }
}

std::int64_t RuleRunner::selected(const Term& term, Ref ref) {
  if (selected_.size() <= ref) selected_.resize(program_.terms.size());
  if (selected_[ref].step != step_) {
    const std::int64_t value = number(truth(term.a) ? term.b : term.c);
    selected_[ref] = {step_, value};
  }
  return selected_[ref].value;
}
std::int64_t RuleRunner::count_readers(Ref ref) {
  std::int64_t count = 0;
  const unsigned here = relation_;
  for (Lanes left = open_readers(); left != 0; left &= left - 1) {
    relation_ = here % writers_ + static_cast<unsigned>(std::countr_zero(left)) * writers_;
    ++step_;  // elsewhere, a selection is another one
    count += truth(ref) ? 1 : 0;
  }
  ++step_;
  relation_ = here;
  return count;
}
bool RuleRunner::some_entry(const Term& term) {
  if (term.kept.is_kept() && remembered_.queue.is_kept()) {
    return *state_->at(remembered_.queue) != 0;
  }
  bool some = false;
  const unsigned here = std::exchange(relation_, 0);
  for (; relation_ < writers_; ++relation_) some |= members(term.a) != 0;
  relation_ = here;
  return some;
}

// Terms as sets.

RuleRunner::Lanes RuleRunner::in_state(const Term& term) const {
  const std::uint8_t* const states = state_->at(term.kept, relation_);
  Lanes members = 0;
  for (unsigned d = 0; d < descriptors_[writer()]; ++d) {
    members |= Lanes{states[d] == term.value} << d;
  }
  return members;
}

RuleRunner::Lanes RuleRunner::lanes(Ref ref) {
  const Term& term = program_.terms[ref];
  switch (term.op) {
    case Op::read:
      if (term.from == From::members) return get(term.kept);
      if (term.from == From::set || term.from == From::limit) {
        return members_said(term.from, *packet_);
      }
      break;
    case Op::in_state:
      if (term.from != From::members) break;
      return in_state(term);
    case Op::subject:
      return Lanes{1} << descriptor_;
    case Op::is_in:
      return static_cast<Lanes>(number(term.a));
    case Op::negation:
      return ~lanes(term.a);
    case Op::both: {
      const Lanes a = lanes(term.a);
      return a == 0 ? a : a & lanes(term.b);
    }
    case Op::either:
      return lanes(term.a) | lanes(term.b);
    case Op::all_up_to:  // the lowest ones for which it holds
      return (Lanes{1} << std::countr_one(lanes(term.a) & valid())) - 1;
    case Op::some_from_here:
      return (Lanes{1} << std::bit_width(lanes(term.a) & valid())) - 1;
    default:
      break;
  }
  return truth(ref) ? ~Lanes{0} : Lanes{0};
}

}  // namespace stormproof::explorer
