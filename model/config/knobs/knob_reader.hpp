// Fills a struct from a tree by visiting its knob table. The first mistake wins: the reader
// remembers it and leaves everything after it alone.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/core.h>

#include "model/config/knobs/knobs.hpp"
#include "model/config/knobs/scenario_knobs.hpp"
#include "model/config/knobs/value_types.hpp"
#include "model/config/tree/tree.hpp"

namespace stormproof::model::config {

/// The keys of a map: those that it may have, and those that only another implementation has.
struct KnownKeys {
  std::vector<std::string> allowed;
  std::vector<std::string> of_others;
  ImplementationKind implementation{};   ///< of the profile that the map is in, if it is in one
  std::optional<ServedBy> service = {};  ///< of a wireless profile
};

/// Collects the keys of one table, without those of its sections.
class KeyCollector {
 public:
  void knob(std::string_view key, auto&&, const auto&, std::string_view, Presence presence = {}) {
    add(key, presence);
  }
  void section(std::string_view key, auto&, std::string_view, Presence presence = {},
               const auto&...) {
    add(key, presence);
  }
  void list(std::string_view key, auto&, ListSize, std::string_view, Presence presence = {}) {
    add(key, presence);
  }
  void rule(bool, std::string_view, std::string_view) {}

  KnownKeys keys;

 private:
  void add(std::string_view key, Presence presence) {
    (presence == Presence::of_others ? keys.of_others : keys.allowed).emplace_back(key);
  }
};

/// The keys of a map for `sample`.
template <class T, class... Context>
KnownKeys keys_of(const T& sample, const Context&... context) {
  KeyCollector collector;
  visit_knobs(collector, sample, context...);
  [[maybe_unused]] const auto note = [&](const auto& one) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(one)>, ImplementationKind>) {
      collector.keys.implementation = one;
    }
  };
  (note(context), ...);
  if constexpr (std::same_as<T, DdsProfile>) note(sample.implementation);
  if constexpr (std::same_as<T, WirelessProfile>) collector.keys.service = sample.service;
  return std::move(collector.keys);
}

/// An error if `map` is no map or has a key that it may not have. `path` names the map in messages.
std::optional<InputError> check_keys(const Node& map, std::string_view path, const KnownKeys& keys);

template <class T, class... Context>
void read_knobs(const Node& map, const std::string& path, T& value,
                std::optional<InputError>& error, const Context&... context);
/// A deployment has two forms: the list of participants, and the short one. A schedule is drawn
/// here.
void read_knobs(const Node& map, const std::string& path, Deployment& value,
                std::optional<InputError>& error);
/// Defaults that depend on other keys: `endpoints_done` is `start` if it is absent.
void read_knobs(const Node& map, const std::string& path, Participant& value,
                std::optional<InputError>& error);
void read_knobs(const Node& map, const std::string& path, Schedule& value,
                std::optional<InputError>& error);
/// The implementation decides which keys there are.
void read_knobs(const Node& map, const std::string& path, DdsProfile& value,
                std::optional<InputError>& error);
/// The network decides what a DDS profile leaves to it.
void read_knobs(const Node& map, const std::string& path, Scenario& value,
                std::optional<InputError>& error);
/// What an access serves decides which keys there are. Packet delays are sorted; a packet has one
/// of them.
void read_knobs(const Node& map, const std::string& path, WirelessProfile& value,
                std::optional<InputError>& error);

class KnobReader {
 public:
  /// Reads the keys of `map`. The first mistake is left in `error`; nothing is read once it holds
  /// one.
  KnobReader(const Node& map, const std::string& path, std::optional<InputError>& error)
      : map_{map}, path_{path}, error_{error} {}

  template <class T>
  void knob(std::string_view key, T&& member, const auto& type, std::string_view,
            Presence presence = Presence::required) {
    if (presence == Presence::of_others) return;
    const Node* node = find(key, presence, [&type] { return type.expected(); });
    if (node == nullptr) return;
    Complaint complaint;
    if constexpr (requires { member.has_value(); }) {  // an optional value: present from now on
      complaint = type.read(*node, member.emplace());
    } else {
      complaint = type.read(*node, member);
    }
    if (complaint) {
      fail(complaint->place, fmt::format("{}: {}; expected {}", join_path(path_, key),
                                         complaint->reason, type.expected()));
    }
  }

  void section(std::string_view key, auto& member, std::string_view,
               Presence presence = Presence::required, const auto&... context) {
    if (presence == Presence::of_others) return;
    const Node* node = find(key, presence, [] { return "a map"; });
    if (node == nullptr) return;
    if constexpr (requires { member.emplace(); }) {  // an optional table: present from now on
      read_knobs(*node, join_path(path_, key), member.emplace(), error_, context...);
    } else {
      read_knobs(*node, join_path(path_, key), member, error_, context...);
    }
  }

  template <class Item>
  void list(std::string_view key, std::vector<Item>& members, ListSize size, std::string_view,
            Presence presence = Presence::required) {
    if (presence == Presence::of_others) return;
    const std::string expected = fmt::format("a list of {} to {} maps", size.minimum, size.maximum);
    const Node* node = find(key, presence, [&expected] { return expected; });
    if (node == nullptr) return;
    const std::string path = join_path(path_, key);
    if (!node->is_sequence()) {
      return fail(node->place,
                  fmt::format("{}: {} is not a list; expected {}", path, node->shown(), expected));
    }
    if (node->items.size() < size.minimum || node->items.size() > size.maximum) {
      return fail(node->place,
                  fmt::format("{}: a list of {}; expected {}", path, node->items.size(), expected));
    }
    members.assign(node->items.size(), Item{});
    for (std::size_t k = 0; k < members.size(); ++k) {
      read_knobs(node->items[k], fmt::format("{}.{}", path, k), members[k], error_);
    }
  }

  /// `key` may be dotted; it names the value that gets the blame.
  void rule(bool holds, std::string_view key, std::string_view expected);

 private:
  /// `expected` is called only if a required key is missing: what it says takes long to put
  /// together.
  const Node* find(std::string_view key, Presence presence, const auto& expected) {
    if (error_) return nullptr;
    const Node* node = map_.find(key);
    if (node == nullptr && presence == Presence::required) complain_missing(key, expected());
    return node;
  }
  void complain_missing(std::string_view key, std::string_view expected);
  void fail(const Place& place, std::string message);

  const Node& map_;
  const std::string& path_;
  std::optional<InputError>& error_;
};

/// Reads all keys of one table, with nothing special about it.
template <class T, class... Context>
void read_table(const Node& map, const std::string& path, T& value,
                std::optional<InputError>& error, const Context&... context) {
  if (!error) error = check_keys(map, path, keys_of(value, context...));
  if (error) return;
  KnobReader reader{map, path, error};
  visit_knobs(reader, value, context...);
}

template <class T, class... Context>
void read_knobs(const Node& map, const std::string& path, T& value,
                std::optional<InputError>& error, const Context&... context) {
  read_table(map, path, value, error, context...);
}

/// The last step of reading: the tables take the values of a resolved tree, within their ranges.
template <class Value>
[[nodiscard]] Result<Value> checked(const Node& resolved) {
  Value value;
  std::optional<InputError> error;
  read_knobs(resolved, "", value, error);
  if (error) return *std::move(error);
  return value;
}

}  // namespace stormproof::model::config
