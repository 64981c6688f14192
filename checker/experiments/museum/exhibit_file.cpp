// Reads specs/museum/ID.yaml. The scenario of an exhibit is read three times and more: with the
// changes before the repair, after it, and of each decoy.
#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "checker/experiments/grids/grid.hpp"
#include "checker/experiments/museum/certified.hpp"
#include "checker/experiments/museum/claims.hpp"
#include "checker/experiments/museum/exhibit.hpp"
#include "fsm/composition/compositions.hpp"
#include "model/config/knobs/knob_reader.hpp"
#include "model/config/knobs/scenario_knobs.hpp"
#include "model/config/resolve.hpp"
#include "model/config/tree/suggestion.hpp"
#include "model/config/tree/yaml_text.hpp"

namespace stormproof::museum {

namespace config = model::config;
using config::error_at;
using config::InputError;
using config::Node;
using config::Result;

namespace {

constexpr std::uint32_t most_losses = 4;
constexpr std::uint32_t most_packets = 1'000;

/// Whether some composition has a rule with this id.
bool is_rule(const std::string& id) {
  for (const auto& composition : fsm::composition::compositions()) {
    for (const auto* list : {&composition.rules, &composition.procedures, &composition.steps}) {
      if (std::ranges::any_of(*list, [&](const auto& rule) { return rule.id == id; })) return true;
    }
  }
  return false;
}

class ExhibitReader {
 public:
  ExhibitReader(const Node& root, const config::SpecPath& specs) : root_{root}, specs_{specs} {}

  Result<Exhibit> read() {
    static const config::KnownKeys keys{
        {"id", "vendor", "year", "title", "sentence", "fix", "links", "rules", "claim", "bound",
         "losses", "packets", "scenario", "before", "after", "expect", "decoys"},
        {}};
    failure_ = config::check_keys(root_, "", keys);
    exhibit_.id = text(root_, "id", "");
    exhibit_.vendor = text(root_, "vendor", "");
    exhibit_.year = number("year", 1990, 2100);
    exhibit_.title = text(root_, "title", "");
    exhibit_.sentence = text(root_, "sentence", "");
    exhibit_.fix = text(root_, "fix", "");
    exhibit_.links = texts("links");
    exhibit_.rules = texts("rules");
    read_rules();
    read_claim();
    exhibit_.losses = number("losses", 0, most_losses);
    exhibit_.packets = exhibit_.losses == 0 ? 0 : number("packets", 1, most_packets);
    read_variants();
    if (failure_) return *std::move(failure_);
    return std::move(exhibit_);
  }

 private:
  void fail(const Node& node, std::string message) {
    if (!failure_) failure_ = error_at(node.place, std::move(message));
  }
  /// A required key; null if something is wrong already.
  const Node* find(const Node& map, std::string_view key, std::string_view path,
                   std::string_view expected) {
    if (failure_) return nullptr;
    const Node* node = map.find(key);
    if (node == nullptr) {
      fail(map,
           fmt::format("missing key '{}'; expected {}", config::join_path(path, key), expected));
    }
    return node;
  }
  std::string text(const Node& map, std::string_view key, std::string_view path) {
    const Node* node = find(map, key, path, "text");
    if (node == nullptr) return {};
    if (!node->is_scalar() || node->text.empty()) {
      fail(*node,
           fmt::format("{}: {}; expected text", config::join_path(path, key), node->shown()));
    }
    return node->text;
  }
  std::uint32_t number(std::string_view key, std::uint32_t least, std::uint32_t most) {
    const std::string expected = fmt::format("a number from {} to {}", least, most);
    const Node* node = find(root_, key, "", expected);
    if (node == nullptr) return 0;
    const auto parsed = config::parse_count(node->is_scalar() ? node->text : "");
    if (!parsed || *parsed < least || *parsed > most) {
      fail(*node, fmt::format("{}: {}; expected {}", key, node->shown(), expected));
      return 0;
    }
    return static_cast<std::uint32_t>(*parsed);
  }
  std::vector<std::string> texts(std::string_view key) {
    const Node* node = find(root_, key, "", "a list of texts");
    if (node == nullptr) return {};
    if (!node->is_sequence()) {
      fail(*node, fmt::format("{}: {}; expected a list of texts", key, node->shown()));
    }
    std::vector<std::string> all;
    for (const Node& item : node->items) {
      if (!item.is_scalar()) fail(item, fmt::format("{}: {}; expected text", key, item.shown()));
      all.push_back(item.text);
    }
    return all;
  }
  void read_rules() {
    if (failure_) return;
    const Node& list = *root_.find("rules");
    for (const Node& rule : list.items) {
      if (is_rule(rule.text)) continue;
      fail(rule, fmt::format("rules: no composition has a rule {}; expected ids as in stormproof "
                             "draw composition",
                             rule.shown()));
    }
  }
  void read_claim() {
    exhibit_.claim = text(root_, "claim", "");
    if (failure_) return;
    std::vector<std::string> known;
    for (const Claim& claim : claims()) known.emplace_back(claim.id);
    const Claim* claim = find_claim(exhibit_.claim);
    const Node& node = *root_.find("claim");
    if (claim == nullptr) {
      return fail(node,
                  fmt::format("claim: no such claim {}{}; expected one of {}", node.shown(),
                              config::suggestion(exhibit_.claim, known), fmt::join(known, ", ")));
    }
    const Node* bound = root_.find("bound");
    if (!claim->has_bound) {
      if (bound != nullptr) {
        fail(*bound, fmt::format("bound: {} has none; expected no such key", exhibit_.claim));
      }
      return;
    }
    if (bound == nullptr) {
      return fail(root_, fmt::format("missing key 'bound'; expected a duration, the B of {}",
                                     exhibit_.claim));
    }
    const auto parsed = config::parse_duration(bound->is_scalar() ? bound->text : "");
    if (!parsed) return fail(*bound, fmt::format("bound: {}; expected a duration", bound->shown()));
    exhibit_.bound = *parsed;
  }

