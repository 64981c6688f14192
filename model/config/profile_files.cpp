// A profile is resolved from the outside in: read the file, resolve its base, merge. The chain of
// files on the way is kept to notice a profile that is based on itself.
#include "model/config/profile_files.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/config/dds_knobs.hpp"
#include "model/config/yaml_text.hpp"

namespace stormproof::model::config {
namespace fs = std::filesystem;
namespace {

class Resolver {
 public:
  Resolver(SpecKind kind, const SpecPath& specs) : kind_{kind}, specs_{specs} {}

  Result<Node> resolve(Node reference) {
    if (reference.is_map()) return resolve_map(std::move(reference));
    if (reference.is_scalar()) return resolve_file(reference);
    return error_at(
        reference.place,
        fmt::format("{} as a profile; expected a name, a path or a map", reference.shown()));
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

  Result<Node> resolve_file(const Node& reference) {
    const Place& place = reference.place;
    const bool in_file = place.line > 0 && place.source != nullptr;
    const std::string directory =
        in_file ? fs::path{*place.source}.parent_path().string() : std::string{};
    const auto file = specs_.find(kind_, reference.text, directory, place.to_string());
    if (!file) return file.error();

    std::error_code failed;
    const std::string identity = fs::weakly_canonical(*file, failed).string();
    const bool is_repeated = std::ranges::find(chain_, identity) != chain_.end();
    chain_.push_back(identity);
    if (is_repeated) {
      return error_at(place, fmt::format("{} is based on itself: {}", reference.shown(),
                                         fmt::join(chain_, " → ")));
    }
    if (chain_.size() > max_base_chain) {
      return error_at(place,
                      fmt::format("more than {} profiles based on each other", max_base_chain));
    }
    Result<Node> tree = load_yaml(*file);
    if (!tree) return tree;
    if (!tree->is_map()) {
      return error_at(tree->place,
                      fmt::format("{} as a profile file; expected a map", tree->shown()));
    }
    return resolve_map(*std::move(tree));
  }

  SpecKind kind_;
  const SpecPath& specs_;
  std::vector<std::string> chain_;  ///< files that are being resolved, outermost first
};

}  // namespace

Result<Node> resolve_profile(Node reference, SpecKind kind, const SpecPath& specs) {
  return Resolver{kind, specs}.resolve(std::move(reference));
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
