// The parts of reading that do not depend on the table, and the tables with keys that depend on
// each other: the two forms of a deployment, its schedule, the implementations.
#include "model/config/knobs/knob_reader.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include <fmt/ranges.h>

#include "model/config/tree/suggestion.hpp"
#include "model/nodes.hpp"

namespace stormproof::model::config {
namespace {

/// " in dds.sedp", or nothing at the top.
std::string inside(std::string_view path) {
  return path.empty() ? std::string{} : fmt::format(" in {}", path);
}

bool contains(const std::vector<std::string>& keys, const std::string& key) {
  return std::ranges::find(keys, key) != keys.end();
}

/// All keys of a table and its sections that its implementation has, dotted.
class DottedKeys {
 public:
  explicit DottedKeys(std::string prefix = {}) : prefix_{std::move(prefix)} {}

  void knob(std::string_view key, auto&&, const auto&, std::string_view, Presence presence = {}) {
    if (presence != Presence::of_others) keys.insert(prefix_ + std::string{key});
  }
  void section(std::string_view key, auto& member, std::string_view, Presence presence = {},
               const auto&... context) {
    if (presence == Presence::of_others) return;
    keys.insert(prefix_ + std::string{key});
    DottedKeys inner{prefix_ + std::string{key} + "."};
    if constexpr (requires { member.has_value(); }) {
      typename std::remove_cvref_t<decltype(member)>::value_type present;
      visit_knobs(inner, present, context...);
    } else {
      visit_knobs(inner, member, context...);
    }
    keys.merge(inner.keys);
  }
  void rule(bool, std::string_view, std::string_view) {}

  std::set<std::string> keys;

 private:
  std::string prefix_;
};

std::string named(ImplementationKind kind) {
  if (kind != implementation_of(kind)) {
    return fmt::format("{}: {}", discovery_key,
                       traits_of(kind).has_server ? "server or super_client" : "static");
  }
  return fmt::format("{}: {}", implementation_key, traits_of(kind).name);
}

/// "implementation: paper": those whose profiles have the key of the map at `path`, which ends with
/// the section of the profile, if it is in one.
std::string implementations_with(std::string_view path, const std::string& key) {
  std::vector<std::string> shown;
  const std::string dotted = join_path(path, key);
  const auto ends_with_key = [&](const std::string& known) {
    const bool whole =
        dotted.size() == known.size() ||
        (dotted.size() > known.size() && dotted[dotted.size() - known.size() - 1] == '.');
    return whole && dotted.ends_with(known);
  };
  for (const ImplementationKind kind : implementations) {
    DdsProfile profile;
    profile.implementation = kind;
    DottedKeys visitor;
    visit_knobs(visitor, profile);
    if (std::ranges::any_of(visitor.keys, ends_with_key)) shown.push_back(named(kind));
  }
  for (const Discovery discovery : {Discovery::server, Discovery::static_peers}) {
    if (!shown.empty()) break;
    DdsProfile profile;
    profile.implementation = implementation_with_discovery;
    profile.discovery = discovery;
    DottedKeys visitor;
    visit_knobs(visitor, profile);
    if (std::ranges::any_of(visitor.keys, ends_with_key)) shown.push_back(named(kind_of(profile)));
  }
  return fmt::format("{}", fmt::join(shown, " and "));
}

}  // namespace

std::optional<InputError> check_keys(const Node& map, std::string_view path,
                                     const KnownKeys& keys) {
  if (!map.is_map()) {
    const std::string name = path.empty() ? std::string{} : fmt::format("{}: ", path);
    return error_at(map.place, fmt::format("{}{} is not a map; expected the keys {}", name,
                                           map.shown(), fmt::join(keys.allowed, ", ")));
  }
  for (const Member& member : map.members) {
    if (contains(keys.allowed, member.key)) continue;
    if (contains(keys.of_others, member.key) && keys.service) {
      const bool by_unit = *keys.service == ServedBy::unit;
      return error_at(
          member.key_place,
          fmt::format("{0}: only {1}: {2} has this key; expected none of it in a profile with {1}: "
                      "{3}",
                      join_path(path, member.key), service_key, by_unit ? "frame" : "unit",
                      name_of(*keys.service)));
    }
    if (contains(keys.of_others, member.key)) {
      return error_at(
          member.key_place,
          fmt::format("{}: only {} has this key; expected none of it in a profile with "
                      "{}",
                      join_path(path, member.key), implementations_with(path, member.key),
                      named(keys.implementation)));
    }
    std::string hint = suggestion(member.key, keys.allowed);
    if (hint.empty()) hint = fmt::format("; expected one of {}", fmt::join(keys.allowed, ", "));
    return error_at(member.key_place,
                    fmt::format("unknown key {}{}{}", quote(member.key), inside(path), hint));
  }
  return std::nullopt;
}

void KnobReader::complain_missing(std::string_view key, std::string_view expected) {
  fail(map_.place, fmt::format("missing key '{}'{}; expected {}", key, inside(path_), expected));
}

void KnobReader::fail(const Place& place, std::string message) {
  if (!error_) error_ = error_at(place, std::move(message));
}

namespace {
/// The value of a key, or of a number in a list; null if there is none.
const Node* below(const Node& node, std::string_view key) {
  if (!node.is_sequence()) return node.find(key);
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number);
  const bool is_number = error == std::errc{} && end == key.data() + key.size();
  return is_number && number < node.items.size() ? &node.items[number] : nullptr;
}
}  // namespace

