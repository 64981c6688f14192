// Reads Cyclone DDS's XML as versions 0.10 and 11 do: names without regard to case, several Domain
// elements of which those count that have the domain's id or "any", the later over the earlier, and
// old names for what has moved.
#include <algorithm>
#include <charconv>
#include <set>
#include <span>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "model/config/vendor/any_case.hpp"
#include "model/config/vendor/cyclonedds_domain.hpp"

namespace stormproof::model::config::vendor {
namespace {

using Failure = std::optional<InputError>;

constexpr std::string_view any = "any";

/// An element with the settings of one domain, or of all.
struct Source {
  const XmlElement* element;
  std::string id;  ///< a number, or "any"
  bool is_group;   ///< a group that stands where Domain should: it is read itself
};

/// The id of a Domain element; an error if it is neither a number nor "any".
Result<std::string> domain_id(const XmlElement& domain) {
  std::string id{any};
  Place place = domain.place;
  for (const XmlAttribute& attribute : domain.attributes) {
    if (is_same_word(attribute.name, "Id")) id = attribute.value;
  }
  for (const XmlElement& child : domain.children) {
    if (!is_same_word(child.name, "Id")) continue;
    id = child.text;
    place = child.text_place;
  }
  if (is_same_word(id, any)) return std::string{any};
  constexpr std::uint64_t most = 4'294'967'294;
  std::uint64_t number = 0;
  const auto [end, failed] = std::from_chars(id.data(), id.data() + id.size(), number);
  if (failed != std::errc{} || end != id.data() + id.size() || number > most) {
    return error_at(place, fmt::format("Domain Id {}; expected any, or an integer from 0 to {}",
                                       quote(id), most));
  }
  return fmt::format("{}", number);
}

/// The first ten, with commas.
std::string list_of(const std::vector<std::string>& ids) {
  constexpr std::size_t most = 10;
  const std::span first{ids.data(), std::min(ids.size(), most)};
  return fmt::format("{}{}", fmt::join(first, ", "), ids.size() > most ? ", …" : "");
}

/// The elements that count, and the name of the choice.
class Choice {
 public:
  Failure collect(const XmlElement& root, VendorProfile& profile) {
    for (const XmlElement& child : root.children) {
      const bool is_old = is_same_word(child.name, "DDSI2E") || is_same_word(child.name, "DDSI2");
      if (!is_same_word(child.name, "Domain") && !is_old) {
        sources_.push_back({&child, std::string{any}, true});
        continue;
      }
      const Result<std::string> id = domain_id(child);
      if (!id) return id.error();
      sources_.push_back({&child, *id, false});
      if (is_old) {
        profile.remarks.push_back({Severity::warning, "cyclonedds.deprecated", child.place,
                                   fmt::format("{} is an old name", child.name), "write Domain"});
      }
    }
    return std::nullopt;
  }

  /// Sets `profile.name`.
  Failure choose(const XmlElement& root, const std::string& wanted, VendorProfile& profile) const {
    std::vector<std::string> ids;
    std::set<std::string_view> known;
    bool has_any = sources_.empty();
    for (const Source& source : sources_) {
      has_any = has_any || source.id == any;
      if (source.id != any && known.insert(source.id).second) ids.push_back(source.id);
    }
    if (wanted.empty()) {
      if (ids.size() > 1) {
        return error_at(root.place,
                        fmt::format("settings for the domains {}; expected one of them after the "
                                    "file's name, as in FILE#{}",
                                    list_of(ids), ids.front()));
      }
      profile.name = ids.empty() ? std::string{any} : ids.front();
      if (!ids.empty() && has_any) {
        profile.remarks.push_back(
            {Severity::note, "cyclonedds.domain", root.place,
             fmt::format("read for domain {}, the only one with settings of its own", ids.front()),
             "FILE#any reads what counts for all domains"});
      }
      return std::nullopt;
    }
    std::uint64_t number = 0;
    const auto [end, failed] =
        std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    const bool is_number = failed == std::errc{} && end == wanted.data() + wanted.size();
    const bool is_there = std::ranges::find(ids, wanted) != ids.end();
    if (!is_there && !(has_any && (is_number || is_same_word(wanted, any)))) {
      if (has_any) ids.insert(ids.begin(), std::string{any});
      return error_at(root.place, fmt::format("no settings for domain {}; expected one of {}",
                                              quote(wanted), list_of(ids)));
    }
    profile.name = is_number ? wanted : std::string{any};
    return std::nullopt;
  }

