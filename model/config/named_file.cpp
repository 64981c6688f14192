// The first directory that has the name wins, as for scenarios and profiles.
#include "model/config/named_file.hpp"

#include <fmt/core.h>

#include "model/config/tree/suggestion.hpp"

namespace stormproof::model::config {

Result<std::string> find_named_file(const std::string& reference, std::string_view noun,
                                    SpecKind kind, const SpecPath& specs) {
  if (is_path(reference)) return reference;
  if (const auto file = specs.named(kind, reference)) return *file;
  return InputError{
      reference, fmt::format("no {} of this name{}; expected a file, or a name in specs/{}", noun,
                             suggestion(reference, specs.names(kind)), folder_name(kind))};
}

}  // namespace stormproof::model::config
