// The parts of reading that do not depend on the table, and the two forms of a deployment.
#include "model/config/knob_reader.hpp"

#include <algorithm>

#include <fmt/ranges.h>

#include "model/config/suggestion.hpp"

namespace stormproof::model::config {
namespace {

/// " in dds.sedp", or nothing at the top.
std::string inside(std::string_view path) {
  return path.empty() ? std::string{} : fmt::format(" in {}", path);
}

}  // namespace

std::string join_path(std::string_view path, std::string_view key) {
  return path.empty() ? std::string{key} : fmt::format("{}.{}", path, key);
}

std::optional<InputError> check_keys(const Node& map, std::string_view path,
                                     const std::vector<std::string>& keys) {
  if (!map.is_map()) {
    const std::string name = path.empty() ? std::string{} : fmt::format("{}: ", path);
    return error_at(map.place, fmt::format("{}{} is not a map; expected the keys {}", name,
                                           map.shown(), fmt::join(keys, ", ")));
  }
  for (const Member& member : map.members) {
    if (std::ranges::find(keys, member.key) != keys.end()) continue;
    std::string hint = suggestion(member.key, keys);
    if (hint.empty()) hint = fmt::format("; expected one of {}", fmt::join(keys, ", "));
    return error_at(member.key_place,
                    fmt::format("unknown key {}{}{}", quote(member.key), inside(path), hint));
  }
  return std::nullopt;
}

const Node* KnobReader::find(std::string_view key, Presence presence, std::string_view expected) {
  if (error_) return nullptr;
  const Node* node = map_.find(key);
  if (node == nullptr && presence == Presence::required) {
    fail(map_.place, fmt::format("missing key '{}'{}; expected {}", key, inside(path_), expected));
  }
  return node;
}

void KnobReader::fail(const Place& place, std::string message) {
  if (!error_) error_ = error_at(place, std::move(message));
}

void KnobReader::rule(bool holds, std::string_view key, std::string_view expected) {
  if (holds || error_) return;
  const Node* node = &map_;
  for (std::string_view rest = key; node != nullptr && !rest.empty();) {
    const std::size_t dot = std::min(rest.find('.'), rest.size());
    node = node->find(rest.substr(0, dot));
    rest.remove_prefix(std::min(dot + 1, rest.size()));
  }
  const Node& blamed = node != nullptr ? *node : map_;
  fail(blamed.place,
       fmt::format("{}: {}; expected {}", join_path(path_, key), blamed.shown(), expected));
}

void read_knobs(const Node& map, const std::string& path, Deployment& value,
                std::optional<InputError>& error) {
  const std::vector<std::string> of_list = keys_of<Deployment>();
  const std::vector<std::string> of_form = keys_of<HomogeneousForm>();
  std::vector<std::string> both = of_form;
  both.insert(both.end(), of_list.begin(), of_list.end());
  if (!error) error = check_keys(map, path, both);
  if (error) return;

  KnobReader reader{map, path, error};
  const bool is_list =
      std::ranges::any_of(of_list, [&](const std::string& key) { return map.find(key); });
  if (!is_list) {
    HomogeneousForm form;
    visit_knobs(reader, form);
    if (error) return;
    value = Deployment::homogeneous(form.hosts, form.participants_per_host,
                                    form.endpoints_per_participant);
    return;
  }
  for (const Member& member : map.members) {
    if (std::ranges::find(of_form, member.key) == of_form.end()) continue;
    error = error_at(member.key_place,
                     fmt::format("{}: not together with {}; expected only one of the two forms",
                                 join_path(path, member.key), of_list.front()));
    return;
  }
  visit_knobs(reader, value);
}

}  // namespace stormproof::model::config
