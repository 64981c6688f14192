// Names are found without regard to case, as the library finds them; old names lead to new paths.
#include "model/config/vendor/cyclonedds_domain.hpp"

#include <algorithm>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "model/config/tree/suggestion.hpp"
#include "model/config/vendor/any_case.hpp"
#include "model/config/vendor/variables.hpp"

namespace stormproof::model::config::vendor {
namespace {

/// Whether `path` is `prefix` or lies below it.
bool starts_with_path(std::string_view path, std::string_view prefix) {
  if (path.size() < prefix.size() || !is_same_word(path.substr(0, prefix.size()), prefix)) {
    return false;
  }
  return path.size() == prefix.size() || path[prefix.size()] == '/' || path[prefix.size()] == '[';
}

/// `path` in the spelling of the table if it is a setting or a group, otherwise empty.
std::string_view canonical(std::string_view path, CycloneVersion version) {
  for (const CycloneOption& option : cyclone_options(version)) {
    if (starts_with_path(option.path, path)) return option.path.substr(0, path.size());
  }
  for (const CycloneGroup& group : cyclone_opaque_groups(version)) {
    if (is_same_word(group.path, path)) return group.path;
  }
  return {};
}

const CycloneOption* find_option(std::string_view path, CycloneVersion version) {
  const auto options = cyclone_options(version);
  const auto found = std::ranges::find(options, path, &CycloneOption::path);
  return found == options.end() ? nullptr : &*found;
}

/// What may stand beside `path`, to suggest a name.
std::vector<std::string> names_below(std::string_view parent, bool attributes,
                                     CycloneVersion version) {
  std::set<std::string> names;
  for (const CycloneOption& option : cyclone_options(version)) {
    std::string_view rest = option.path;
    if (!parent.empty()) {
      if (!starts_with_path(rest, parent) || rest.size() == parent.size()) continue;
      rest.remove_prefix(parent.size());
    }
    if (rest.starts_with("[@") != attributes) continue;
    rest.remove_prefix(attributes ? 2 : rest.starts_with('/') ? 1 : 0);
    names.emplace(rest.substr(0, rest.find_first_of("/[]")));
  }
  if (parent.empty() && !attributes) {
    for (const CycloneGroup& group : cyclone_opaque_groups(version)) names.emplace(group.path);
  }
  return {names.begin(), names.end()};
}

/// The group that has an element of this name; empty if there is none.
std::string path_ending_in(std::string_view name, CycloneVersion version) {
  for (const CycloneOption& option : cyclone_options(version)) {
    const std::string_view path = option.path.substr(0, option.path.find('['));
    const std::size_t slash = path.rfind('/');
    if (is_same_word(path.substr(slash + 1), name)) return std::string{path.substr(0, slash)};
  }
  return {};
}

/// Settings of which a file may have many: each is of its own list element.
bool is_repeatable(std::string_view path) {
  return path.starts_with("Discovery/Peers/Peer") ||
         path.starts_with("General/Interfaces/NetworkInterface");
}

std::string join(std::string_view parent, std::string_view name) {
  return parent.empty() ? std::string{name} : fmt::format("{}/{}", parent, name);
}

}  // namespace

bool is_cyclone_group(std::string_view name) {
  const bool is_old = std::ranges::any_of(cyclone_aliases(), [&](const CycloneAlias& alias) {
    return is_same_word(alias.old_path, name);
  });
  return is_old || !canonical(name, CycloneVersion::of_0_10).empty() ||
         !canonical(name, CycloneVersion::of_11).empty();
}

void CycloneDomainReader::read(const XmlElement& domain) {
  seen_.clear();
  for (const XmlElement& child : domain.children) {
    if (!is_same_word(child.name, "Id")) read_element(child, {});
  }
}

void CycloneDomainReader::read_element(const XmlElement& element, std::string_view parent) {
  if (failure_) return;
  std::string path = join(parent, element.name);
  resolve_alias(path, element);
  const std::string_view known = canonical(path, version_);
  if (known.empty()) return refuse(element.place, path, parent, element.name, false);
  for (const CycloneGroup& group : cyclone_opaque_groups(version_)) {
    if (group.path == known) return read_opaque(element, group);
  }
  if (known == "General/Interfaces/NetworkInterface") {
    settings_.interfaces.push_back({element.place});
  }
  read_attributes(element, known);
  read_text(element, known);
  for (const XmlElement& child : element.children) read_element(child, known);
}

void CycloneDomainReader::read_attributes(const XmlElement& element, std::string_view path) {
  for (const XmlAttribute& attribute : element.attributes) {
    const std::string name = fmt::format("{}[@{}]", path, attribute.name);
    const std::string_view setting = canonical(name, version_);
    if (setting.empty()) {
      refuse(element.place, name, path, attribute.name, true);
    } else {
      read_value(setting, attribute.value, element.place);
    }
  }
}

void CycloneDomainReader::remark(Severity severity, std::string_view rule, const Place& place,
                                 std::string message, std::string hint) {
  profile_.remarks.push_back(
      {severity, fmt::format("cyclonedds.{}", rule), place, std::move(message), std::move(hint)});
}

void CycloneDomainReader::fail(const Place& place, std::string message) {
  if (!failure_) failure_ = error_at(place, std::move(message));
}

void CycloneDomainReader::resolve_alias(std::string& path, const XmlElement& element) {
  for (const CycloneAlias& alias : cyclone_aliases()) {
    if (!is_same_word(alias.old_path, path)) continue;
    path = alias.path;
    remark(Severity::warning, "deprecated", element.place,
           fmt::format("{} is an old name", element.name), fmt::format("write {}", path));
    return;
  }
}

void CycloneDomainReader::refuse(const Place& place, const std::string& path,
                                 std::string_view parent, const std::string& name,
                                 bool is_attribute) {
  const char* kind = is_attribute ? "attribute" : "element";
  Setting setting{path, "", place, Effect::unknown, "", ""};
  for (const CycloneForeign& foreign : cyclone_foreign()) {
    if (!is_same_word(foreign.path, path)) continue;
    setting.note = fmt::format("an {} of {}; Cyclone DDS {} refuses the file", kind,
                               foreign.versions, print_version(version_));
    remark(Severity::error, "other-version", place, fmt::format("{} is {}", path, setting.note));
    profile_.settings.push_back(std::move(setting));
    return;
  }
  const bool has_hint = hints_left_ > 0;
  if (has_hint) --hints_left_;
  const std::vector<std::string> names =
      has_hint ? names_below(parent, is_attribute, version_) : std::vector<std::string>{};
  const std::string elsewhere = is_attribute || !has_hint ? "" : path_ending_in(name, version_);
  const std::string nearest = elsewhere.empty() ? suggestion(name, names) : "";
  setting.note = fmt::format("Cyclone DDS {} has no such {} and refuses the file",
                             print_version(version_), kind);
  constexpr std::size_t few = 12;
  std::string hint;
  if (!elsewhere.empty()) {
    hint = fmt::format("it belongs in {}", elsewhere);
  } else if (nearest.empty() && !names.empty() && names.size() <= few) {
    hint = fmt::format("expected one of {}", fmt::join(names, ", "));
  }
  remark(
      Severity::error, fmt::format("unknown-{}", kind), place,
      fmt::format("Cyclone DDS {} has no {} {}{} and refuses the file{}", print_version(version_),
                  kind, quote(name), parent.empty() ? "" : fmt::format(" in {}", parent), nearest),
      std::move(hint));
  profile_.settings.push_back(std::move(setting));
}

void CycloneDomainReader::read_opaque(const XmlElement& element, const CycloneGroup& group) {
  profile_.settings.push_back(
      {std::string{group.path}, "", element.place, group.effect, "", std::string{group.note}});
  if (group.effect == Effect::outside) {
    remark(Severity::error, "outside", element.place,
           fmt::format("{}: {}", group.path, group.note));
  }
}

void CycloneDomainReader::read_text(const XmlElement& element, std::string_view path) {
  const CycloneOption* option = find_option(path, version_);
  const bool is_moved = option != nullptr && path.ends_with("]");
  if (!element.text.empty()) {
    if (option == nullptr) {
      return fail(element.text_place,
                  fmt::format("{} in {}; expected elements only", quote(element.text), path));
    }
    read_value(path, element.text, element.text_place);
  } else if (option != nullptr && !is_moved && element.attributes.empty()) {
    remark(Severity::warning, "empty", element.place,
           fmt::format("{} is empty: the default {} stays", path, quote(option->usual)));
  }
}

std::optional<std::string> CycloneDomainReader::expanded(std::string_view path,
                                                         const std::string& text,
                                                         const Place& place) {
  if (text.find("${") == std::string::npos) return text;
  auto value = expand_variables(text);
  if (!value) {
    fail(place, fmt::format("{}: {}: {}", path, quote(text), value.error()));
    return std::nullopt;
  }
  constexpr const char* hint = "--from-environment reads variables where stormproof runs";
  const std::string names = fmt::format("{}", fmt::join(value->variables, ", "));
  if (value->text.empty()) {
    remark(Severity::warning, "variable", place,
           fmt::format("{}: {} has no value and no default, so nothing is read", path, names),
           hint);
    return std::nullopt;
  }
  remark(Severity::note, "variable", place,
         fmt::format("{}: {} is read as {}", path, quote(text), quote(value->text)), hint);
  return std::move(value->text);
}

void CycloneDomainReader::read_value(std::string_view path, const std::string& written,
                                     const Place& place) {
  if (failure_) return;
  const std::optional<std::string> value = expanded(path, written, place);
  if (!value) return;
  const std::string& text = *value;
  const CycloneOption* option = find_option(path, version_);
  if (!is_repeatable(path) && !seen_.insert(path).second) {
    return fail(place, fmt::format("{} stands twice in one Domain; expected it once", path));
  }
  const Parsed<CycloneValue> parsed = parse_cyclone(option->type, text);
  if (!parsed) {
    return fail(
        place, fmt::format("{}: {}; expected {}", path, parsed.error(), expectation(option->type)));
  }
  CycloneReading reading{option, *parsed, print_cyclone(option->type, *parsed), place,
                         profile_.settings.size()};
  profile_.settings.push_back({std::string{path}, text, place, option->effect,
                               std::string{option->knob}, std::string{option->note}});
  if (parsed->lacks_unit) {
    remark(Severity::warning, "missing-unit", place,
           fmt::format("{}: {} has no unit and is taken as bytes, which is deprecated", path,
                       quote(text)),
           fmt::format("write {} B", text));
  }
  if (option->deprecated) {
    remark(Severity::warning, "deprecated", place,
           fmt::format("{} is deprecated in Cyclone DDS {}", path, print_version(version_)));
  }
  keep(std::move(reading));
}

void CycloneDomainReader::keep(CycloneReading reading) {
  const std::string_view path = reading.option->path;
  if (path == "Discovery/Peers/Peer[@Address]") {
    settings_.peers.push_back(std::move(reading));
    return;
  }
  if (path == "Discovery/Peers/Peer[@PruneDelay]") {
    settings_.prune_delays.push_back(std::move(reading));
    return;
  }
  if (path == "General/Interfaces/NetworkInterface[@multicast]") {
    settings_.interfaces.back().multicast = reading;
  } else if (path == "General/Interfaces/NetworkInterface[@allow_multicast]") {
    settings_.interfaces.back().allow_multicast = reading;
  }
  if (const CycloneReading* old = settings_.find(path); old != nullptr && !is_repeatable(path)) {
    Setting& earlier = profile_.settings[old->setting];
    earlier.effect = Effect::none;
    earlier.note = fmt::format("no effect: set again at {}", reading.place.to_string());
    remark(Severity::note, "overridden", old->place,
           fmt::format("{} has no effect: a later Domain sets it again", path));
  }
  settings_.add(std::move(reading));
}

}  // namespace stormproof::model::config::vendor
