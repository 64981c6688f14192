// Conformance is a statement about existence, so no wording here says more than that.
#include "checker/evidence/conform/report/findings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/conform/report/names.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/implementations.hpp"

namespace stormproof::conform {

namespace {

/// With a capital letter; `text` is not empty.
std::string capitalised(std::string text) {
  if (text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

}  // namespace

std::string verdict_line(const Report& report) {
  const std::string profile = report::one_line(report.profile);
  const std::string bounds = bounds_text(report.result.bounds);
  switch (report.result.verdict) {
    case Verdict::conforms:
      return fmt::format("CONFORMS to {} within these bounds: {}", profile, bounds);
    case Verdict::does_not_conform:
      return fmt::format("DOES NOT CONFORM to {} within these bounds: {}", profile, bounds);
    case Verdict::inconclusive:
      break;
  }
  return fmt::format("INCONCLUSIVE for {} within these bounds: {}", profile, bounds);
}

std::string verdict_meaning(const Report& report) {
  const Conformance& result = report.result;
  switch (result.verdict) {
    case Verdict::conforms:
      if (model::traits_of(report.dds).writer == model::Writer::of_cyclone) {
        return "Each captured message by itself has a cause within the bounds with which the "
               "profile sends it. That one course of events explains all of them is not decided, "
               "and this is about this capture only.";
      }
      return "Receptions, losses and delays within the bounds exist with which the profile's "
             "machines send exactly what was captured. This is about this capture: it is no proof "
             "that the implementation always behaves so.";
    case Verdict::does_not_conform:
      return fmt::format(
          "No receptions, losses and delays within the bounds explain every event: {} not. The "
          "profile, the bounds or the capture is not what it is said to be.",
          result.unexplained.size() == 1
              ? std::string{"one place has an event that they do"}
              : report::plural(result.unexplained.size(), "place") + " have an event that they do");
    case Verdict::inconclusive:
      break;
  }
  return fmt::format("{}. No event was found that nothing explains.",
                     result.why_inconclusive.empty() ? "The search ended early"
                                                     : capitalised(result.why_inconclusive));
}

std::string verdict_token(Verdict verdict) {
  std::string token{name_of(verdict)};
  std::ranges::replace(token, ' ', '_');
  return token;
}

std::string captures_text(const Report& report) {
  const auto& captures = report.conversation.captures;
  std::string text;
  for (std::size_t k = 0; k < captures.size(); ++k) {
    text += k == 0 ? "" : k + 1 == captures.size() ? " and " : ", ";
    text += report::one_line(captures[k].name);
  }
  return text;
}

std::vector<FaultGroup> by_fault(const Conformance& result) {
  std::vector<FaultGroup> groups;
  for (const Unexplained& one : result.unexplained) {
    const auto found = std::ranges::find(groups, one.fault, &FaultGroup::fault);
    if (found == groups.end()) {
      groups.push_back({one.fault, 1, &one});
    } else {
      ++found->places;
    }
  }
  return groups;
}

std::size_t rules_used(const Conformance& result) {
  return static_cast<std::size_t>(
      std::ranges::count_if(result.by_rule, [](std::uint64_t times) { return times > 0; }));
}

}  // namespace stormproof::conform
