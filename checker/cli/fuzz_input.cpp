// Options become overrides of `vary:` and `limits:`, so that the reader of scenarios refuses what
// is wrong in them, in the words of the option.
#include "checker/cli/fuzz_input.hpp"

#include <algorithm>
#include <map>

#include <fmt/core.h>

#include "model/config/scenario_file.hpp"
#include "model/config/tree/quantities.hpp"
#include "model/config/tree/suggestion.hpp"
#include "model/implementations.hpp"
#include "props/limits.hpp"
#include "props/property.hpp"

namespace stormproof::cli {

using model::config::InputError;

namespace {

/// An option that stands for a key of the scenario.
struct RangeOption {
  const char* name;  ///< of the option
  const char* key;   ///< of `vary`
  std::string FuzzArguments::*value;
  bool relative;  ///< may be given in percent
};
constexpr RangeOption range_options[] = {
    {"--start-jitter", "start_jitter", &FuzzArguments::start_jitter, false},
    {"--loss", "loss", &FuzzArguments::loss, true},
    {"--sizes", "sizes", &FuzzArguments::sizes, true},
    {"--delays", "delays", &FuzzArguments::delays, true},
    {"--timers", "timers", &FuzzArguments::timers, true}};

bool means_none(const std::string& value) { return value == "0" || value == "0%"; }

/// "2%" → "1/50"; anything else as it is, for the reader of scenarios to refuse.
std::string without_percent(const std::string& value) {
  const auto share = model::config::parse_share(value);
  return share && value.ends_with('%') ? print_fraction(*share) : value;
}

/// The overrides of the scenario, and by override the option that it comes from.
struct Overrides {
  std::vector<std::string> list;
  std::map<std::string, std::string> origin;

  void add(const std::string& change, const std::string& option) {
    list.push_back(change);
    origin["--set " + change] = option;
  }
};

Overrides overrides_of(const FuzzArguments& arguments) {
  Overrides overrides{arguments.overrides, {}};
  for (const RangeOption& option : range_options) {
    const std::string& value = arguments.*option.value;
    if (value.empty() || means_none(value)) continue;
    overrides.add(
        fmt::format("vary.{}={}", option.key, option.relative ? without_percent(value) : value),
        fmt::format("{} {}", option.name, value));
  }
  for (const std::string& limit : arguments.limits) {
    overrides.add("limits." + limit, "--limit " + limit);
  }
  return overrides;
}

}  // namespace

model::config::Result<model::Scenario> read_scenario(const FuzzArguments& arguments) {
  for (const std::string& limit : arguments.limits) {
    const std::size_t equals = limit.find('=');
    if (equals == 0 || equals == std::string::npos) {
      return InputError{"--limit " + limit, "expected NAME=VALUE, such as completion=3s"};
    }
  }
  const Overrides overrides = overrides_of(arguments);
  auto scenario = model::config::read_scenario(arguments.scenario, overrides.list,
                                               model::config::SpecPath::standard());
  if (!scenario) {
    InputError error = scenario.error();
    const auto option = overrides.origin.find(error.where);
    if (option != overrides.origin.end()) error.where = option->second;
    return error;
  }
  const auto switch_off = [&](const std::string& option, auto model::Variation::*range) {
    if (!means_none(option)) return;
    if (!scenario->vary) scenario->vary.emplace();  // stated, so the usual ranges do not apply
    ((*scenario->vary).*range).reset();
  };
  switch_off(arguments.start_jitter, &model::Variation::start_jitter);
  switch_off(arguments.loss, &model::Variation::loss);
  switch_off(arguments.sizes, &model::Variation::sizes);
  switch_off(arguments.delays, &model::Variation::delays);
  switch_off(arguments.timers, &model::Variation::timers);
  return scenario;
}

model::config::Result<std::vector<std::string>> ids_to_judge(const FuzzArguments& arguments,
                                                             const model::Scenario& scenario) {
  std::vector<std::string> known;
  for (const std::string_view id : props::monitored_properties(scenario)) known.emplace_back(id);
  for (const std::string_view id : props::limits_of(scenario)) known.emplace_back(id);
  for (const std::string& id : arguments.properties) {
    if (std::ranges::find(known, id) != known.end()) continue;
    const bool exists = props::find_property(id) != nullptr;
    const std::string why = !exists ? "no such property" + model::config::suggestion(id, known)
                            : id.starts_with("limit.") ? "the scenario does not set this limit"
                                                       : "a run does not show this property";
    return InputError{"--property " + id, why + "; 'stormproof properties' lists the properties"};
  }
  std::vector<std::string> ids = arguments.properties;
  if (ids.empty()) return ids;
  for (const std::string& limit : arguments.limits) {
    ids.push_back("limit." + limit.substr(0, limit.find('=')));
  }
  return ids;
}

}  // namespace stormproof::cli
