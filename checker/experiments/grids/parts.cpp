// An override concerns one part, so a part is resolved like a scenario that has no other. Profiles
// are remembered before overrides of their keys, for all parts that are built on them.
#include "checker/experiments/grids/parts.hpp"

#include <fmt/format.h>

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/resolve.hpp"

namespace stormproof::grids {

namespace config = model::config;
using config::error_at;
using config::Node;
using model::Scenario;

namespace {

constexpr std::string_view deployment_key = "deployment";
const std::string at_top;  ///< the path of a scenario's own keys

bool is_large_part(std::string_view key) {
  return key == deployment_key || key == config::dds_key || key == config::wireless_key;
}

/// Reads what a scenario has beside its large parts.
class RestVisitor {
 public:
  explicit RestVisitor(config::KnobReader& reader) : reader_{reader} {}

  void knob(auto&&... arguments) { reader_.knob(std::forward<decltype(arguments)>(arguments)...); }
  void section(std::string_view key, auto& member, auto&&... arguments) {
    if (!is_large_part(key)) reader_.section(key, member, arguments...);
  }
  void rule(bool, std::string_view, std::string_view) {}

 private:
  config::KnobReader& reader_;
};

/// Looks at nothing but the rules between the parts. Without a reader it only says whether all
/// hold.
class RuleVisitor {
 public:
  explicit RuleVisitor(config::KnobReader* reader) : reader_{reader} {}

  void knob(auto&&...) {}
  void section(auto&&...) {}
  void rule(bool holds, std::string_view key, std::string_view expected) {
    all_hold = all_hold && holds;
    if (reader_ != nullptr) reader_->rule(holds, key, expected);
  }

  bool all_hold = true;

