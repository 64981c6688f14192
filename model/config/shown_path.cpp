// Compares paths as text: a file that was found by name has its folder's path in front.
#include "model/config/shown_path.hpp"

#include <filesystem>

#include "model/config/spec_path.hpp"

namespace stormproof::model::config {
namespace fs = std::filesystem;

std::string shown_path(const std::string& file) {
  const fs::path path = fs::path{file}.lexically_normal();
  if (!path.is_absolute()) return file;
  for (const std::string& directory : SpecPath::standard().directories) {
    const fs::path inside = path.lexically_relative(fs::path{directory}.lexically_normal());
    if (!inside.empty() && *inside.begin() != "..") return (fs::path{"specs"} / inside).string();
  }
  return file;
}

std::string shown_place(const Place& place) {
  if (!place.source) return place.to_string();
  Place shown = place;
  shown.source = std::make_shared<const std::string>(shown_path(*place.source));
  return shown.to_string();
}

}  // namespace stormproof::model::config
