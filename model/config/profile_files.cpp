// A profile is resolved from the outside in: read the file, resolve its base, merge. The chain of
// files on the way is kept to notice a profile that is based on itself. A vendor's XML file is read
// into the map that a YAML file with the same meaning would have.
#include "model/config/profile_files.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/core.h>
#include <fmt/ranges.h>

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
std::optional<InputError> check_vendor(const vendor::VendorProfile& profile, const Node& base) {
  const auto of_base = vendor::vendor_of_preset(base.text);
  if (!of_base || *of_base == profile.vendor) return std::nullopt;
  return error_at(base.place,
                  fmt::format("{} is a preset of {}; expected one of {}, whose file "
                              "this is",
                              base.shown(), name_of(*of_base), name_of(profile.vendor)));
}

class Resolver {
 public:
  Resolver(SpecKind kind, const SpecPath& specs, ProfileOrigin& origin, Outside outside)
      : kind_{kind}, specs_{specs}, origin_{origin}, outside_{outside} {}

  Result<Node> resolve(Node reference) {
    if (reference.is_map()) return resolve_map(std::move(reference));
    if (!reference.is_scalar()) {
      return error_at(reference.place, fmt::format("{} as a profile; expected a name, a path or a "
                                                   "map",
                                                   reference.shown()));
    }
    if (kind_ == SpecKind::dds) {
      if (const auto parts = vendor::parse_reference(reference.text)) {
        return resolve_xml(reference, *parts);
      }
    }
    return resolve_yaml(reference);
  }

 private:
  Result<Node> resolve_map(Node map) {
    if (auto error = drop_description(map)) return *std::move(error);
    std::optional<Node> base = map.take(base_key);
    if (!base) return map;
    Result<Node> resolved = resolve(*std::move(base));
    if (!resolved) return resolved;
    if (kind_ == SpecKind::dds) {
      const Node* implementation = map.find(implementation_key);
      if (auto error = check_implementation(*resolved, implementation)) return *std::move(error);
    }
    return merge(*std::move(resolved), std::move(map));
  }

  Result<Node> resolve_yaml(const Node& reference) {
    const auto file = find(reference, reference.text);
    if (!file) return file.error();
    if (auto error = enter(reference, *file, "")) return *std::move(error);
    if (origin_.preset.empty()) {
      origin_.preset = specs_.name_of(kind_, *file).value_or(std::string{});
    }
    Result<Node> tree = load_yaml(*file);
    if (!tree) return tree;
    if (!tree->is_map()) {
      return error_at(tree->place,
                      fmt::format("{} as a profile file; expected a map", tree->shown()));
    }
    return resolve_map(*std::move(tree));
  }

  Result<Node> resolve_xml(const Node& reference, const vendor::FileReference& parts) {
    const auto file = find(reference, parts.file);
    if (!file) return file.error();
    if (auto error = enter(reference, *file, parts.selection.profile)) return *std::move(error);
    const Result<vendor::XmlElement> root = vendor::load_xml(*file);
    if (!root) return root.error();
    Result<vendor::VendorProfile> profile = vendor::read_vendor_profile(*root, parts.selection);
    if (!profile) return profile.error();
    if (outside_ == Outside::refused) {
      if (auto error = refuse_errors(*profile)) return *std::move(error);
    }
    Node changes = profile->changes;
    if (Node* base = changes.find(base_key)) {
      base->place = reference.place;  // where the preset was chosen, or could have been
      if (auto error = check_vendor(*profile, *base)) return *std::move(error);
    }
    if (!origin_.vendor) origin_.vendor = *std::move(profile);
    return resolve_map(std::move(changes));
  }

  /// The file that stands in `reference`.
  Result<std::string> find(const Node& reference, const std::string& file) const {
    const Place& place = reference.place;
    const bool in_file = place.line > 0 && place.source != nullptr;
    const std::string directory =
        in_file ? fs::path{*place.source}.parent_path().string() : std::string{};
    return specs_.find(kind_, file, directory, place.to_string());
  }

  /// Notes that `file`, or the part of it with this name, is being resolved.
  std::optional<InputError> enter(const Node& reference, const std::string& file,
                                  const std::string& part) {
    std::error_code failed;
    std::string identity = fs::weakly_canonical(file, failed).string();
    if (!part.empty()) identity += "#" + part;
    const bool is_repeated = std::ranges::find(chain_, identity) != chain_.end();
    chain_.push_back(std::move(identity));
    if (is_repeated) {
      return error_at(reference.place, fmt::format("{} is based on itself: {}", reference.shown(),
                                                   fmt::join(chain_, " → ")));
    }
    if (chain_.size() <= max_base_chain) return std::nullopt;
    return error_at(reference.place,
                    fmt::format("more than {} profiles based on each other", max_base_chain));
  }

  SpecKind kind_;
  const SpecPath& specs_;
  ProfileOrigin& origin_;
  Outside outside_;
  std::vector<std::string> chain_;  ///< files that are being resolved, outermost first
};

}  // namespace

Result<Node> resolve_profile(Node reference, SpecKind kind, const SpecPath& specs,
                             ProfileOrigin* origin, Outside outside) {
  ProfileOrigin unwanted;
  Resolver resolver{kind, specs, origin != nullptr ? *origin : unwanted, outside};
  return resolver.resolve(std::move(reference));
}

std::optional<InputError> check_implementation(const Node& profile, const Node* replacement) {
  if (replacement == nullptr || !replacement->is_scalar()) return std::nullopt;
  const Node* own = profile.find(implementation_key);
  if (own != nullptr && !own->is_scalar()) return std::nullopt;
  const std::string_view name = own != nullptr ? own->text : name_of(ImplementationKind::paper);
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
