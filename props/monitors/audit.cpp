// Comparing what the run did with what the rules say.
#include "props/monitors/audit.hpp"

#include <algorithm>
#include <bit>

#include <fmt/core.h>

namespace stormproof::props {

namespace {

bool same_event(const Move& one, const Move& other) {
  return one.machine.subject == other.machine.subject && one.machine.kind == other.machine.kind &&
         one.event == other.event && one.machine.machine == other.machine.machine;
}
/// Names are mostly the very same characters.
bool same_step(const Move& one, const Move& other) {
  if (one.machine.subject != other.machine.subject || one.first_word != other.first_word) {
    return false;
  }
  const bool same_characters = one.event.data() == other.event.data() &&
                               one.before.data() == other.before.data() &&
                               one.after.data() == other.after.data() &&
                               one.machine.machine.data() == other.machine.machine.data();
  if (same_characters) return one.machine.kind == other.machine.kind;
  return one.before == other.before && one.after == other.after && same_event(one, other);
}
/// The first of them alone.
Move first_of(const std::vector<Move>& moves) {
  const auto number = [](const Move& one) {
    return 64 * one.first_word + static_cast<std::uint32_t>(std::countr_zero(one.descriptors));
  };
  Move first = *std::ranges::min_element(moves, {}, number);
  first.descriptors &= ~first.descriptors + 1;
  return first;
}

}  // namespace

void Audit::transition(const Move& wanted) {
  const auto same = [&](const Move& actual) {
    return actual.descriptors == wanted.descriptors && same_step(actual, wanted);
  };
  if (wanted.descriptors == 0 || looks_ahead_) {
    next(wanted, same);
    return;
  }
  if (difference_) return;
  if (!moved_.empty() && !same_event(moved_.front(), wanted)) settle();
  const Move* actual = moved_.empty() ? deeds_.next<Move>() : nullptr;
  if (actual != nullptr && same(*actual)) return deeds_.take();
  for (Move& one : moved_) {
    if (!same_step(one, wanted)) continue;
    one.descriptors |= wanted.descriptors;
    return;
  }
  moved_.push_back(wanted);
}

void Audit::settle_moves() {
  while (!moved_.empty() && !difference_) {
    const Move* actual = deeds_.next<Move>();
    const auto one = std::ranges::find_if(
        moved_, [&](const Move& each) { return actual != nullptr && same_step(*actual, each); });
    const std::uint64_t both = one == moved_.end() ? 0 : one->descriptors & actual->descriptors;
    if (both == 0) return differ(said(first_of(moved_), topology_));
    const Move first = *one;
    one->descriptors &= ~both;
    if (one->descriptors == 0) moved_.erase(one);
    if (both != actual->descriptors) {
      return differ(said(first_of(moved_.empty() ? std::vector{first} : moved_), topology_));
    }
    deeds_.take();
  }
}

void Audit::nothing_more() {
  settle();
  site_ = {};
  if (!deeds_.empty()) differ("nothing more happens");
  deeds_.clear();
  moved_.clear();
  begin("without a rule");
}

const Scheduled* Audit::expect(const Scheduled& wanted) {
  return next(wanted, [&](const Scheduled& actual) {
    return actual.kind == wanted.kind && actual.subject == wanted.subject &&
           actual.time == wanted.time;
  });
}
void Audit::expect(const Message& wanted, std::span<const std::uint32_t> pairs) {
  if (difference_) return;
  if (looks_ahead_) {
    sees_some_ = true;
    fits_ = fits_ && deeds_.pass(ahead_, wanted, pairs) == pairs.size();
    return;
  }
  settle();
  const std::size_t fitting = deeds_.take(wanted, pairs);
  if (fitting == pairs.size()) return;
  Message missing = wanted;
  missing.pair = pairs[fitting];
  differ(said(missing, topology_));
}

void Audit::differ(const std::string& wanted) {
  if (difference_) return;
  std::string place{rule_};
  if (site_.line != 0) {
    place += fmt::format(" ({}:{})", site_.file.substr(site_.file.rfind('/') + 1), site_.line);
  }
  difference_ =
      fmt::format("{}: by the rules {}; in the run {}.", place, wanted, deeds_.next_in_words());
}

/// The next deed if it is `same`; otherwise there is a difference, and null.
template <class Kind, class Same>
const Kind* Audit::next(const Kind& wanted, Same&& same) {
  if (difference_) return nullptr;
  if (looks_ahead_) {
    const Kind* actual = deeds_.at<Kind>(ahead_.deed);
    ahead_ = {ahead_.deed + 1};
    sees_some_ = true;
    fits_ = fits_ && actual != nullptr && same(*actual);
    return nullptr;
  }
  settle();
  const Kind* actual = deeds_.next<Kind>();
  if (actual == nullptr || !same(*actual)) {
    differ(said(wanted, topology_));
    return nullptr;
  }
  deeds_.take();
  return actual;
}

}  // namespace stormproof::props
