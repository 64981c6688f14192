// The exhibit's own profile is that of its scenario, which has the changes already.
#include "checker/cli/diff_exhibit.hpp"

#include <algorithm>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "model/implementations.hpp"

namespace stormproof::cli {

namespace config = model::config;
using config::Result;
using config::TracedProfile;

namespace {

/// One side on the exhibit's own profile.
Result<TracedProfile> own_profile(const museum::Variant& side,
                                  const std::vector<std::string>& overrides,
                                  const config::SpecPath& specs) {
  std::vector<std::string> in_scenario;
  for (const std::string& one : overrides) in_scenario.push_back("dds." + one);
  const auto scenario = config::parse_scenario(config::effective_json(side.scenario).dump(),
                                               "the exhibit", in_scenario, specs);
  if (!scenario) return scenario.error();
  return TracedProfile{{}, scenario->dds, {}, {}, {}};
}

Result<TracedProfile> changed_profile(const museum::Exhibit& exhibit, const museum::Variant& side,
                                      const std::string& base,
                                      const std::vector<std::string>& overrides,
                                      const config::SpecPath& specs) {
  const auto changes = museum::profile_overrides(side.changes);
  if (!changes) {
    return config::InputError{
        {},
        fmt::format("--exhibit {}: it changes more than a DDS profile; expected an exhibit that "
                    "changes dds alone",
                    exhibit.id)};
  }
  std::vector<std::string> all = overrides;
  all.insert(all.end(), changes->begin(), changes->end());
  return config::trace_dds_profile(base, all, specs);
}

/// Only amended rules know participants that forget; without a change they are the paper's.
void amend(model::DdsProfile& dds) {
  if (model::traits_of(dds).can_be_amended && !dds.amendments) dds.amendments.emplace();
}

bool has_life(const std::string& over, const config::SpecPath& specs) {
  if (over.empty()) return false;
  const auto scenario = config::trace_scenario(over, {}, specs);
  return scenario && scenario->value.deployment.life;
}

}  // namespace

Result<ExhibitSides> sides_of(const std::string& reference, const std::string& base,
                              const std::vector<std::string>& overrides, const std::string& over,
                              const config::SpecPath& specs) {
  auto exhibit = museum::read_exhibit(reference, specs);
  if (!exhibit) return exhibit.error();
  const auto side = [&](const museum::Variant& variant) {
    return base.empty() ? own_profile(variant, overrides, specs)
                        : changed_profile(*exhibit, variant, base, overrides, specs);
  };
  auto before = side(exhibit->before);
  if (!before) return before.error();
  auto after = side(exhibit->after);
  if (!after) return after.error();
  const std::string on = base.empty() ? "" : base + " with ";
  before->reference = on + exhibit->id + " before";
  after->reference = on + exhibit->id + " after";
  if (has_life(over, specs)) {
    amend(before->value);
    amend(after->value);
  }
  return ExhibitSides{*std::move(exhibit), *std::move(before), *std::move(after)};
}

std::string reach_of(const museum::Exhibit& exhibit, const diff::DiffReport& report) {
  using props::VerdictKind;
  const auto& all = report.verdicts.properties;
  const auto found = std::ranges::find(all, exhibit.claim, &diff::VerdictChange::property);
  if (found == all.end()) {
    return fmt::format(
        "{} is not judged here, so only costs tell whether {} reaches this "
        "deployment",
        exhibit.claim, exhibit.id);
  }
  const std::string verdicts = fmt::format("{} is {} before its repair and {} after", exhibit.claim,
                                           name_of(found->before), name_of(found->after));
  if (found->before == VerdictKind::violated && found->after != VerdictKind::violated) {
    return fmt::format("{} reaches this deployment: {}", exhibit.id, verdicts);
  }
  if (found->before == VerdictKind::violated) {
    return fmt::format("{} is not what breaks this deployment: {}", exhibit.id, verdicts);
  }
  return fmt::format("{} does not show itself in this deployment: {}", exhibit.id, verdicts);
}

}  // namespace stormproof::cli
