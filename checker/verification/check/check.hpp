// `stormproof check` without its command line: asks every engine that can decide a property, and
// combines their findings into one verdict for each property of the catalogue.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "checker/engines/bounds/check_request.hpp"
#include "checker/engines/calculus/frontier.hpp"
#include "checker/engines/exact/health.hpp"
#include "props/property.hpp"

namespace stormproof::checker {

/// One property with everything that the engines found about it.
struct PropertyResult {
  const props::Property* property = nullptr;
  props::VerdictKind verdict = props::VerdictKind::inconclusive;
  /// Position in `findings` of the one that decides; the verdict is its kind.
  std::size_t deciding = 0;
  /// One of each engine, in the order in which they were asked, and perhaps one more about what
  /// they say of each other; never empty.
  std::vector<props::Finding> findings;

  [[nodiscard]] const props::Finding& decisive() const { return findings[deciding]; }
  /// The counterexample with the fewest events, or null.
  [[nodiscard]] const props::Counterexample* counterexample() const;
};

struct CheckReport {
  std::vector<PropertyResult> results;  ///< in the order of the catalogue, then the limits
  /// Properties of the catalogue that were not asked for by name and do not apply to the
  /// composition, with the reason (props/applicability.hpp).
  std::vector<std::pair<std::string_view, std::string_view>> not_applicable;
  double seconds = 0;
  bool interrupted = false;  ///< the rest is inconclusive
  /// What the runs of the scenario were like; absent: no property needed one, or none ended.
  std::optional<exact::Outlook> outlook;
  std::optional<calculus::Frontiers> frontiers{};  ///< if they were asked for

  [[nodiscard]] std::size_t count(props::VerdictKind kind) const;
};

/// Checks the properties and limits with these ids; unknown ones are ignored. If empty: the whole
/// catalogue, and what the scenario is held against (props::limits_of).
[[nodiscard]] CheckReport check(const std::vector<std::string_view>& properties,
                                const CheckRequest& request);

}  // namespace stormproof::checker
