// Walks the elements of a profile beside the table of those that the library knows. What is not in
// the table makes the library refuse the file, so each such element says what it should have been:
// another spelling, another parent, or another version of the library.
#include "model/config/vendor/fastdds_section.hpp"

#include <algorithm>
#include <set>

#include <fmt/core.h>

#include "model/config/tree/suggestion.hpp"
#include "model/config/vendor/any_case.hpp"

namespace stormproof::model::config::vendor::fastdds {
namespace {

/// Without the "; " with which a suggestion follows another text.
std::string as_hint(std::string_view suggested) {
  return std::string{suggested.substr(std::min<std::size_t>(2, suggested.size()))};
}

/// Since when an <interfaceWhiteList> may name interfaces.
constexpr Version interface_names = 214;

class SectionReader {
 public:
  SectionReader(const SectionRules& rules, VendorProfile& profile)
      : rules_{rules}, profile_{profile} {}

  void read(const XmlElement& parent, const std::string& path) {
    std::set<std::string_view> seen;
    for (const XmlElement& child : parent.children) {
      const std::string child_path = path.empty() ? child.name : path + "/" + child.name;
      const SchemaItem* item = find_item(rules_.schema, child_path);
      if (item == nullptr || item->since > rules_.version) {
        unknown(child, parent, path, item);
        continue;
      }
      if (!seen.insert(item->path).second) repeated(child, parent, path);
      if ((item->transports & rules_.transport) == 0) {
        wrong_transport(child, child_path);
      } else if (item->kind == ValueKind::group) {
        read(child, child_path);
      } else if (item->kind == ValueKind::properties) {
        read_properties(child, child_path);
      } else {
        add(child, child_path, *item, read_value(child, *item, profile_));
        if (item->kind == ValueKind::addresses) check_addresses(child, child_path);
        if (item->name() == "discoveryServersList") check_servers(child, child_path);
      }
    }
  }

  /// What was read; of an element that came twice, the last one has an effect.
  Section take() {
    std::set<std::string_view> later;
    for (auto one = section_.found.rbegin(); one != section_.found.rend(); ++one) {
      if (one->item->path.empty() || later.insert(one->item->path).second) continue;
      profile_.settings[one->setting].effect = Effect::none;
      profile_.settings[one->setting].note = "the last one of this name counts";
    }
    return std::move(section_);
  }

 private:
  void add(const XmlElement& element, const std::string& path, const SchemaItem& item,
           Value value) {
    Setting setting;
    setting.path = rules_.prefix + path;
    setting.value = value.shown;
    setting.place = value.place;
    const bool is_default = !item.standard.empty() && value.shown == item.standard;
    setting.effect = is_default ? Effect::none : item.effect;
    setting.note = is_default ? "the library's default" : std::string{item.note};
    section_.found.push_back({&item, &element, std::move(value), profile_.settings.size()});
    profile_.settings.push_back(std::move(setting));
  }

  /// Anything but an address makes the library refuse the file; names of interfaces came later.
  void check_addresses(const XmlElement& list, const std::string& path) {
    static const SchemaItem interface {
      "interface", ValueKind::text, "", Effect::none, "", "", interface_names
    };
    for (const XmlElement& child : list.children) {
      const bool is_interface = child.name == interface.path;
      if (child.name == "address" || (is_interface && interface.since <= rules_.version)) continue;
      unknown(child, list, path, is_interface ? &interface : nullptr);
    }
  }

  /// Before 3.0 a server has a GUID prefix, since then it is known by its address alone.
  void check_servers(const XmlElement& list, const std::string& path) {
    const bool has_prefixes = rules_.version < servers_by_address;
    const std::string_view expected = has_prefixes ? "RemoteServer" : "locator";
    for (const XmlElement& child : list.children) {
      if (child.name == expected) continue;
      add_without_value(child, path + "/" + child.name, Effect::unknown,
                        "this version of the library has no such element here");
      add_remark(profile_, Severity::error,
                 has_prefixes ? "fastdds.later-version" : "fastdds.earlier-version", child.place,
                 fmt::format("Fast DDS {} has no <{}> in <{}> and refuses the file",
                             print_version(rules_.version), child.name, list.name),
                 has_prefixes
                     ? "before 3.0 it holds <RemoteServer prefix=\"…\"> with a "
                       "<metatrafficUnicastLocatorList>"
                     : "since 3.0 it holds the <locator> of each server, without a prefix");
    }
  }

  void add_without_value(const XmlElement& element, const std::string& path, Effect effect,
                         std::string note) {
    Setting setting;
    setting.path = rules_.prefix + path;
    setting.value = element.children.empty()
                        ? element.text
                        : fmt::format("({} elements)", element.children.size());
    setting.place = element.place;
    setting.effect = effect;
    setting.note = std::move(note);
    profile_.settings.push_back(std::move(setting));
  }

