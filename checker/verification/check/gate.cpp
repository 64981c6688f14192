// From verdicts to an exit code.
#include "checker/verification/check/gate.hpp"

#include <algorithm>

#include "checker/verification/check/combination.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"

namespace stormproof::checker {

using props::Finding;
using props::Property;
using props::Reach;
using props::VerdictKind;

const char* name_of(Standing standing) {
  switch (standing) {
    case Standing::holds:
      return "holds";
    case Standing::possible:
      return "possible";
    case Standing::accepted:
      return "accepted";
    case Standing::unknown:
      return "unknown";
    case Standing::open:
      return "open";
    case Standing::fails:
      return "fails";
    case Standing::disputed:
      return "disputed";
  }
  return "";
}

namespace {

/// Network calculus computes with the load of one deployment; what is only observed is seen in one.
bool is_about_deployment(const Property& property) {
  using props::Engine;
  const auto is_run = [](Engine engine) { return engine == Engine::exact_run; };
  return std::ranges::find(property.engines, Engine::calculus) != property.engines.end() ||
         std::ranges::all_of(property.engines, is_run);
}

bool is_of_run(const Finding& finding) {
  return finding.engine == props::name_of(props::Engine::exact_run);
}

}  // namespace

Reach reach_of(const Property& property, const Finding& finding) {
  if (finding.engine == props::name_of(props::Engine::tables)) return Reach::rules;
  if (finding.engine == props::name_of(props::Engine::calculus)) return Reach::deployment;
  // A run that keeps a margin says nothing of others; one that does not is a run of the profile. So
  // is one that shows what a library does.
  const bool is_of_others =
      property.is_of_library || (property.is_margin && !is_about_deployment(property));
  const bool of_profile = is_of_others && finding.kind == VerdictKind::violated;
  return is_of_run(finding) && !of_profile ? Reach::deployment : Reach::profile;
}

const Finding* answer_to(Reach reach, const PropertyResult& result) {
  std::vector<Finding> about;
  std::vector<const Finding*> places;
  const auto add = [&](const Finding& finding) {
    about.push_back(finding);
    places.push_back(&finding);
  };
  for (const Finding& finding : result.findings) {
    if (finding.engine.empty() || reach_of(*result.property, finding) != reach) continue;
    add(finding);
  }
  if (about.empty()) return nullptr;
  for (const Finding& finding : result.findings) {
    if (reach != Reach::profile || finding.kind != VerdictKind::violated) continue;
    if (is_of_run(finding)) add(finding);
  }
  return places[deciding_finding(about)];
}

namespace {

bool is_limit(const Property& property) { return property.id.starts_with("limit."); }

bool is_looked_at(const PropertyResult& result) {
  return std::ranges::any_of(result.findings,
                             [](const Finding& finding) { return !finding.engine.empty(); });
}

/// Where a property is violated, the nearest first.
std::optional<Reach> violated_in(const PropertyResult& result) {
  for (const Reach reach : props::reaches) {
    const Finding* const answer = answer_to(reach, result);
    if (answer != nullptr && answer->kind == VerdictKind::violated) return reach;
  }
  return std::nullopt;
}

class Judge {
 public:
  Judge(const CheckReport& report, const model::DdsProfile& dds, GateRules rules)
      : report_{report}, dds_{dds} {
    gate_.rules = std::move(rules);
  }

  Gate judge() && {
    if (const std::string_view id = outlook_failure(); !id.empty()) {
      gate_.outlook_id = id;
      gate_.outlook = failure({std::string{id}, Reach::deployment});
    }
    for (const PropertyResult& result : report_.results) {
      gate_.standings.push_back(standing(result));
    }
    for (const Failure& accepted : gate_.rules.baseline) {
      if (std::ranges::find(gate_.failures, accepted) == gate_.failures.end()) {
        gate_.outdated.push_back(accepted);
      }
    }
    // What an interrupted check has found stands in the answer; it is not the answer. Nor is what
    // stands beside a contradiction.
    if (report_.interrupted || gate_.count(Standing::disputed) > 0) {
      gate_.exit_code = 3;
    } else if (gate_.count(Standing::fails) > 0) {
      gate_.exit_code = 1;
    } else if (gate_.count(Standing::open) > 0) {
      gate_.exit_code = 3;
    }
    return std::move(gate_);
  }

 private:
  /// What the runs are, if that fails by itself; empty: nothing does.
  [[nodiscard]] std::string_view outlook_failure() const {
    if (!report_.outlook) return {};
    if (report_.outlook->health() == exact::Health::storm) return storm_id;
    const bool is_judged = std::ranges::any_of(report_.results, [](const PropertyResult& result) {
      return result.property->id == incomplete_id;
    });
    const bool is_incomplete = report_.outlook->completed() < report_.outlook->size();
    return is_incomplete && !is_judged ? incomplete_id : std::string_view{};
  }

  Standing failure(Failure one) {
    const auto& accepted = gate_.rules.baseline;
    const bool known = std::ranges::find(accepted, one) != accepted.end();
    gate_.failures.push_back(std::move(one));
    return known ? Standing::accepted : Standing::fails;
  }

  Standing standing(const PropertyResult& result) {
    const Property& property = *result.property;
    if (result.verdict == VerdictKind::disputed) return Standing::disputed;
    const bool promised =
        gate_.rules.strict || applicability_of(property, model::kind_of(dds_)).is_promised();
    if (const auto where = violated_in(result)) {
      const bool counts = promised || (*where == Reach::deployment && !property.is_margin);
      return counts ? failure({std::string{property.id}, *where}) : Standing::possible;
    }
    if (!holds(result.verdict) && !promised) {
      return is_looked_at(result) ? Standing::possible : Standing::unknown;
    }
    if (!holds(result.verdict)) return Standing::open;
    // Kinds are in the order of their strength.
    const bool weak = result.verdict > gate_.rules.require && !is_limit(property);
    return promised && weak ? Standing::open : Standing::holds;
  }

  const CheckReport& report_;
  const model::DdsProfile& dds_;
  Gate gate_;
};

}  // namespace

std::size_t Gate::count(Standing standing) const {
  const auto properties = std::ranges::count(standings, standing);
  return static_cast<std::size_t>(properties) +
         (outlook == standing && outlook != Standing::holds ? 1 : 0);
}

Gate judge(const CheckReport& report, const model::DdsProfile& dds, GateRules rules) {
  return Judge{report, dds, std::move(rules)}.judge();
}

}  // namespace stormproof::checker
