// Words for what is explained or not.
#include "checker/evidence/conform/words.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stormproof::conform {

namespace {

/// "5–9, 12".
std::string ranges(const std::vector<std::uint32_t>& numbers) {
  std::string text;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t last = k;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (!text.empty()) text += ", ";
    text +=
        last == k ? fmt::format("{}", numbers[k]) : fmt::format("{}–{}", numbers[k], numbers[last]);
    k = last + 1;
  }
  return text;
}

}  // namespace

std::string words(const Answer& answer) {
  if (answer.is_initial) return "base 0, initial";
  if (answer.missing.empty()) return fmt::format("base {}, asks for nothing", answer.base);
  return fmt::format("base {}, asks for {}", answer.base, ranges(answer.missing));
}

std::vector<std::size_t> context_of(const Relation& relation, std::size_t event,
                                    std::optional<std::size_t> cause) {
  constexpr std::size_t before = 8;
  constexpr std::size_t after = 4;
  std::vector<std::size_t> all;
  for (const Submessage& one : relation.sent) all.push_back(one.event);
  for (const Answer& answer : relation.answers) all.push_back(answer.event);
  std::sort(all.begin(), all.end());
  const auto at = std::lower_bound(all.begin(), all.end(), event);
  const auto index = static_cast<std::size_t>(at - all.begin());
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(index - std::min(index, before));
  const auto last =
      all.begin() + static_cast<std::ptrdiff_t>(std::min(index + after + 1, all.size()));
  std::vector<std::size_t> context{first, last};
  if (cause && std::find(context.begin(), context.end(), *cause) == context.end()) {
    context.push_back(*cause);
  }
  std::sort(context.begin(), context.end());
  return context;
}

Unexplained unexplained_among(const std::vector<Announcement>& all, const Place& place,
                              const Announcement& one, Fault fault, std::string what,
                              std::string nearest, std::vector<Need> needs, Around shown) {
  Unexplained result{one.event,        fault, place, std::move(what), std::move(nearest),
                     std::move(needs), {}};
  std::size_t at = 0;
  while (at < all.size() && all[at].event < one.event) ++at;
  if (at == all.size() || all[at].event != one.event) result.context.push_back(one.event);
  for (std::size_t k = at - std::min(at, shown.before);
       k < std::min(at + shown.after + 1, all.size()); ++k) {
    result.context.push_back(all[k].event);
  }
  std::ranges::sort(result.context);
  return result;
}

Unexplained unexplained_in(const Relation& relation, std::size_t event, Fault fault,
                           std::string what, std::string nearest, std::vector<Need> needs,
                           std::optional<std::size_t> cause) {
  return {event,
          fault,
          relation.place,
          std::move(what),
          std::move(nearest),
          std::move(needs),
          context_of(relation, event, cause)};
}

}  // namespace stormproof::conform