 private:
  config::KnobReader* reader_;
};

template <class T>
void read_section(const Node& root, std::string_view key, T& value,
                  std::optional<config::InputError>& failure) {
  if (failure) return;
  const Node* node = root.find(key);
  if (node == nullptr) {
    failure = error_at(root.place, fmt::format("missing key '{}'; expected a map", key));
  } else {
    read_knobs(*node, std::string{key}, value, failure);
  }
}

void read_rest(const Node& root, Rest& rest, std::optional<config::InputError>& failure) {
  Scenario scenario;
  config::KnownKeys keys = config::keys_of(scenario);
  if (!failure) failure = config::check_keys(root, "", keys);
  config::KnobReader reader{root, at_top, failure};
  RestVisitor visitor{reader};
  config::visit_knobs(visitor, scenario);
  rest = {scenario.time_limit, scenario.run_until};
}

}  // namespace

PartReader::PartReader(const Grid& grid, const config::SpecPath& specs)
    : grid_{grid}, specs_{specs} {
  for (std::size_t k = 0; k < grid.axes.size(); ++k) {
    const std::string& path = grid.axes[k].key;
    const Kind kind = kind_of(path);
    memory_[kind].axes.push_back(k);
    if (!config::is_profile_key(path)) memory_[kind].choosing.push_back(k);
  }
}

PartReader::Kind PartReader::kind_of(std::string_view path) {
  const std::string_view first = path.substr(0, path.find('.'));
  if (first == deployment_key) return Kind::deployment;
  if (first == config::dds_key) return Kind::dds;
  if (first == config::wireless_key) return Kind::wireless;
  return Kind::rest;
}

PartReader::Key PartReader::key_of(const Choice& choice, const std::vector<std::size_t>& axes) {
  Key key{choice.variant};
  for (const std::size_t axis : axes) key.push_back(choice.values[axis]);
  return key;
}

std::vector<config::Override> PartReader::changes(const Choice& choice, Kind kind) const {
  std::vector<config::Override> list;
  for (const config::Override& change : grid_.variants[choice.variant].overrides) {
    if (kind_of(change.path) == kind) list.push_back(change);
  }
  const auto memory = memory_.find(kind);
  if (memory == memory_.end()) return list;
  for (const std::size_t axis : memory->second.axes) {
    const Axis& changed = grid_.axes[axis];
    list.push_back({changed.key, changed.values[choice.values[axis]].node});
  }
  return list;
}

Node PartReader::part_root(std::size_t variant, Kind kind) const {
  const Node& whole = grid_.variants[variant].root;
  Node root{Node::Kind::map, whole.place};
  for (const config::Member& member : whole.members) {
    if (kind_of(member.key) == kind) root.members.push_back(member);
  }
  return root;
}

PartReader::Tree PartReader::tree(const Choice& choice, Kind kind) {
  const std::vector<config::Override> overrides = changes(choice, kind);
  const auto chosen = [&] {
    return config::with_profiles(part_root(choice.variant, kind), overrides, specs_);
  };
  if (kind != Kind::dds && kind != Kind::wireless) return chosen();
  Memory& memory = memory_[kind];
  const Key key = key_of(choice, memory.choosing);
  auto profile = memory.profiles.find(key);
  if (profile == memory.profiles.end()) profile = memory.profiles.emplace(key, chosen()).first;
  return config::with_profile_keys(profile->second, overrides);
}

template <class T, class Read>
std::uint32_t PartReader::part_number(const Choice& choice, Kind kind, std::vector<Part<T>>& parts,
                                      const Read& read) {
  Memory& memory = memory_[kind];
  const auto [entry, is_new] = memory.numbers.try_emplace(key_of(choice, memory.axes),
                                                          static_cast<std::uint32_t>(parts.size()));
  if (!is_new) return entry->second;
  Part<T>& part = parts.emplace_back();
  const Tree root = tree(choice, kind);
  if (root) {
    read(root->tree, part);
  } else {
    part.error = root.error();
  }
  return entry->second;
}

PartNumbers PartReader::read(const Choice& choice) {
  const auto section = [](std::string_view key) {
    return [key](const Node& root, auto& part) {
      read_section(root, key, part.value, part.error);
      if (!part.error) part.digest = digest_of(part.value);
    };
  };
  PartNumbers numbers;
  numbers.deployment = part_number(choice, Kind::deployment, deployments, section(deployment_key));
  numbers.dds = part_number(choice, Kind::dds, dds, section(config::dds_key));
  numbers.wireless = part_number(choice, Kind::wireless, wireless, section(config::wireless_key));
  numbers.rest = part_number(choice, Kind::rest, rests, [](const Node& root, Part<Rest>& part) {
    read_rest(root, part.value, part.error);
    if (part.error) return;
    const Rest& rest = part.value;
    part.digest = digest_of(fmt::format("time_limit {}\nrun_until {}\n", rest.time_limit.count(),
                                        static_cast<int>(rest.run_until)));
  });
  return numbers;
}

bool PartReader::parts_are_right(const PartNumbers& numbers) const {
  return !deployments[numbers.deployment].error && !dds[numbers.dds].error &&
         !wireless[numbers.wireless].error && !rests[numbers.rest].error;
}

std::optional<config::InputError> PartReader::error(const Choice& choice,
                                                    const PartNumbers& numbers) {
  // Unknown keys of the scenario come first, as they do when a scenario is read.
  for (const auto* failure : {&rests[numbers.rest].error, &deployments[numbers.deployment].error,
                              &dds[numbers.dds].error, &wireless[numbers.wireless].error}) {
    if (*failure) return *failure;
  }
  Scenario scenario;
  scenario.deployment = deployments[numbers.deployment].value;
  scenario.dds = dds[numbers.dds].value;
  scenario.wireless = wireless[numbers.wireless].value;
  RuleVisitor rules{nullptr};
  config::visit_knobs(rules, scenario);
  if (rules.all_hold) return std::nullopt;

  Node root{Node::Kind::map, grid_.variants[choice.variant].root.place};
  for (const Kind kind : {Kind::deployment, Kind::dds, Kind::wireless}) {
    const Tree part = tree(choice, kind);
    for (const config::Member& member : part->tree.members) root.members.push_back(member);
  }
  std::optional<config::InputError> failure;
  config::KnobReader reader{root, at_top, failure};
  RuleVisitor blaming{&reader};
  config::visit_knobs(blaming, scenario);
  return failure;
}

}  // namespace stormproof::grids
