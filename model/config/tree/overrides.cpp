// An override is parsed like a file of its own; then every node of it is placed at the argument.
#include "model/config/tree/overrides.hpp"

#include <fmt/core.h>

#include "model/config/tree/yaml_text.hpp"

namespace stormproof::model::config {
namespace {

void place_all(Node& node, const Place& place) {
  node.place = place;
  for (Node& item : node.items) place_all(item, place);
  for (Member& member : node.members) {
    member.key_place = place;
    place_all(member.value, place);
  }
}

Result<Override> parse_override(const std::string& argument) {
  const std::string source = "--set " + argument;
  const std::size_t equals = argument.find('=');
  if (equals == std::string::npos || equals == 0) {
    return InputError{
        source, fmt::format("{} is not an override; expected key.path=value", quote(argument))};
  }
  Result<Node> value = parse_yaml(std::string_view{argument}.substr(equals + 1), source);
  if (!value) return InputError{source, value.error().message};
  place_all(*value, Place{std::make_shared<const std::string>(source), 0, 0});
  return Override{argument.substr(0, equals), *std::move(value)};
}

}  // namespace

Result<std::vector<Override>> parse_overrides(std::span<const std::string> arguments) {
  std::vector<Override> overrides;
  for (const std::string& argument : arguments) {
    Result<Override> parsed = parse_override(argument);
    if (!parsed) return parsed.error();
    overrides.push_back(*std::move(parsed));
  }
  return overrides;
}

std::optional<InputError> apply(const Override& change, Node& root) {
  const auto complaint = set_path(root, change.path, change.value);
  if (!complaint) return std::nullopt;
  return error_at(change.value.place, *complaint);
}

}  // namespace stormproof::model::config
