// Reads specs/policies/NAME.yaml: what a reviewer takes for a regression. Every mistake is refused
// with its place, as a policy that is read wrongly would let a regression pass.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "checker/experiments/diff/diff.hpp"
#include "model/config/knobs/knob_reader.hpp"
#include "model/config/spec_path.hpp"
#include "model/config/tree/suggestion.hpp"
#include "model/config/tree/yaml_text.hpp"

namespace stormproof::diff {

namespace config = model::config;
using config::error_at;
using config::InputError;
using config::Node;
using config::Result;

namespace {

using Failure = std::optional<InputError>;

constexpr std::int64_t most_samples = 100'000;
constexpr double largest_increase = 1'000;

class PolicyReader {
 public:
  explicit PolicyReader(const Node& root) : root_{root} {}

  Result<Policy> read(std::string name) {
    policy_.name = std::move(name);
    const config::KnownKeys keys{
        {"description", "tolerances", "unnoticed", "limits", "limit_share", "verdicts", "margin",
         "storm_repairs", "confidence", "samples", "most_samples"},
        {}};
    failure_ = config::check_keys(root_, "", keys);
    read_description();
    read_tolerances();
    read_unnoticed();
    read_limits();
    share("limit_share", policy_.limit_share, 0, 1, "a share from 0 to 1, such as 5 % or 0.05");
    read_verdicts();
    flag("margin", policy_.margin);
    refuse_given_up();
    share("confidence", policy_.confidence, 0.5, 0.9999,
          "a share from 0.5 to 0.9999, such as 95 % or 0.95");
    read_samples();
    if (failure_) return *std::move(failure_);
    return std::move(policy_);
  }

 private:
  /// The value of a key, if there is one and nothing is wrong so far.
  const Node* find(std::string_view key) const { return failure_ ? nullptr : root_.find(key); }

  void fail(const Node& node, std::string_view key, std::string_view expected) {
    failure_ =
        error_at(node.place, fmt::format("{}: {}; expected {}", key, node.shown(), expected));
  }

  void read_description() {
    const Node* node = find(config::description_key);
    if (node != nullptr && !node->is_scalar()) fail(*node, config::description_key, "text");
  }

  static std::optional<double> share_of(const Node& node) {
    const auto parsed = config::parse_share(node.is_scalar() && !node.quoted ? node.text : "");
    return parsed ? std::optional{parsed->value()} : std::nullopt;
  }

  void share(std::string_view key, double& value, double least, double most,
             std::string_view expected) {
    const Node* node = find(key);
    if (node == nullptr) return;
    const std::optional<double> parsed = share_of(*node);
    if (!parsed || *parsed < least || *parsed > most) return fail(*node, key, expected);
    value = *parsed;
  }

  void flag(std::string_view key, bool& value) {
    const Node* node = find(key);
    if (node == nullptr) return;
    const bool is_word = node->is_scalar() && (node->text == "true" || node->text == "false");
    if (!is_word) return fail(*node, key, "true or false");
    value = node->text == "true";
  }

  void read_verdicts() {
    const Node* node = find("verdicts");
    policy_.strict_verdicts = node != nullptr && node->is_scalar() && node->text == "strict";
    if (policy_.strict_verdicts) {
      policy_.verdicts = true;
    } else if (node != nullptr &&
               (!node->is_scalar() || (node->text != "true" && node->text != "false"))) {
      fail(*node, "verdicts", "true, false or strict");
    } else {
      flag("verdicts", policy_.verdicts);
    }
  }

  void read_tolerances() {
    const Node* map = find("tolerances");
    if (map == nullptr) return;
    if (!map->is_map()) {
      return fail(*map, "tolerances", "a map of measures to shares, such as {completion: 25 %}");
    }
    std::vector<std::string> known;
    for (std::size_t k = 0; k < common_measure_count; ++k) {
      known.emplace_back(name_of(static_cast<Measure>(k)));
    }
    policy_.tolerances.clear();
    for (const config::Member& member : map->members) {
      const auto at = std::ranges::find(known, member.key);
      if (at == known.end()) {
        failure_ =
            error_at(member.key_place,
                     fmt::format("tolerances.{}: no such measure{}; expected one of {}", member.key,
                                 config::suggestion(member.key, known), fmt::join(known, ", ")));
        return;
      }
      const std::optional<double> increase = share_of(member.value);
      if (!increase || *increase > largest_increase) {
        return fail(member.value, "tolerances." + member.key,
                    "a share from 0 to 1000, such as 25 % or 0.25");
      }
      policy_.tolerances.push_back({static_cast<Measure>(at - known.begin()), *increase});
    }
  }

  void read_unnoticed() {
    const Node* node = find("unnoticed");
    if (node == nullptr) return;
    const auto parsed =
        config::parse_duration(node->is_scalar() && !node->quoted ? node->text : "");
    if (!parsed || *parsed < model::Nanoseconds{}) {
      return fail(*node, "unnoticed", "a time, such as 250ms");
    }
    policy_.unnoticed = *parsed;
  }

  void read_limits() {
    const Node* node = find("limits");
    if (node == nullptr) return;
    config::read_knobs(*node, "limits", policy_.limits.emplace(), failure_);
  }

  /// A policy had a definition of storms of its own.
  void refuse_given_up() {
    const Node* node = find("storm_repairs");
    if (node == nullptr) return;
    failure_ = error_at(node->place,
                        "storm_repairs is given up: a storm is one by the definition of simulate "
                        "and doctor; tolerances.repair_data judges how many repairs there are");
  }

  void count(std::string_view key, std::size_t& value) {
    const Node* node = find(key);
    if (node == nullptr) return;
    const auto parsed = node->is_scalar() && !node->quoted ? config::parse_count(node->text)
                                                           : config::parse_count("");
    if (!parsed || *parsed < 1 || *parsed > most_samples) {
      return fail(*node, key, fmt::format("a number from 1 to {}", most_samples));
    }
    value = static_cast<std::size_t>(*parsed);
  }

  void read_samples() {
    count("samples", policy_.samples);
    policy_.most_samples = std::max(policy_.most_samples, policy_.samples);
    count("most_samples", policy_.most_samples);
    const Node* most = find("most_samples");
    if (most != nullptr && policy_.most_samples < policy_.samples) {
      fail(*most, "most_samples", fmt::format("at least samples, {}", policy_.samples));
    }
  }

  const Node& root_;
  Policy policy_;
  Failure failure_;
};

}  // namespace

Result<Policy> read_policy(const std::string& reference, const config::SpecPath& specs) {
  const auto file = specs.find(config::SpecKind::policies, reference, "policy");
  if (!file) return file.error();
  const Result<Node> root = config::load_yaml(*file);
  if (!root) return root.error();
  return PolicyReader{*root}.read(reference);
}

}  // namespace stormproof::diff
