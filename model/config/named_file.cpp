// The first directory that has the name wins, as for scenarios and profiles.
#include "model/config/named_file.hpp"

#include <filesystem>
#include <vector>

#include <fmt/core.h>

#include "model/config/tree/suggestion.hpp"

namespace stormproof::model::config {
namespace fs = std::filesystem;

Result<std::string> find_named_file(const std::string& reference, std::string_view noun,
                                    std::string_view folder_name, const SpecPath& specs) {
  const bool is_path = reference.find('/') != std::string::npos || reference.ends_with(".yaml") ||
                       reference.ends_with(".yml");
  if (is_path) return reference;
  std::vector<std::string> known;
  for (const std::string& directory : specs.directories) {
    std::error_code failed;
    const fs::path folder = fs::path{directory} / folder_name;
    const fs::path file = folder / (reference + ".yaml");
    if (!reference.empty() && fs::exists(file, failed)) return file.string();
    for (fs::directory_iterator files{folder, failed}; !failed && files != fs::directory_iterator{};
         files.increment(failed)) {
      if (files->path().extension() == ".yaml") known.push_back(files->path().stem().string());
    }
  }
  return InputError{
      reference, fmt::format("no {} of this name{}; expected a file, or a name in specs/{}", noun,
                             suggestion(reference, known), folder_name)};
}

}  // namespace stormproof::model::config