void KnobReader::rule(bool holds, std::string_view key, std::string_view expected) {
  if (holds || error_) return;
  const Node* node = &map_;
  for (std::string_view rest = key; node != nullptr && !rest.empty();) {
    const std::size_t dot = std::min(rest.find('.'), rest.size());
    node = below(*node, rest.substr(0, dot));
    rest.remove_prefix(std::min(dot + 1, rest.size()));
  }
  const Node& blamed = node != nullptr ? *node : map_;
  const std::string name = join_path(path_, key);
  if (blamed.is_map()) return fail(blamed.place, fmt::format("{}: expected {}", name, expected));
  fail(blamed.place, fmt::format("{}: {}; expected {}", name, blamed.shown(), expected));
}

namespace {

/// A time that is given beside a schedule has to be the one that the schedule draws; otherwise a
/// new seed would silently change nothing.
void check_time(const Node& participant, const std::string& path, std::string_view key,
                Nanoseconds given, Nanoseconds drawn, std::optional<InputError>& error) {
  const Node* node = participant.find(key);
  if (error || node == nullptr || given == drawn) return;
  error = error_at(node->place,
                   fmt::format("{}: {}; expected {}, which the schedule draws, or no {} at all",
                               join_path(path, key), node->shown(), print_duration(drawn), key));
}

/// Draws the schedule. `list` holds the participants, if they are given one by one.
void draw(Deployment& deployment, const Node* list, const std::string& path,
          std::optional<InputError>& error) {
  const std::vector<Participant> given = deployment.participants;
  deployment.draw_schedule(deployment.schedule->seed);
  for (std::size_t k = 0; list != nullptr && k < given.size(); ++k) {
    const Participant& drawn = deployment.participants[k];
    const std::string name = fmt::format("{}.{}.{}", path, participants_key, k);
    check_time(list->items[k], name, start_key, given[k].start, drawn.start, error);
    check_time(list->items[k], name, endpoints_done_key, given[k].endpoints_done,
               drawn.endpoints_done, error);
    if (!deployment.schedule->open_before) continue;
    check_time(list->items[k], name, open_key, given[k].open.value_or(*drawn.open), *drawn.open,
               error);
  }
}

void add_new(const std::vector<std::string>& keys, std::vector<std::string>& all) {
  for (const std::string& key : keys) {
    if (!contains(all, key)) all.push_back(key);
  }
}

/// Keys of another form of a deployment than that which `form` has begun.
void refuse_others(const Node& map, const std::string& path, const std::vector<std::string>& known,
                   std::string_view form, std::optional<InputError>& error) {
  for (const Member& member : map.members) {
    if (error || contains(known, member.key)) continue;
    error = error_at(member.key_place,
                     fmt::format("{}: not together with {}; expected only one of the two forms",
                                 join_path(path, member.key), form));
  }
}

Deployment deployment_of(const NodesForm& form) {
  Deployment nodes;
  for (std::uint32_t host = 0; host < form.hosts; ++host) {
    for (const NodeEntry& node : form.nodes) {
      for (std::uint32_t k = 0; k < node.count; ++k) {
        nodes.participants.push_back(
            {HostId{host}, node.publications, node.subscriptions, Nanoseconds{0}, Nanoseconds{0}});
      }
    }
  }
  return sharing_participants(nodes, form.nodes_per_participant);
}

Deployment deployment_of(const HomogeneousForm& form) {
  return Deployment::homogeneous(form.hosts, form.participants_per_host,
                                 form.endpoints_per_participant, form.nodes_per_participant);
}

bool lists_hosts(const Node& map) {
  const Node* hosts = map.find(hosts_key);
  return hosts != nullptr && hosts->is_sequence();
}

/// Reads a form that says how many hosts there are. They may be a list, which is as long as their
/// number.
template <class Form>
void read_form(const Node& map, const std::string& path, Deployment& value,
               std::optional<InputError>& error) {
  Node counted = map;
  if (lists_hosts(map)) {
    Node& hosts = *counted.find(hosts_key);
    hosts = Node::scalar(hosts.place, fmt::to_string(hosts.items.size()));
  }
  Form form;
  KnobReader of_form{counted, path, error};
  visit_knobs(of_form, form);
  if (error) return;
  value = deployment_of(form);
  KnobReader reader{map, path, error};
  if (lists_hosts(map)) visit_hosts(reader, value);
  visit_common_knobs(reader, value);
}

/// The profile of a host is that of its participants. Hosts that have nothing else to say are
/// those that nobody lists.
void hand_out_profiles(Deployment& deployment) {
  bool some = false;
  for (Participant& participant : deployment.participants) {
    if (participant.host.value >= deployment.hosts.size()) continue;
    const Shared<DdsProfile>& of_host = deployment.hosts[participant.host.value].dds;
    if (of_host && !participant.dds) participant.dds = of_host;
  }
  for (Host& host : deployment.hosts) {
    some = some || host.dds.has_value();
    host.dds.reset();
  }
  const auto is_plain = [](const Host& host) {
    return host.link == Link::wireless && !host.rate && !host.access_point && !host.power_save;
  };
  if (some && deployment.access_points.empty() && std::ranges::all_of(deployment.hosts, is_plain)) {
    deployment.hosts.clear();
  }
}

void check_fleet(const Node& map, const std::string& path, const Deployment& value,
                 std::optional<InputError>& error) {
  if (error) return;
  const std::optional<FleetFault> fault = fault_of_fleet(value);
  if (!fault) return;
  const Node* blamed = map.find(fault->list);
  std::string name = join_path(path, fault->list);
  if (blamed != nullptr && fault->item < blamed->items.size()) {
    blamed = &blamed->items[fault->item];
    name = fmt::format("{}.{}", name, fault->item);
    if (const Node* inner = blamed->find(fault->key); inner != nullptr) {
      blamed = inner;
      name = join_path(name, fault->key);
    }
  }
  const Node& node = blamed != nullptr ? *blamed : map;
  error =
      error_at(node.place, fmt::format("{}: {}; expected {}", name, node.shown(), fault->expected));
}

}  // namespace

