// A fixpoint: take every submessage that does not contradict the ACKNACK by itself, then drop what
// announces or brings more than the ACKNACK admits, until nothing changes.
#include "checker/evidence/conform/arrivals.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stormproof::conform {

namespace {

/// Takes all submessages that are marked as arrived.
void take_all(Arrivals& arrivals, const Knowledge& before, std::span<const Submessage> sent) {
  arrivals.after = before;
  arrivals.heartbeat.reset();
  arrivals.heartbeats = 0;
  for (std::size_t k = 0; k < sent.size(); ++k) {
    if (!arrivals.arrived[k]) continue;
    if (!arrivals.after.take(sent[k])) continue;
    if (!arrivals.heartbeat) arrivals.heartbeat = k;
    ++arrivals.heartbeats;
  }
}

/// The first descriptor at or after the base that is neither listed nor known, though announced.
std::optional<std::uint32_t> unlisted(const Answer& answer, const Knowledge& knowledge) {
  const std::uint32_t end = std::min(knowledge.announced, answer.base + bitmap_limit);
  for (std::uint32_t d = answer.base; d < end; ++d) {
    if (!knowledge.knows(d) && !answer.asks_for(d)) return d;
  }
  return std::nullopt;
}

/// Whether the reader would not miss something any more that it asks for, or its base.
bool tells_of_missing(const Submessage& one, const Answer& answer) {
  const auto is_missing = [&](std::uint32_t d) { return d == answer.base || answer.asks_for(d); };
  if (one.descriptor && is_missing(*one.descriptor)) return true;
  if (one.heartbeat && one.heartbeat->first > answer.base + std::int64_t{1}) return true;
  return std::ranges::any_of(one.gap, is_missing);
}

/// Drops what would tell the reader that `limit` exists; not what is left of a datagram of which
/// something has arrived.
bool drop_beyond(Arrivals& arrivals, const Knowledge& before, std::span<const Submessage> sent,
                 std::uint32_t limit) {
  bool any = false;
  for (std::size_t k = 0; k < sent.size(); ++k) {
    if (!arrivals.arrived[k] || before.datagram == sent[k].datagram) continue;
    const bool announces = sent[k].heartbeat && sent[k].heartbeat->announced > limit;
    const bool brings = sent[k].descriptor && *sent[k].descriptor >= limit;
    if (!announces && !brings) continue;
    arrivals.arrived[k] = false;
    any = true;
  }
  return any;
}

/// A datagram is lost as a whole; one of which something has arrived is not lost.
void lose_datagrams(Arrivals& arrivals, const Knowledge& before, std::span<const Submessage> sent) {
  for (std::size_t first = 0; first < sent.size();) {
    std::size_t last = first;
    bool all = true;
    for (; last < sent.size() && sent[last].datagram == sent[first].datagram; ++last) {
      all = all && arrivals.arrived[last];
    }
    const bool has_begun = before.datagram == sent[first].datagram;
    for (; first < last; ++first) arrivals.arrived[first] = all || has_begun;
  }
}

void judge(Arrivals& arrivals, const Answer& answer) {
  const Knowledge& now = arrivals.after;
  for (std::uint32_t d = 0; d < answer.base; ++d) {
    if (!now.knows(d)) {
      arrivals.mismatch = fmt::format(
          "its base says that descriptor {} has arrived, and no DATA with it can have", d);
      return;
    }
  }
  if (now.knows(answer.base)) {
    arrivals.mismatch = fmt::format(
        "its base is descriptor {}, which has arrived: the reader had confirmed it", answer.base);
    return;
  }
  for (const std::uint32_t d : answer.missing) {
    if (now.knows(d)) {
      arrivals.mismatch =
          fmt::format("it asks for descriptor {}, which the reader had confirmed", d);
      return;
    }
    if (d >= now.announced) {
      arrivals.mismatch =
          fmt::format("it asks for descriptor {}, which nothing can have announced to it", d);
      return;
    }
  }
  if (const auto d = unlisted(answer, now)) {
    arrivals.mismatch = fmt::format(
        "it does not ask for descriptor {}, which was announced to the reader and cannot have "
        "arrived",
        *d);
    return;
  }
}

}  // namespace

bool Knowledge::take(const Submessage& submessage) {
  datagram = submessage.datagram;
  if (const auto d = submessage.descriptor) {
    learn(*d);
    announced = std::max(announced, *d + 1);
  }
  for (const std::uint32_t d : submessage.gap) learn(d);
  if (!submessage.heartbeat || (has_heartbeat && submessage.heartbeat->count <= count)) {
    return false;
  }
  has_heartbeat = true;
  count = submessage.heartbeat->count;
  announced = std::max(announced, submessage.heartbeat->announced);
  for (std::uint32_t d = 0; d + std::int64_t{1} < submessage.heartbeat->first; ++d) learn(d);
  return true;
}

void Knowledge::learn(std::uint32_t d) {
  if (d >= has.size()) has.resize(d + 1);
  has[d] = true;
}

std::uint32_t Knowledge::base() const {
  const auto gap = std::find(has.begin(), has.end(), false);
  return static_cast<std::uint32_t>(gap - has.begin());
}

Arrivals arrivals_for(const Answer& answer, const Knowledge& before,
                      std::span<const Submessage> sent, const std::vector<bool>& lost) {
  Arrivals arrivals;
  arrivals.arrived.assign(sent.size(), true);
  for (std::size_t k = 0; k < sent.size(); ++k) {
    if (before.missed == sent[k].datagram || (!lost.empty() && lost[k])) {
      arrivals.arrived[k] = false;
    }
    if (tells_of_missing(sent[k], answer)) arrivals.arrived[k] = false;
  }
  lose_datagrams(arrivals, before, sent);
  take_all(arrivals, before, sent);
  while (const auto d = unlisted(answer, arrivals.after)) {
    if (!drop_beyond(arrivals, before, sent, *d)) break;
    lose_datagrams(arrivals, before, sent);
    take_all(arrivals, before, sent);
  }
  if (!sent.empty()) {
    arrivals.after.missed.reset();
    if (!arrivals.arrived.back()) arrivals.after.missed = sent.back().datagram;
  }
  judge(arrivals, answer);
  arrivals.lost =
      static_cast<std::size_t>(std::count(arrivals.arrived.begin(), arrivals.arrived.end(), false));
  return arrivals;
}

}  // namespace stormproof::conform
