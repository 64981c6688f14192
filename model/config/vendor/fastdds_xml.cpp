// Reads a Fast DDS XML file (that of v2.6, <dds> or <profiles> with participant profiles): chooses
// the participant, lets the parts be interpreted, and turns the result into a profile that changes
// a preset.
#include <algorithm>
#include <map>
#include <set>

#include <fmt/core.h>

#include "model/config/knobs/knobs.hpp"
#include "model/config/vendor/fastdds_discovery.hpp"

namespace stormproof::model::config::vendor {
namespace fastdds {
namespace {

unsigned kind_of(std::string_view type) {
  return type.starts_with("UDP") ? udp : type.starts_with("TCP") ? tcp : shm;
}

void read_transport(const XmlElement& element, Reading& reading) {
  Transport transport;
  transport.element = &element;
  for (const auto& [name, target] :
       {std::pair{"transport_id", &transport.id}, std::pair{"type", &transport.type}}) {
    const XmlElement* child = element.find(name);
    if (child == nullptr || child->text.empty()) {
      refuse(child == nullptr ? element.place : child->place,
             fmt::format("a transport descriptor without <{}>", name));
    }
    *target = child->text;
  }
  const SectionRules rules{.schema = transport_schema(),
                           .version = reading.version,
                           .prefix = fmt::format("transport_descriptor[{}]/", transport.id),
                           .transport = kind_of(transport.type)};
  transport.section = read_section(element, rules, reading.profile);
  if (!reading.transport_of_id.emplace(transport.id, reading.transports.size()).second) {
    add_remark(reading.profile, Severity::error, "fastdds.repeated-transport", element.place,
               fmt::format("a second transport descriptor {}; the library keeps the first",
                           quote(transport.id)));
    for (const Found& found : transport.section.found) set_inert(reading, found, "not used");
    return;
  }
  reading.transports.push_back(std::move(transport));
}

/// The ids in the <userTransports> of any participant.
std::set<std::string_view> named_transports(const XmlElement& root) {
  std::set<std::string_view> names;
  for (const XmlElement* participant : participants_of(root)) {
    const XmlElement* rtps = participant->find("rtps");
    const XmlElement* list = rtps == nullptr ? nullptr : rtps->find("userTransports");
    if (list == nullptr) continue;
    for (const XmlElement& id : list->children) names.insert(id.text);
  }
  return names;
}

void read_transports(const XmlElement& root, Reading& reading) {
  for (const XmlElement* container : containers_of(root)) {
    for (const XmlElement& list : container->children) {
      if (list.name != "transport_descriptors") continue;
      for (const XmlElement& element : list.children) {
        if (element.name == "transport_descriptor") {
          read_transport(element, reading);
        } else {
          add_remark(reading.profile, Severity::warning, "fastdds.ignored-element", element.place,
                     fmt::format("<{}> in <transport_descriptors> is ignored", element.name),
                     "it has <transport_descriptor> elements only");
        }
      }
    }
  }
  const std::set<std::string_view> named = named_transports(root);
  for (Transport& transport : reading.transports) {
    transport.is_named = named.contains(transport.id);
  }
}

void read_library_settings(const XmlElement& root, Reading& reading) {
  for (const XmlElement* container : containers_of(root)) {
    const XmlElement* settings = container->find("library_settings");
    if (settings == nullptr) continue;
    const XmlElement* delivery = settings->find("intraprocess_delivery");
    if (delivery == nullptr) {
      add_remark(reading.profile, Severity::error, "fastdds.library-settings", settings->place,
                 "<library_settings> without <intraprocess_delivery>; the library refuses the file",
                 "leave <library_settings> out");
      continue;
    }
    const std::string& word = delivery->text;
    if (word != "OFF" && word != "USER_DATA_ONLY" && word != "FULL") {
      refuse(delivery->text_place,
             fmt::format("{} in <intraprocess_delivery>; expected OFF, USER_DATA_ONLY or FULL",
                         quote(word)));
    }
    reading.profile.settings.push_back(
        {"library_settings/intraprocess_delivery", word, delivery->text_place, Effect::none, "",
         word == "FULL" ? "the library's default"
                        : "acts between participants of one process only"});
  }
}

/// `text` as one line of at most `length` bytes.
std::string in_one_line(std::string_view text, std::size_t length) {
  std::string line{text.substr(0, length)};
  if (text.size() > length) {
    while (!line.empty() && (static_cast<unsigned char>(text[line.size()]) & 0xC0u) == 0x80u) {
      line.pop_back();  // not in the middle of a character
    }
    line += "…";
  }
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return line;
}

/// The key of a setting that the model has not: its path without what all of them share.
std::string short_key(std::string_view path) {
  for (const std::string_view prefix :
       {"rtps/", "builtin/", "discovery_config/", "propertiesPolicy/"}) {
    if (path.starts_with(prefix)) path.remove_prefix(prefix.size());
  }
  constexpr std::size_t longest = 100;
  if (!path.starts_with("transport_descriptor[")) return in_one_line(path, longest);
  return fmt::format("transport/{}", path.substr(path.rfind('/') + 1));
}

void collect_unmodelled(VendorProfile& profile) {
  constexpr std::size_t longest_value = 200;
  constexpr std::size_t longest_text = 2'000;  ///< of several transports
  Node texts = Node::map({});
  std::map<std::string, std::size_t> index;  // in `texts`
  for (const Setting& setting : profile.settings) {
    if (setting.effect != Effect::unmodelled) continue;
    const std::string key = short_key(setting.path);
    const std::string text =
        fmt::format("{}: {}", in_one_line(setting.value, longest_value), setting.note);
    const auto [at, is_first] = index.emplace(key, texts.members.size());
    if (!is_first) {
      Node* known = &texts.members[at->second].value;
      const bool is_new = known->text.find(text) == std::string::npos;
      if (is_new && known->text.size() < longest_text) known->text += "; " + text;
      continue;
    }
    texts.place = setting.place;
    texts.members.push_back({key, setting.place, Node::scalar(setting.place, text, true)});
  }
  if (texts.members.empty()) return;
  profile.changes.members.push_back({"unmodelled", texts.place, std::move(texts)});
}

void sort_by_place(VendorProfile& profile) {
  const auto before = [](const auto& a, const auto& b) {
    return std::pair{a.place.line, a.place.column} < std::pair{b.place.line, b.place.column};
  };
  std::ranges::stable_sort(profile.settings, before);
  std::ranges::stable_sort(profile.remarks, before);
}

void start(const XmlElement& root, const Selection& selection, Reading& reading) {
  VendorProfile& profile = reading.profile;
  profile.vendor = Vendor::fastdds;
  profile.version_base =
      selection.base.empty() ? std::string{default_base(Vendor::fastdds)} : selection.base;
  reading.root = &root;
  reading.version = version_of(profile.version_base);
  profile.changes = Node::map(root.place);
  Node base = Node::scalar(root.place, profile.version_base);
  profile.changes.members.push_back({std::string{base_key}, root.place, std::move(base)});
}

VendorProfile read(const XmlElement& root, const Selection& selection) {
  Reading reading;
  start(root, selection, reading);
  if (root.name == "participant") {
    add_remark(reading.profile, Severity::error, "fastdds.root", root.place,
               "a file that begins with <participant>; the library reads <dds> or <profiles>",
               "put it into <dds><profiles>");
  }
  remark_containers(reading);
  reading.participant = select_participant(root, selection.profile);
  read_transports(root, reading);
  read_library_settings(root, reading);
  for (const XmlElement* container : containers_of(root)) remark_endpoints(reading, *container);
  if (reading.participant == nullptr) {
    for (const Transport& transport : reading.transports) {
      for (const Found& found : transport.section.found) set_inert(reading, found, "not used");
    }
    add_remark(reading.profile, Severity::warning, "fastdds.no-participant", root.place,
               "no participant profile, so nothing in the file acts on discovery");
  } else {
    reading.profile.name = name_of_profile(*reading.participant);
    remark_participants(reading);
    const SectionRules rules{
        .schema = participant_schema(), .version = reading.version, .refuses_repetition = true};
    reading.section = read_section(*reading.participant, rules, reading.profile);
    check_other_participants(reading, rules);
    interpret_transports(reading);
    interpret_announcements(reading);
    interpret_participant(reading);
  }
  for (Setting& setting : reading.profile.settings) {
    if (setting.effect != Effect::knob || !setting.knob.empty()) continue;
    setting.effect = Effect::none;
    setting.note = "the library does not use it";
  }
  collect_unmodelled(reading.profile);
  sort_by_place(reading.profile);
  return std::move(reading.profile);
}

}  // namespace
}  // namespace fastdds

Result<VendorProfile> read_fastdds_profile(const XmlElement& root, const Selection& selection) {
  try {
    return fastdds::read(root, selection);
  } catch (const fastdds::Refusal& refusal) {
    return refusal.error;
  }
}

}  // namespace stormproof::model::config::vendor