void read_knobs(const Node& map, const std::string& path, Deployment& value,
                std::optional<InputError>& error) {
  const std::vector<std::string> of_form = keys_of(HomogeneousForm{}).allowed;
  const std::vector<std::string> of_nodes = keys_of(NodesForm{}).allowed;
  std::vector<std::string> of_list = keys_of(value).allowed;
  KnownKeys all{of_form, {}};
  add_new(of_nodes, all.allowed);
  add_new(of_list, all.allowed);
  if (!error) error = check_keys(map, path, all);
  if (error) return;

  const Node* list = map.find(participants_key);
  if (list != nullptr) {
    if (!lists_hosts(map)) std::erase(of_list, hosts_key);
    refuse_others(map, path, of_list, participants_key, error);
    KnobReader reader{map, path, error};
    visit_knobs(reader, value);
  } else if (map.find(nodes_key) != nullptr) {
    std::vector<std::string> known = of_nodes;
    add_new(of_list, known);
    refuse_others(map, path, known, nodes_key, error);
    read_form<NodesForm>(map, path, value, error);
  } else {
    read_form<HomogeneousForm>(map, path, value, error);
  }
  check_fleet(map, path, value, error);
  if (!error) hand_out_profiles(value);
  if (!error && value.schedule) draw(value, list, path, error);
}

