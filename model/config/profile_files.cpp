// Profiles are read from the outside in, each naming the next, and merged from the inside out. The
// files on the way are kept to notice a profile that is based on itself. A vendor's XML file is
// read into the map that a YAML file with the same meaning would have.
#include "model/config/profile_files.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "model/config/distributions.hpp"
#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "model/config/vendor/reference.hpp"
#include "model/config/vendor/vendor_knobs.hpp"

namespace stormproof::model::config {
namespace fs = std::filesystem;
namespace {

/// The first thing in the file that no run may have.
std::optional<InputError> refuse_errors(const vendor::VendorProfile& profile) {
  const auto is_error = [](const vendor::Remark& remark) {
    return remark.severity == vendor::Severity::error;
  };
  const auto remark = std::ranges::find_if(profile.remarks, is_error);
  if (remark == profile.remarks.end()) return std::nullopt;
  return error_at(remark->place, remark->hint.empty()
                                     ? remark->message
                                     : fmt::format("{}; {}", remark->message, remark->hint));
}

/// A file of one vendor's library does not change a preset of another's.
std::optional<InputError> check_vendor(const vendor::VendorProfile& profile, const Node& base,
                                       const SpecPath& specs) {
  const auto file = specs.named(SpecKind::dds, base.text);  // also of a distribution
  const auto preset = file ? specs.name_of(SpecKind::dds, *file) : std::nullopt;
  const auto of_base = vendor::vendor_of_preset(preset.value_or(base.text));
  if (!of_base || *of_base == profile.vendor) return std::nullopt;
  return error_at(base.place,
                  fmt::format("{} is a preset of {}; expected one of {}, whose file "
                              "this is",
                              base.shown(), name_of(*of_base), name_of(profile.vendor)));
}

/// Reads one profile after the other, from the outside in.
class Chain {
 public:
  Chain(SpecKind kind, const SpecPath& specs, Outside outside)
      : kind_{kind}, specs_{specs}, outside_{outside} {}

  /// The map that `reference` means: the keys of one profile, and its base, if it has one.
  Result<Node> read(Node reference) {
    if (reference.is_map()) return reference;
    if (!reference.is_scalar()) {
      return error_at(reference.place, fmt::format("{} as a profile; expected a name, a path or a "
                                                   "map",
                                                   reference.shown()));
    }
    if (kind_ == SpecKind::dds) {
      if (const auto parts = vendor::parse_reference(reference.text)) {
        return read_xml(reference, *parts);
      }
    }
    return read_yaml(reference);
  }

  std::string preset;                           ///< of the first profile that has a name
  std::optional<vendor::VendorProfile> vendor;  ///< the first one

 private:
  Result<Node> read_yaml(const Node& reference) {
    const auto file = enter(reference, reference.text, "");
    if (!file) return file.error();
    if (preset.empty()) preset = specs_.name_of(kind_, *file).value_or(std::string{});
    Result<Node> tree = load_yaml(*file);
    if (!tree || tree->is_map()) return tree;
    return error_at(tree->place,
                    fmt::format("{} as a profile file; expected a map", tree->shown()));
  }

  Result<Node> read_xml(const Node& reference, const vendor::FileReference& parts) {
    auto document = load(reference, parts);
    if (!document) return document.error();
    auto selection = selected(parts.selection, vendor::vendor_of(*document));
    if (!selection) return selection.error();
    Result<vendor::VendorProfile> profile =
        vendor::read_vendor_profile(*std::move(document), *selection);
    if (!profile) return profile.error();
    if (outside_ == Outside::refused) {
      if (auto error = refuse_errors(*profile)) return *std::move(error);
    }
    Node changes = profile->changes;
    if (Node* base = changes.find(base_key)) {
      base->place = reference.place;  // where the preset was chosen, or could have been
      if (auto error = check_vendor(*profile, *base, specs_)) return *std::move(error);
    }
    if (!vendor) vendor = *std::move(profile);
    return changes;
  }

  /// With the preset in place of a distribution, which has a version of either vendor's library.
  Result<vendor::Selection> selected(vendor::Selection selection,
                                     std::optional<vendor::Vendor> vendor) const {
    if (selection.base.empty() || !vendor) return selection;
    const std::vector<std::string> files = specs_.names(kind_);
    if (std::ranges::find(files, selection.base) != files.end()) return selection;
    const Rmw rmw =
        *vendor == vendor::Vendor::cyclonedds ? Rmw::cyclonedds : Rmw::of_the_distribution;
    const auto known = read_distributions(specs_.directories, rmw);
    if (!known) return known.error();
    const auto one = std::ranges::find(*known, selection.base, &Distribution::name);
    if (one != known->end()) selection.base = one->profile;
    return selection;
  }

