// Puts a traced profile together with the comments of the presets and the vendor's table of knobs.
#include "checker/verification/profile/profile_report.hpp"

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "model/config/vendor/vendor_knobs.hpp"

namespace stormproof::report {

namespace config = model::config;
namespace vendor = model::config::vendor;
using Json = nlohmann::ordered_json;

namespace {

/// Evidence of presets: the comments of their files, by line.
class Comments {
 public:
  /// The comment at the end of a line, with the lines below it that are only a comment and are
  /// indented: those go on with it.
  std::string at(const std::string& file, int line) {
    const std::vector<std::string>& lines = lines_of(file);
    if (line < 1 || static_cast<std::size_t>(line) > lines.size()) return "";
    auto here = static_cast<std::size_t>(line) - 1;
    const std::size_t hash = lines[here].find(" #");
    if (hash == std::string::npos) return "";
    std::string comment{config::trimmed(std::string_view{lines[here]}.substr(hash + 2))};
    for (++here; here < lines.size(); ++here) {
      const std::size_t first = lines[here].find_first_not_of(' ');
      if (first == std::string::npos || first == 0 || lines[here][first] != '#') break;
      comment += " ";
      comment += config::trimmed(std::string_view{lines[here]}.substr(first + 1));
    }
    return comment;
  }

 private:
  const std::vector<std::string>& lines_of(const std::string& file) {
    const auto [entry, is_new] = files_.try_emplace(file);
    if (is_new) {
      std::ifstream in{file};
      for (std::string line; std::getline(in, line);) entry->second.push_back(line);
    }
    return entry->second;
  }

  std::map<std::string, std::vector<std::string>> files_;
};

class Describer {
 public:
  Describer(const config::TracedProfile& traced, const config::SpecPath& specs)
      : traced_{traced}, specs_{specs} {}

  ProfileReport describe() {
    report_.reference = traced_.reference;
    report_.preset = traced_.preset;
    find_distribution();
    find_vendor();
    if (traced_.vendor) {
      report_.selected = traced_.vendor->name;
      const auto& source = traced_.vendor->changes.place.source;
      if (source) report_.vendor_file = *source;
      const auto is_other = [](const vendor::Setting& setting) {
        return setting.effect != vendor::Effect::knob;
      };
      std::ranges::copy_if(traced_.vendor->settings, std::back_inserter(report_.others), is_other);
      const auto counts = [](const vendor::Remark& remark) {
        return remark.severity != vendor::Severity::note;
      };
      report_.remarks =
          static_cast<std::size_t>(std::ranges::count_if(traced_.vendor->remarks, counts));
    }
    Json effective = config::effective_json(traced_.value);
    effective.erase("unmodelled");
    add_knobs(effective, "");
    for (const auto& [setting, effect] : traced_.value.unmodelled) {
      report_.unmodelled.push_back({setting, effect, origin_of("unmodelled." + setting)});
    }
    return std::move(report_);
  }

 private:
  /// "humble", or "robots.xml@humble".
  void find_distribution() {
    const auto all = config::read_distributions(specs_.directories);
    if (!all) return;
    const std::string& given = traced_.reference;
    for (const config::Distribution& one : *all) {
      const bool is_named = given == one.name || given.ends_with("@" + one.name);
      if (is_named && one.profile == traced_.preset) report_.distribution = one;
    }
  }

  void find_vendor() {
    report_.vendor =
        traced_.vendor ? traced_.vendor->vendor : vendor::vendor_of_preset(traced_.preset);
  }

  void add_knobs(const Json& map, const std::string& prefix) {
    for (const auto& [name, value] : map.items()) {
      const std::string key = prefix + name;
      if (value.is_object()) {
        add_knobs(value, key + ".");
        continue;
      }
      const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
      report_.knobs.push_back({key, text, origin_of(key), access_of(key)});
    }
  }

  Origin origin_of(const std::string& key) {
    Origin origin;
    const auto place = traced_.places.find(key);
    if (place == traced_.places.end() || !place->second.source) return origin;
    origin.place = place->second;
    const std::string& file = *origin.place.source;
    if (origin.place.line == 0) {
      origin.giver = Giver::override;
    } else if (is_of_vendor(origin.place)) {
      origin.giver = Giver::vendor;
      origin.element = element_of(key, origin.place);
    } else if (const auto preset = specs_.name_of(config::SpecKind::dds, file)) {
      origin.giver = Giver::preset;
      origin.preset = *preset;
      origin.evidence = comments_.at(file, origin.place.line);
    } else {
      origin.giver = Giver::file;
    }
    return origin;
  }

  [[nodiscard]] bool is_of_vendor(const config::Place& place) const {
    return !report_.vendor_file.empty() && report_.vendor_file == *place.source;
  }

  /// Path of the element of the vendor's file that says `key`.
  [[nodiscard]] std::string element_of(const std::string& key, const config::Place& place) const {
    const auto& settings = traced_.vendor->settings;
    const auto says_key = [&](const vendor::Setting& setting) { return setting.knob == key; };
    const auto is_there = [&](const vendor::Setting& setting) {
      return setting.place.line == place.line;
    };
    auto found = std::ranges::find_if(settings, says_key);
    if (found == settings.end()) found = std::ranges::find_if(settings, is_there);
    return found == settings.end() ? "" : found->path;
  }

  [[nodiscard]] std::optional<Access> access_of(const std::string& key) const {
    if (!report_.vendor) return std::nullopt;
    for (const vendor::VendorKnob& knob : vendor::vendor_knobs(*report_.vendor)) {
      if (knob.key != key) continue;
      return Access{!knob.setting.empty(), std::string{knob.setting}, std::string{knob.why}};
    }
    return std::nullopt;
  }

  const config::TracedProfile& traced_;
  const config::SpecPath& specs_;
  Comments comments_;
  ProfileReport report_;
};

}  // namespace

const char* name_of(Giver giver) {
  constexpr std::array names{"file", "vendor file", "override", "preset", "model"};
  return names[static_cast<std::size_t>(giver)];
}

ProfileReport describe_profile(const config::TracedProfile& traced, const config::SpecPath& specs) {
  return Describer{traced, specs}.describe();
}

}  // namespace stormproof::report