void read_knobs(const Node& map, const std::string& path, Participant& value,
                std::optional<InputError>& error) {
  read_table(map, path, value, error);
  if (error) return;
  if (map.find(endpoints_done_key) == nullptr) value.endpoints_done = value.start;
  KnobReader reader{map, path, error};
  reader.rule(value.endpoints_done >= value.start, endpoints_done_key,
              fmt::format("at least its start of {}", print_duration(value.start)));
  reader.rule(value.open.value_or(value.start) <= value.start, open_key,
              fmt::format("at most its start of {}", print_duration(value.start)));
  reader.rule(value.ready.value_or(value.start) >= value.start, ready_key,
              fmt::format("at least its start of {}", print_duration(value.start)));
}

void read_knobs(const Node& map, const std::string& path, Schedule& value,
                std::optional<InputError>& error) {
  read_table(map, path, value, error);
  if (error || map.find(endpoints_done_key) != nullptr) return;
  value.endpoints_done_min = value.start_min;
  value.endpoints_done_max = value.start_max;
}

void read_knobs(const Node& map, const std::string& path, DdsProfile& value,
                std::optional<InputError>& error) {
  // What is wrong with the word, if anything, is said when all keys are read.
  const Node* word = map.find(implementation_key);
  if (word != nullptr) (void)ChoiceType<ImplementationKind>{}.read(*word, value.implementation);
  const Node* way = map.find(discovery_key);
  if (way != nullptr && with_discovery(value.implementation) != Presence::of_others) {
    (void)ChoiceType<Discovery>{}.read(*way, value.discovery);
  }
  read_table(map, path, value, error);
}

void read_knobs(const Node& map, const std::string& path, Scenario& value,
                std::optional<InputError>& error) {
  read_table(map, path, value, error);
  choose_multicast(value);
  choose_lease(value);
}

void read_knobs(const Node& map, const std::string& path, WirelessProfile& value,
                std::optional<InputError>& error) {
  const Node* word = map.find(service_key);
  if (word != nullptr) (void)ChoiceType<ServedBy>{}.read(*word, value.service);
  if (value.service == ServedBy::unit) value.fragment_request = FragmentRequest::at_admission;
  read_table(map, path, value, error);
  if (error || value.packet_delays.empty()) return;
  const Node& list = *map.find(packet_delays_key);
  std::set<std::uint64_t> packets;
  for (std::size_t k = 0; k < value.packet_delays.size(); ++k) {
    const Node& packet = *list.items[k].find(packet_key);
    if (packets.insert(value.packet_delays[k].packet).second) continue;
    const std::string name = fmt::format("{}.{}.{}", packet_delays_key, k, packet_key);
    error = error_at(packet.place,
                     fmt::format("{}: packet {} is given twice; expected one entry for each packet",
                                 join_path(path, name), packet.shown()));
    return;
  }
  std::ranges::sort(value.packet_delays, {}, &PacketDelay::packet);
}

}  // namespace stormproof::model::config
