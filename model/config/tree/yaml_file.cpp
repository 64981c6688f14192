// What of YAML does not depend on who parses it: files, and scalars that are written.
#include "model/config/tree/file_text.hpp"
#include "model/config/tree/yaml_text.hpp"

namespace stormproof::model::config {

Result<Node> load_yaml(const std::string& path) {
  const auto text = file_text(path, max_file_bytes);
  if (!text) return text.error();
  return parse_yaml(*text, path);
}

std::string quoted_scalar(std::string text) {
  for (std::size_t k = 0; (k = text.find('\'', k)) != std::string::npos; k += 2) {
    text.insert(k, 1, '\'');
  }
  return "'" + text + "'";
}

}  // namespace stormproof::model::config
