// Selection and the counts of what is not selected.
#include "checker/verification/counterexample/selection.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/presentation/text/numbers.hpp"
#include "model/trace/event_subject.hpp"

namespace stormproof::counterexample {

namespace {

enum class Reason : std::uint8_t { channel, spdp, relevant, other };

Reason reason_for(const History& history, const Relevance& relevance, std::size_t n) {
  if (relevance.steps[n]) return Reason::relevant;
  const Step& step = history.steps[n];
  if (step.event.kind == model::EventKind::announcement_due) return Reason::spdp;
  if (step.arrived) {
    const PacketLog& packet = history.packets.at(*step.arrived);
    const bool spdp = packet.relation == no_relation && packet.label == "SPDP";
    return spdp ? Reason::spdp : Reason::other;
  }
  const auto subject = model::trace::subject_of(step.event.kind);
  const bool network = subject == model::trace::Subject::channel ||
                       subject == model::trace::Subject::packet ||
                       subject == model::trace::Subject::access_point;
  return network ? Reason::channel : Reason::other;
}

/// The first third and the end of the marked events, `limit` in all.
std::vector<bool> ends_of(const std::vector<bool>& marked, std::size_t limit) {
  const auto count = static_cast<std::size_t>(std::ranges::count(marked, true));
  const std::size_t first = limit / 3;
  const std::size_t from_end = limit - first;
  std::vector<bool> chosen(marked.size());
  std::size_t position = 0;
  for (std::size_t n = 0; n < marked.size(); ++n) {
    if (!marked[n]) continue;
    chosen[n] = position < first || position + from_end >= count;
    ++position;
  }
  return chosen;
}

/// Everything if there is room; otherwise what is essential, filled up from the end.
std::vector<bool> choose(const Relevance& relevance, std::size_t limit) {
  if (relevance.count <= limit) return relevance.steps;
  const auto essential = static_cast<std::size_t>(std::ranges::count(relevance.essential, true));
  if (essential > limit) return ends_of(relevance.essential, limit);
  std::vector<bool> chosen = relevance.essential;
  std::size_t room = limit - essential;
  for (std::size_t n = chosen.size(); n-- > 0 && room > 0;) {
    if (!relevance.steps[n] || chosen[n]) continue;
    chosen[n] = true;
    --room;
  }
  return chosen;
}

}  // namespace

std::vector<Selected> select(const History& history, const Relevance& relevance,
                             std::size_t limit) {
  const std::vector<bool> shown = choose(relevance, limit);
  std::vector<Selected> selected;
  std::size_t next = 0;  // the first event that has not been dealt with
  for (std::size_t n = 0; n < history.steps.size(); ++n) {
    if (!shown[n]) continue;
    if (next < n) selected.push_back({true, next, n - 1});
    selected.push_back({false, n, n});
    next = n + 1;
  }
  return selected;
}

std::vector<Selected> without_repetition(const std::vector<Selected>& selected,
                                         const std::function<std::string(std::size_t)>& shape) {
  std::vector<std::size_t> events;  // positions in `selected`
  std::vector<std::string> shapes;
  for (std::size_t k = 0; k < selected.size(); ++k) {
    if (selected[k].gap) continue;
    events.push_back(k);
    shapes.push_back(shape(selected[k].step));
  }
  const auto length = [&](std::size_t from, std::size_t period) {
    std::size_t end = std::min(from + period, events.size());
    while (end < events.size() && shapes[end] == shapes[end - period]) ++end;
    return (end - from) / period * period;  // whole turns
  };
  std::vector<Selected> result;
  std::size_t copied = 0;  // of `selected`
  for (std::size_t from = 0; from < events.size();) {
    std::size_t period = 1;
    constexpr std::size_t longest = 3;
    while (period <= longest && length(from, period) < std::max<std::size_t>(4, 3 * period)) {
      ++period;
    }
    if (period > longest) {
      ++from;
      continue;
    }
    const std::size_t count = length(from, period);
    const std::size_t first = events[from + period - 1] + 1;     // that is left out
    const std::size_t last = events[from + count - period] - 1;  // the same
    for (; copied < first; ++copied) result.push_back(selected[copied]);
    result.push_back({true, selected[first].step, selected[last].last});
    copied = last + 1;
    from += count;
  }
  result.insert(result.end(), selected.begin() + static_cast<std::ptrdiff_t>(copied),
                selected.end());
  return result;
}

std::string gap_text(const History& history, const Relevance& relevance, const Selected& gap) {
  std::size_t counts[4] = {};
  for (std::size_t n = gap.step; n <= gap.last; ++n) {
    ++counts[static_cast<std::size_t>(reason_for(history, relevance, n))];
  }
  const char* names[4] = {"on the channel", "of SPDP", "like these", "of other relations"};
  const std::size_t total = gap.last - gap.step + 1;
  const std::string events =
      fmt::format("{} event{}", report::grouped(total), total == 1 ? "" : "s");
  std::string parts;
  for (const std::size_t k : {2U, 0U, 1U, 3U}) {
    if (counts[k] == 0) continue;
    if (counts[k] == total) return events + " " + names[k];
    parts +=
        fmt::format("{}{} {}", parts.empty() ? "" : ", ", report::grouped(counts[k]), names[k]);
  }
  return events + ": " + parts;
}

}  // namespace stormproof::counterexample
