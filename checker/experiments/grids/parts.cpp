// An override concerns one part, so a part is resolved like a scenario that has no other. Profiles
// are remembered before overrides of their keys, for all parts that are built on them.
#include "checker/experiments/grids/parts.hpp"

#include <fmt/format.h>

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/resolve.hpp"
#include "model/implementations.hpp"

namespace stormproof::grids {

namespace config = model::config;
using config::Node;
using model::Scenario;

namespace {

constexpr std::string_view deployment_key = "deployment";
const std::string at_top;  ///< the path of a scenario's own keys

/// Reads those keys of a scenario that belong to a part.
template <class IsPart>
class PartVisitor {
 public:
  PartVisitor(config::KnobReader& reader, const IsPart& is_part)
      : reader_{reader}, is_part_{is_part} {}

  void knob(std::string_view key, auto&&... arguments) {
    if (is_part_(key)) reader_.knob(key, std::forward<decltype(arguments)>(arguments)...);
  }
  void section(std::string_view key, auto& member, auto&&... arguments) {
    if (is_part_(key)) reader_.section(key, member, arguments...);
  }
  void rule(bool, std::string_view, std::string_view) {}

 private:
  config::KnobReader& reader_;
  const IsPart& is_part_;
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

template <class IsPart>
Scenario read_part(const Node& root, const IsPart& is_part,
                   std::optional<config::InputError>& failure) {
  Scenario scenario;
  failure = config::check_keys(root, at_top, config::keys_of(scenario));
  config::KnobReader reader{root, at_top, failure};
  PartVisitor visitor{reader, is_part};
  config::visit_knobs(visitor, scenario);
  return scenario;
}

Digest digest_of(const Rest& rest) {
  std::string text = fmt::format("time_limit {}\nrun_until {}\n", rest.time_limit.count(),
                                 static_cast<int>(rest.run_until));
  if (rest.hosts) {
    // A new member has to be named here; it would not compile otherwise.
    const auto& [cores, reception, emission, submessage, timer, low, high, seed] = *rest.hosts;
    text +=
        fmt::format("hosts {} {} {} {} {} {} {} {}\n", cores, reception.count(), emission.count(),
                    submessage.count(), timer.count(), low.count(), high.count(), seed);
  }
  return grids::digest_of(text);
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
  Node root = Node::map(whole.place);
  for (const config::Member& member : whole.members) {
    if (kind_of(member.key) == kind) root.members.push_back(member);
  }
  return root;
}

PartReader::Tree PartReader::tree(const Choice& choice, Kind kind) {
  const std::vector<config::Override> overrides = changes(choice, kind);
  const std::size_t implementation = kind == Kind::wireless ? implementation_of(choice) : 0;
  const auto chosen = [&] {
    const std::string_view name = model::implementation_traits[implementation].name;
    return config::with_profiles(part_root(choice.variant, kind), overrides, specs_, name);
  };
  if (kind == Kind::rest) return config::with_profile_keys(chosen(), overrides, specs_);
  if (kind != Kind::dds && kind != Kind::wireless) return chosen();
  Memory& memory = memory_[kind];
  Key key = key_of(choice, memory.choosing);
  key.push_back(implementation);
  auto profile = memory.profiles.find(key);
  if (profile == memory.profiles.end()) profile = memory.profiles.emplace(key, chosen()).first;
  return config::with_profile_keys(profile->second, overrides, specs_);
}

/// A wireless profile can be another one with another implementation.
std::size_t PartReader::implementation_of(const Choice& choice) {
  const auto [entry, is_new] =
      implementations_.try_emplace(key_of(choice, memory_[Kind::dds].choosing), 0);
  if (!is_new) return entry->second;
  const Tree whole = tree(choice, Kind::dds);
  const Node* dds = whole ? whole->tree.find(config::dds_key) : nullptr;
  if (dds == nullptr || !dds->is_map()) return 0;
  const std::string_view name = config::implementation_of(*dds);
  for (const model::ImplementationKind kind : model::implementations) {
    if (model::traits_of(kind).name == name) entry->second = model::index_of(kind);
  }
  return entry->second;
}

template <class T, class ValueOf>
std::uint32_t PartReader::part_number(const Choice& choice, Kind kind, std::vector<Part<T>>& parts,
                                      const ValueOf& value_of) {
  Memory& memory = memory_[kind];
  Key key = key_of(choice, memory.axes);
  if (kind == Kind::wireless) key.push_back(implementation_of(choice));
  const auto [entry, is_new] =
      memory.numbers.try_emplace(std::move(key), static_cast<std::uint32_t>(parts.size()));
  if (!is_new) return entry->second;
  Part<T>& part = parts.emplace_back();
  const Tree root = tree(choice, kind);
  if (!root) {
    part.error = root.error();
    return entry->second;
  }
  const auto is_part = [kind](std::string_view key) { return kind_of(key) == kind; };
  const Scenario scenario = read_part(root->tree, is_part, part.error);
  if (part.error) return entry->second;
  part.value = value_of(scenario);
  part.digest = digest_of(part.value);
  return entry->second;
}

PartNumbers PartReader::read(const Choice& choice) {
  PartNumbers numbers;
  numbers.deployment = part_number(choice, Kind::deployment, deployments,
                                   [](const Scenario& s) { return s.deployment; });
  numbers.dds = part_number(choice, Kind::dds, dds, [](const Scenario& s) { return s.dds; });
  numbers.wireless =
      part_number(choice, Kind::wireless, wireless, [](const Scenario& s) { return s.wireless; });
  numbers.rest = part_number(choice, Kind::rest, rests, [](const Scenario& s) {
    return Rest{s.time_limit, s.run_until, s.hosts};
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
  scenario.hosts = rests[numbers.rest].value.hosts;
  RuleVisitor rules{nullptr};
  config::visit_knobs(rules, scenario);
  if (rules.all_hold) return std::nullopt;

  Node root = Node::map(grid_.variants[choice.variant].root.place);
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
