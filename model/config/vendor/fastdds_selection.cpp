// Which participant profile of a Fast DDS file is meant, and what the file says around it. The
// library takes the profile that is named, or the one with is_default_profile="true"; of a file it
// keeps the profiles in the first <profiles> only, the first of each name (XMLProfileManager.cpp's
// loadXMLFile and extractParticipantProfile). ROS 2 asks for the default one only.
#include <algorithm>
#include <array>
#include <set>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "model/config/tree/suggestion.hpp"
#include "model/config/vendor/fastdds_discovery.hpp"

namespace stormproof::model::config::vendor::fastdds {
namespace {

constexpr std::array<std::string_view, 10> profile_names{
    "participant", "data_writer", "publisher", "data_reader",           "subscriber",
    "topic",       "requester",   "replier",   "transport_descriptors", "library_settings"};
constexpr std::array<std::string_view, 12> dds_names{
    "profiles", "participant", "data_writer", "publisher", "data_reader",      "subscriber",
    "topic",    "requester",   "replier",     "types",     "library_settings", "log"};

void check_names(const XmlElement& container, Reading& reading) {
  std::vector<std::string> names;
  if (container.name == "dds") names.assign(dds_names.begin(), dds_names.end());
  if (container.name == "profiles") names.assign(profile_names.begin(), profile_names.end());
  if (names.empty()) return;
  if (container.name == "profiles") {
    names.emplace_back("types");
  }
  for (const XmlElement& child : container.children) {
    if (std::ranges::find(names, child.name) != names.end()) continue;
    Setting setting;
    setting.path = child.name;
    setting.value = fmt::format("({} elements)", child.children.size());
    setting.place = child.place;
    setting.effect = Effect::unknown;
    setting.note = "no element of this name may stand here";
    reading.profile.settings.push_back(std::move(setting));
    const std::string suggested = suggestion(child.name, names);
    const auto home = home_of(child.name);
    add_remark(reading.profile, Severity::error,
               home ? "fastdds.misplaced-element" : "fastdds.unknown-element", child.place,
               fmt::format("Fast DDS {} has no <{}> in <{}> and refuses the file",
                           print_version(reading.version), child.name, container.name),
               home                ? "it belongs at " + *home
               : suggested.empty() ? std::string{}
                                   : suggested.substr(2));
  }
}

bool is_default(const XmlElement& participant) {
  const std::string* value = participant.attribute("is_default_profile");
  return value != nullptr && *value == "true";
}

/// "'a' (line 3), 'b' (line 9)".
std::string list_of(const std::vector<const XmlElement*>& participants) {
  std::vector<std::string> names;
  constexpr std::size_t most = 10;
  for (const XmlElement* one : participants) {
    if (names.size() == most) {
      names.emplace_back("…");
      break;
    }
    names.push_back(fmt::format("{} (line {})", quote(name_of_profile(*one)), one->place.line));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

void remark_attributes(const XmlElement& participant, Reading& reading) {
  constexpr std::array<std::string_view, 2> known{"profile_name", "is_default_profile"};
  if (const std::string* name = participant.attribute("profile_name");
      name == nullptr || name->empty()) {
    add_remark(reading.profile, Severity::error, "fastdds.missing-profile-name", participant.place,
               fmt::format("<participant> {}; the library refuses it",
                           name == nullptr ? "has no attribute profile_name"
                                           : "has an empty profile_name"));
  }
  for (const XmlAttribute& attribute : participant.attributes) {
    if (std::ranges::find(known, attribute.name) == known.end()) {
      add_remark(reading.profile, Severity::warning, "fastdds.ignored-attribute", participant.place,
                 fmt::format("attribute {} of <participant> is ignored", quote(attribute.name)),
                 "known are profile_name and is_default_profile");
    } else if (attribute.name == known[1] && attribute.value != "true" &&
               attribute.value != "false") {
      add_remark(reading.profile, Severity::warning, "fastdds.default-profile-value",
                 participant.place,
                 fmt::format("is_default_profile={} does not make it the default profile",
                             quote(attribute.value)),
                 "the library compares with \"true\"");
    }
  }
}

/// The container whose profiles the library keeps; null if there is none.
const XmlElement* kept_container(const XmlElement& root) {
  return root.name == "dds" ? root.find("profiles") : &root;
}

/// Profiles that are read and then forgotten.
void remark_forgotten(const XmlElement& container, Reading& reading) {
  constexpr std::array<std::string_view, 8> kinds{"participant", "data_writer", "publisher",
                                                  "data_reader", "subscriber",  "topic",
                                                  "requester",   "replier"};
  const bool is_root = container.name == "dds";
  for (const XmlElement& child : container.children) {
    if (std::ranges::find(kinds, child.name) == kinds.end()) continue;
    add_remark(reading.profile, Severity::warning, "fastdds.forgotten-profile", child.place,
               fmt::format("<{}> {} has no effect: the library reads it, but keeps only what is in "
                           "the first <profiles>",
                           child.name, is_root ? "directly in <dds>" : "in a second <profiles>"),
               "put it into the first <profiles>");
  }
}

/// Those of `all` that the library keeps: with a name, and the first of that name.
std::vector<const XmlElement*> kept(const std::vector<const XmlElement*>& all) {
  std::set<std::string> names;
  std::vector<const XmlElement*> ones;
  for (const XmlElement* one : all) {
    const std::string name = name_of_profile(*one);
    if (!name.empty() && names.insert(name).second) ones.push_back(one);
  }
  return ones;
}

}  // namespace

std::vector<const XmlElement*> containers_of(const XmlElement& root) {
  std::vector<const XmlElement*> containers{&root};
  if (root.name != "dds") return containers;
  for (const XmlElement& child : root.children) {
    if (child.name == "profiles") containers.push_back(&child);
  }
  return containers;
}

std::vector<const XmlElement*> participants_of(const XmlElement& root) {
  if (root.name == "participant") return {&root};
  std::vector<const XmlElement*> participants;
  const XmlElement* container = kept_container(root);
  if (container == nullptr) return participants;
  for (const XmlElement& child : container->children) {
    if (child.name == "participant") participants.push_back(&child);
  }
  return participants;
}

std::string name_of_profile(const XmlElement& participant) {
  const std::string* name = participant.attribute("profile_name");
  return name == nullptr ? std::string{} : *name;
}

const XmlElement* select_participant(const XmlElement& root, const std::string& wanted) {
  const std::vector<const XmlElement*> all = participants_of(root);
  if (!wanted.empty()) {
    std::vector<std::string> names;
    for (const XmlElement* one : all) {
      if (name_of_profile(*one) == wanted) return one;
      names.push_back(name_of_profile(*one));
    }
    refuse(root.place, fmt::format("no participant profile {}{}; expected {}", quote(wanted),
                                   suggestion(wanted, names),
                                   all.empty() ? "a file that has one" : "one of " + list_of(all)));
  }
  if (all.empty()) return nullptr;
  const std::vector<const XmlElement*> choice = kept(all);
  if (choice.empty()) return all.front();  // a remark says what it lacks
  const auto last = std::ranges::find_if(choice.rbegin(), choice.rend(),
                                         [](const XmlElement* one) { return is_default(*one); });
  if (last != choice.rend()) return *last;
  if (choice.size() == 1) return choice.front();
  refuse(choice[1]->place,
         fmt::format("several participant profiles and none with is_default_profile=\"true\"; "
                     "expected the name of one of {}",
                     list_of(choice)));
}

void remark_participants(Reading& reading) {
  std::set<std::string> names;
  const XmlElement* first_default = nullptr;
  for (const XmlElement* one : participants_of(*reading.root)) {
    remark_attributes(*one, reading);
    if (!name_of_profile(*one).empty() && !names.insert(name_of_profile(*one)).second) {
      add_remark(reading.profile, Severity::error, "fastdds.repeated-profile", one->place,
                 fmt::format("a second participant profile {}; the library refuses it",
                             quote(name_of_profile(*one))));
      continue;
    }
    if (is_default(*one) && first_default != nullptr) {
      add_remark(reading.profile, Severity::warning, "fastdds.several-defaults", one->place,
                 fmt::format("a second default profile; it replaces that of line {}",
                             first_default->place.line));
    }
    if (is_default(*one)) first_default = one;
    if (one != reading.participant) {
      add_remark(
          reading.profile, Severity::note, "fastdds.other-profile", one->place,
          fmt::format("participant profile {} is not looked at; {} is",
                      quote(name_of_profile(*one)), quote(name_of_profile(*reading.participant))));
    } else if (!is_default(*one)) {
      add_remark(reading.profile, Severity::warning, "fastdds.not-default", one->place,
                 fmt::format("participant profile {} is not the default one, and ROS 2 uses no "
                             "other",
                             quote(name_of_profile(*one))),
                 "add is_default_profile=\"true\"");
    }
  }
}

void remark_containers(Reading& reading) {
  for (const XmlElement* container : containers_of(*reading.root)) {
    check_names(*container, reading);
    const XmlElement* keeps = kept_container(*reading.root);
    if (container != keeps && container->name != "participant") {
      remark_forgotten(*container, reading);
    }
  }
}

void check_other_participants(Reading& reading, const SectionRules& rules) {
  for (const XmlElement* container : containers_of(*reading.root)) {
    for (const XmlElement& child : container->children) {
      if (child.name != "participant" || &child == reading.participant) continue;
      VendorProfile other;
      (void)read_section(child, rules, other);
      for (Remark& remark : other.remarks) {
        if (remark.severity == Severity::error) {
          reading.profile.remarks.push_back(std::move(remark));
        }
      }
    }
  }
}

}  // namespace stormproof::model::config::vendor::fastdds