  void read_variants() {
    if (find(root_, "scenario", "", "a scenario") == nullptr) return;
    const Node* expect = find(root_, "expect", "", "a map with before and after");
    if (expect == nullptr) return;
    if (!failure_) failure_ = config::check_keys(*expect, "expect", {{"before", "after"}, {}});
    read_side("before", *expect, exhibit_.before);
    read_side("after", *expect, exhibit_.after);
    const Node* decoys = root_.find("decoys");
    if (failure_ || decoys == nullptr) return;
    if (!decoys->is_sequence()) {
      return fail(*decoys, fmt::format("decoys: {}; expected a list", decoys->shown()));
    }
    for (std::size_t k = 0; k < decoys->items.size() && !failure_; ++k) {
      const Node& node = decoys->items[k];
      const std::string path = fmt::format("decoys.{}", k);
      failure_ = config::check_keys(node, path, {{"title", "set", "expect"}, {}});
      Variant& decoy = exhibit_.decoys.emplace_back();
      decoy.title = text(node, "title", path);
      read_changes(node, "set", path, decoy);
      read_expected(node, "expect", path, decoy);
    }
  }
  void read_side(std::string_view key, const Node& expect, Variant& side) {
    read_changes(root_, key, "", side);
    read_expected(expect, key, "expect", side);
  }
  void read_expected(const Node& map, std::string_view key, std::string_view path, Variant& of) {
    const std::string word = text(map, key, path);
    if (failure_) return;
    if (word == "violated") {
      of.expected = props::VerdictKind::violated;
    } else if (word == "bounded") {
      of.expected = props::VerdictKind::bounded;
    } else if (word == "proved" && is_provable(exhibit_.claim)) {
      of.expected = props::VerdictKind::proved;
    } else {
      fail(*map.find(key),
           fmt::format("{}: {}; expected violated, bounded{}", config::join_path(path, key),
                       map.find(key)->shown(), is_provable(exhibit_.claim) ? " or proved" : ""));
    }
  }
  /// The scenario with the changes of the map at `key`.
  void read_changes(const Node& map, std::string_view key, std::string_view path, Variant& of) {
    const Node* changes = find(map, key, path, "a map of keys of the scenario");
    if (changes == nullptr) return;
    if (!changes->is_map()) {
      return fail(*changes, fmt::format("{}: {}; expected a map of keys of the scenario",
                                        config::join_path(path, key), changes->shown()));
    }
    std::vector<config::Override> overrides;
    for (const config::Member& member : changes->members) {
      of.changes.emplace_back(member.key, grids::flow_text(member.value));
      overrides.push_back({member.key, member.value});
    }
    auto resolved = config::with_profile_keys(
        config::with_profiles(*root_.find("scenario"), overrides, specs_), overrides, specs_);
    if (!resolved) {
      failure_ = resolved.error();
      return;
    }
    auto scenario = config::checked<model::Scenario>(resolved->tree);
    if (!scenario) {
      failure_ = scenario.error();
      return;
    }
    of.scenario = *std::move(scenario);
  }

  const Node& root_;
  const config::SpecPath& specs_;
  Exhibit exhibit_;
  std::optional<InputError> failure_;
};

/// "E8a" → 8: exhibits are ordered by number.
std::uint32_t number_of(const std::string& id) {
  std::uint32_t number = 0;
  const std::size_t digit = std::min(id.find_first_of("0123456789"), id.size());
  std::from_chars(id.data() + digit, id.data() + id.size(), number);
  return number;
}

}  // namespace

Result<Exhibit> read_exhibit(const std::string& reference, const config::SpecPath& specs) {
  const auto file = specs.find(config::SpecKind::museum, reference, "exhibit");
  if (!file) return file.error();
  const Result<Node> root = config::load_yaml(*file);
  if (!root) return root.error();
  return ExhibitReader{*root, specs}.read();
}

std::optional<std::vector<std::string>> profile_overrides(const Changes& changes) {
  const std::string prefix = std::string{config::dds_key} + ".";
  std::vector<std::string> overrides;
  for (const auto& [key, value] : changes) {
    if (!key.starts_with(prefix)) return std::nullopt;
    overrides.push_back(key.substr(prefix.size()) + "=" + value);
  }
  return overrides;
}

std::vector<std::string> exhibit_names(const config::SpecPath& specs) {
  std::vector<std::string> names = specs.names(config::SpecKind::museum);
  std::ranges::stable_sort(names, {}, number_of);
  return names;
}

}  // namespace stormproof::museum
