// Baselines as YAML. An entry that is read wrongly would let a failure pass, so nothing is guessed.
#include "checker/verification/check/baseline.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/tree/suggestion.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "props/limits.hpp"

namespace stormproof::checker {

namespace config = model::config;
using config::Node;

namespace {

constexpr std::string_view key = "accepted";

/// "in this deployment", "with this profile", "by the rules".
std::string_view words_of(props::Reach reach) {
  switch (reach) {
    case props::Reach::deployment:
      return "in this deployment";
    case props::Reach::profile:
      return "with this profile";
    case props::Reach::rules:
      return "by the rules";
  }
  return "";
}

std::vector<std::string> known_ids() {
  std::vector<std::string> ids{std::string{storm_id}};
  for (const props::Property& one : props::catalogue()) ids.emplace_back(one.id);
  for (const props::Property& one : props::limit_properties()) ids.emplace_back(one.id);
  return ids;
}

config::Result<Failure> failure_of(const Node& node) {
  const auto refuse = [&](const std::string& expected) {
    return config::error_at(node.place,
                            fmt::format("{}: {}; expected {}", key, node.shown(), expected));
  };
  constexpr const char* form = "ID and where, such as 'storm.single-copy in this deployment'";
  if (!node.is_scalar()) return refuse(form);
  const std::size_t blank = node.text.find(' ');
  if (blank == std::string::npos) return refuse(form);
  Failure failure{node.text.substr(0, blank), {}};
  const std::vector<std::string> ids = known_ids();
  if (std::ranges::find(ids, failure.property) == ids.end()) {
    return refuse("a property" + config::suggestion(failure.property, ids) +
                  "; 'stormproof properties' lists them");
  }
  const std::string where{config::trimmed(std::string_view{node.text}.substr(blank))};
  for (const props::Reach reach : props::reaches) {
    if (where != words_of(reach)) continue;
    failure.reach = reach;
    return failure;
  }
  return refuse("'in this deployment', 'with this profile' or 'by the rules' after the property");
}

/// As a key of YAML.
std::string as_key(const std::string& name) {
  const bool plain = !name.empty() && std::ranges::all_of(name, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.' ||
           c == '/';
  });
  return plain ? name : nlohmann::json(name).dump();
}

}  // namespace

config::Result<Baseline> read_baseline(const std::string& path) {
  const auto root = config::load_yaml(path);
  if (!root) return root.error();
  const config::KnownKeys keys{{std::string{key}}, {}};
  if (const auto wrong = config::check_keys(*root, "", keys)) return *wrong;
  Baseline baseline;
  if (root->find(key) == nullptr) {
    return config::error_at(root->place,
                            fmt::format("expected '{}:' with a map of scenarios", key));
  }
  const Node& accepted = *root->find(key);
  if (accepted.kind == Node::Kind::null) return baseline;
  if (!accepted.is_map()) {
    return config::error_at(
        accepted.place,
        fmt::format("{}: {}; expected a map from scenarios to lists", key, accepted.shown()));
  }
  for (const config::Member& scenario : accepted.members) {
    if (!scenario.value.is_sequence()) {
      return config::error_at(
          scenario.value.place,
          fmt::format("{}: {}; expected a list", scenario.key, scenario.value.shown()));
    }
    std::vector<Failure>& failures = baseline[scenario.key];
    for (const Node& item : scenario.value.items) {
      auto failure = failure_of(item);
      if (!failure) return failure.error();
      failures.push_back(*std::move(failure));
    }
  }
  return baseline;
}

std::string baseline_text(const Baseline& baseline) {
  std::string text =
      "# What `stormproof check --baseline` accepts: known failures, by scenario. Anything else "
      "fails.\n"
      "# Written by --update-baseline; review it as you review code.\naccepted:\n";
  for (const auto& [scenario, failures] : baseline) {
    if (failures.empty()) continue;
    text += fmt::format("  {}:\n", as_key(scenario));
    for (const Failure& one : failures) {
      text += fmt::format("    - {} {}\n", one.property, words_of(one.reach));
    }
  }
  return text;
}

}  // namespace stormproof::checker
