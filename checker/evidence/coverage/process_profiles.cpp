// Words are looked up once each; the scenario's rules say which profiles stand beside each other.
#include "checker/evidence/coverage/process_profiles.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "model/config/knobs/mixed_profiles.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/yaml_text.hpp"

namespace stormproof::prediction {

namespace {

using model::config::InputError;
using model::config::SpecKind;
using model::config::SpecPath;

/// The shipped preset of "Fast DDS 2.14.5" or of the version without its last part; the word itself
/// if there is none.
std::string preset_of(const std::string& word, const SpecPath& specs) {
  constexpr std::pair<std::string_view, std::string_view> vendors[] = {
      {"Fast DDS ", "fastdds-"}, {"Cyclone DDS ", "cyclonedds-"}};
  for (const auto& [vendor, prefix] : vendors) {
    if (!word.starts_with(vendor)) continue;
    const std::string name = std::string{prefix} + word.substr(vendor.size());
    if (specs.named(SpecKind::dds, name)) return name;
    const std::string shorter = name.substr(0, name.rfind('.'));
    if (specs.named(SpecKind::dds, shorter)) return shorter;
  }
  return word;
}

/// A profile by name, path, or as a map of keys.
model::config::Result<model::DdsProfile> profile_of(const std::string& text,
                                                    const SpecPath& specs) {
  const std::string value = text.starts_with('{') ? text : model::config::quoted_scalar(text);
  const auto scenario = model::config::parse_scenario(
      fmt::format("{{deployment: {{hosts: 2, participants_per_host: 1, "
                  "endpoints_per_participant: 2}}, dds: {}, wireless: wired, time_limit: 1s}}",
                  value),
      "profiles", {}, specs);
  if (!scenario) return scenario.error();
  return scenario->dds;
}

}  // namespace

std::optional<InputError> give_profiles(const Configuration& configuration,
                                        const ScenarioOptions& options, model::Scenario& scenario) {
  if (configuration.profiles.empty()) return std::nullopt;
  const SpecPath specs = SpecPath::standard();
  std::map<std::string, std::string> said;
  for (const std::string& entry : options.words) {
    const std::size_t equals = entry.find('=');
    if (equals == std::string::npos) {
      return InputError{"--runs " + entry, "expected WORD=PROFILE, a word of \"profiles\" of rows"};
    }
    said[entry.substr(0, equals)] = entry.substr(equals + 1);
  }
  std::map<std::string, model::Shared<model::DdsProfile>> known;
  for (std::uint32_t i = 0; i < scenario.deployment.size(); ++i) {
    const std::string& word = configuration.profiles[i];
    model::Shared<model::DdsProfile>& own = known[word];
    if (!own) {
      const auto as = said.find(word);
      auto profile = profile_of(as != said.end() ? as->second : preset_of(word, specs), specs);
      if (!profile) {
        return InputError{fmt::format("\"profiles\": {}", word),
                          profile.error().message + "; --runs WORD=PROFILE says which it is"};
      }
      const std::string expected = model::config::expected_beside(scenario.dds, *profile);
      if (!expected.empty()) {
        return InputError{fmt::format("\"profiles\": {}", word),
                          "cannot run beside --dds; expected " + expected};
      }
      own = *std::move(profile);
    }
    scenario.deployment.participants[i].dds = own;
  }
  choose_multicast(scenario);
  return std::nullopt;
}

}  // namespace stormproof::prediction