  Failure read(VendorProfile& profile, CycloneSettings& settings) const {
    CycloneDomainReader reader{profile, settings};
    bool was_told = false;
    for (const Source& source : sources_) {
      if (source.id != any && source.id != profile.name) {
        profile.remarks.push_back({Severity::note, "cyclonedds.other-domain", source.element->place,
                                   fmt::format("settings of domain {} are not read", source.id),
                                   fmt::format("FILE#{} reads them", source.id)});
      } else if (!source.is_group) {
        look_at_attributes(*source.element, profile);
        reader.read(*source.element);
      } else {
        const bool is_known = is_cyclone_group(source.element->name);
        if (is_known && !was_told) {
          profile.remarks.push_back({Severity::warning, "cyclonedds.no-domain",
                                     source.element->place,
                                     "settings outside of a Domain element are deprecated",
                                     "put them into <Domain Id=\"any\">"});
          was_told = true;
        }
        reader.read_element(*source.element, {});
      }
    }
    return reader.failure();
  }

 private:
  static void look_at_attributes(const XmlElement& domain, VendorProfile& profile) {
    for (const XmlAttribute& attribute : domain.attributes) {
      if (is_same_word(attribute.name, "Id")) continue;
      profile.remarks.push_back(
          {Severity::error, "cyclonedds.unknown-attribute", domain.place,
           fmt::format("Cyclone DDS has no attribute {} in Domain and refuses the file",
                       quote(attribute.name)),
           "expected Id"});
    }
  }

  std::vector<Source> sources_;
};

}  // namespace

std::vector<std::string> domain_ids(const XmlElement& root) {
  std::vector<std::string> ids;
  for (const XmlElement& child : root.children) {
    if (!is_same_word(child.name, "Domain")) continue;
    const Result<std::string> id = domain_id(child);
    if (!id || *id == any || std::ranges::find(ids, *id) != ids.end()) continue;
    ids.push_back(*id);
  }
  return ids;
}

Result<VendorProfile> read_cyclonedds_profile(const XmlElement& root, const Selection& selection) {
  if (!is_same_word(root.name, "CycloneDDS")) {
    return error_at(root.place, fmt::format("root element <{}>; expected <CycloneDDS>", root.name));
  }
  VendorProfile profile;
  profile.vendor = Vendor::cyclonedds;
  profile.version_base =
      selection.base.empty() ? std::string{default_base(Vendor::cyclonedds)} : selection.base;
  if (!root.text.empty()) {
    return error_at(root.text_place,
                    fmt::format("{} in CycloneDDS; expected elements only", quote(root.text)));
  }
  Choice choice;
  CycloneSettings settings;
  settings.version = cyclone_version_of(profile.version_base);
  Failure failure = choice.collect(root, profile);
  if (!failure) failure = choice.choose(root, selection.profile, profile);
  if (!failure) failure = choice.read(profile, settings);
  if (!failure) failure = apply_cyclone_settings(settings, profile);
  if (failure) return *std::move(failure);

  for (Setting& setting : profile.settings) {
    if (setting.effect != Effect::knob) setting.knob.clear();
  }
  profile.changes.place = root.place;
  Node base = Node::scalar(root.place, profile.version_base);
  profile.changes.members.insert(profile.changes.members.begin(),
                                 {"base", root.place, std::move(base)});
  std::ranges::stable_sort(profile.remarks, {}, [](const Remark& remark) {
    return std::pair{remark.place.line, remark.place.column};
  });
  return profile;
}

}  // namespace stormproof::model::config::vendor