  Result<vendor::XmlDocument> load(const Node& reference, const vendor::FileReference& parts) {
    if (parts.file.empty()) {
      auto document = vendor::parse_vendor_xml(parts.text, "CYCLONEDDS_URI");
      if (document) document->is_variable = true;
      return document;
    }
    const auto file = enter(reference, parts.file, parts.selection.profile);
    if (!file) return file.error();
    return vendor::load_xml(*file);
  }

  /// The file that stands in `reference`; it, or the part of it with this name, is in the chain
  /// from now on.
  Result<std::string> enter(const Node& reference, const std::string& name,
                            const std::string& part) {
    const Place& place = reference.place;
    const bool in_file = place.line > 0 && place.source != nullptr;
    const std::string directory =
        in_file ? fs::path{*place.source}.parent_path().string() : std::string{};
    auto file = specs_.find(kind_, name, directory, place.to_string());
    if (!file) return file;
    std::error_code failed;
    std::string identity = fs::weakly_canonical(*file, failed).string();
    if (!part.empty()) identity += "#" + part;
    const bool is_repeated = std::ranges::find(files_, identity) != files_.end();
    files_.push_back(std::move(identity));
    if (is_repeated) {
      return error_at(place, fmt::format("{} is based on itself: {}", reference.shown(),
                                         fmt::join(files_, " → ")));
    }
    if (files_.size() <= max_base_chain) return file;
    return error_at(place,
                    fmt::format("more than {} profiles based on each other", max_base_chain));
  }

  SpecKind kind_;
  const SpecPath& specs_;
  Outside outside_;
  std::vector<std::string> files_;  ///< outermost first
};

}  // namespace

namespace {

/// Whether the keys of the profile are for the implementation. Takes what says so out of it.
Result<bool> concerns(Node& profile, SpecKind kind, std::string_view implementation) {
  if (kind != SpecKind::wireless) return true;
  const std::optional<Node> only = profile.take(only_with_key);
  if (!only) return true;
  const auto is_known = [](const Node& item) {
    return item.is_scalar() && std::ranges::any_of(implementations, [&](ImplementationKind known) {
             return name_of(known) == item.text;
           });
  };
  if (!only->is_sequence() || !std::ranges::all_of(only->items, is_known)) {
    return error_at(only->place, fmt::format("{}: {}; expected a list of implementations",
                                             only_with_key, only->shown()));
  }
  if (profile.find(base_key) == nullptr) {
    return error_at(only->place, fmt::format("{}: needs a {}, which is the profile with another "
                                             "implementation; expected one",
                                             only_with_key, base_key));
  }
  return implementation.empty() || std::ranges::any_of(only->items, [&](const Node& item) {
           return item.text == implementation;
         });
}

}  // namespace

std::string_view implementation_of(const Node& dds) {
  const Node* word = dds.find(implementation_key);
  return word != nullptr && word->is_scalar() ? std::string_view{word->text}
                                              : name_of(default_implementation);
}

Result<Resolved> resolve_profile(Node reference, SpecKind kind, const SpecPath& specs,
                                 Outside outside, std::string_view implementation) {
  Chain chain{kind, specs, outside};
  std::vector<Node> profiles;  // outermost first
  for (std::optional<Node> next = std::move(reference); next;) {
    Result<Node> profile = chain.read(*std::move(next));
    if (!profile) return profile.error();
    if (auto error = drop_description(*profile)) return *std::move(error);
    const Result<bool> counts = concerns(*profile, kind, implementation);
    if (!counts) return counts.error();
    next = profile->take(base_key);
    if (*counts) profiles.push_back(*std::move(profile));
  }
  Node tree = std::move(profiles.back());
  for (profiles.pop_back(); !profiles.empty(); profiles.pop_back()) {
    Node& changes = profiles.back();
    if (kind == SpecKind::dds) {
      const Node* implementation = changes.find(implementation_key);
      if (auto error = check_implementation(tree, implementation)) return *std::move(error);
    }
    tree = merge(std::move(tree), std::move(changes));
  }
  return Resolved{std::move(tree), std::move(chain.preset), std::move(chain.vendor)};
}

std::optional<InputError> check_implementation(const Node& profile, const Node* replacement) {
  if (replacement == nullptr || !replacement->is_scalar()) return std::nullopt;
  const Node* own = profile.find(implementation_key);
  if (own != nullptr && !own->is_scalar()) return std::nullopt;
  const std::string_view name = own != nullptr ? own->text : name_of(default_implementation);
  if (replacement->text == name) return std::nullopt;
  return error_at(replacement->place,
                  fmt::format("{}: {}; expected {}, as the profile that this changes has it; the "
                              "keys of one do not fit the other",
                              implementation_key, replacement->shown(), name));
}

std::optional<InputError> drop_description(Node& map) {
  const std::optional<Node> description = map.take(description_key);
  if (!description || description->is_scalar()) return std::nullopt;
  return error_at(description->place,
                  fmt::format("{}: {}; expected text", description_key, description->shown()));
}

}  // namespace stormproof::model::config