  void unknown(const XmlElement& child, const XmlElement& parent, const std::string& path,
               const SchemaItem* later) {
    const std::string what = fmt::format("Fast DDS {} has no <{}> in <{}> and refuses the file",
                                         print_version(rules_.version), child.name, parent.name);
    add_without_value(child, path.empty() ? child.name : path + "/" + child.name, Effect::unknown,
                      "this version of the library has no such element here");
    if (later != nullptr) {
      return add_remark(profile_, Severity::error, "fastdds.later-version", child.place,
                        fmt::format("{}; it is there since {}", what, print_version(later->since)),
                        "leave it out, or choose the version of the library that reads the file");
    }
    if (hints_left_ == 0) {
      return add_remark(profile_, Severity::error, "fastdds.unknown-element", child.place, what);
    }
    --hints_left_;
    const std::vector<std::string> siblings = names_below(path);
    for (const std::string& sibling : siblings) {
      if (is_same_word(sibling, child.name)) {
        return add_remark(profile_, Severity::error, "fastdds.wrong-case", child.place, what,
                          fmt::format("case counts: <{}>", sibling));
      }
    }
    if (const auto home = home_of(child.name)) {
      return add_remark(profile_, Severity::error, "fastdds.misplaced-element", child.place, what,
                        fmt::format("it belongs at {}", *home));
    }
    add_remark(profile_, Severity::error, "fastdds.unknown-element", child.place, what,
               as_hint(suggestion(child.name, siblings)));
  }

  std::vector<std::string> names_below(const std::string& path) const {
    std::vector<std::string> names;
    for (const SchemaItem& item : rules_.schema) {
      const std::size_t slash = item.path.rfind('/');
      const auto parent =
          slash == std::string_view::npos ? std::string_view{} : item.path.substr(0, slash);
      if (parent == path && item.since <= rules_.version) names.emplace_back(item.name());
    }
    return names;
  }

  void repeated(const XmlElement& child, const XmlElement& parent, const std::string& path) {
    const bool is_refused = rules_.refuses_repetition && (path.empty() || path == "rtps");
    add_remark(profile_, is_refused ? Severity::error : Severity::warning,
               "fastdds.repeated-element", child.place,
               is_refused
                   ? fmt::format("<{}> comes twice in <{}>, and the library refuses the file",
                                 child.name, parent.name)
                   : fmt::format("<{}> comes twice in <{}>; the last one counts", child.name,
                                 parent.name));
  }

  /// UDP transports skip elements of other transports, the others refuse them.
  void wrong_transport(const XmlElement& child, const std::string& path) {
    const bool is_skipped = rules_.transport == udp;
    add_without_value(child, path, is_skipped ? Effect::none : Effect::unknown,
                      "this type of transport has no such setting");
    add_remark(profile_, is_skipped ? Severity::warning : Severity::error,
               "fastdds.wrong-transport-type", child.place,
               fmt::format("<{}> is no setting of this type of transport, which {}", child.name,
                           is_skipped ? "ignores it" : "makes the library refuse the file"));
  }

  void read_properties(const XmlElement& policy, const std::string& path) {
    for (const XmlElement& list : policy.children) {
      const bool is_binary = list.name == "binary_properties";
      if (!is_binary && list.name != "properties") {
        unknown(list, policy, path, nullptr);
        continue;
      }
      if (list.find("property") == nullptr) {
        refuse(list.place, fmt::format("no <property> in <{}>; expected one at least, or leave it "
                                       "out",
                                       list.name));
      }
      if (is_binary) continue;
      for (const XmlElement& property : list.children) {
        const XmlElement* name = property.find("name");
        if (property.name != "property" || name == nullptr || name->text.empty()) {
          refuse(property.place,
                 fmt::format("<{}> in <properties>; expected <property> with a <name>",
                             property.name));
        }
        read_property(property, *name, path);
      }
    }
  }

  void read_property(const XmlElement& property, const XmlElement& name, const std::string& path) {
    static const SchemaItem other{"", ValueKind::text, "", Effect::none,
                                  "no property that acts on discovery"};
    const SchemaItem* known = find_item(property_schema(), name.text);
    const XmlElement* value = property.find("value");
    Value read{0, false, {}, name.place, {}};
    if (value != nullptr) {
      if (value->text.empty()) {
        refuse(value->place, "nothing in <value>; expected text, or leave <value> out");
      }
      read.shown = value->text;
      read.place = value->text_place;
    }
    add(property, path + "/" + name.text, known == nullptr ? other : *known, std::move(read));
  }

  const SectionRules& rules_;
  VendorProfile& profile_;
  Section section_;
  std::size_t hints_left_ = 1000;  ///< a hint compares with every name there is
};

}  // namespace

void refuse(const Place& place, std::string message) {
  throw Refusal{error_at(place, std::move(message))};
}

void add_remark(VendorProfile& profile, Severity severity, std::string rule, const Place& place,
                std::string message, std::string hint) {
  profile.remarks.push_back(
      {severity, std::move(rule), place, std::move(message), std::move(hint)});
}

const Found* Section::find(std::string_view path) const {
  const auto last = std::ranges::find_if(found.rbegin(), found.rend(),
                                         [&](const Found& one) { return one.item->path == path; });
  return last == found.rend() ? nullptr : &*last;
}

Section read_section(const XmlElement& element, const SectionRules& rules, VendorProfile& profile) {
  SectionReader reader{rules, profile};
  reader.read(element, {});
  return reader.take();
}

}  // namespace stormproof::model::config::vendor::fastdds
