// Prints the catalogue.
#include "checker/cli/properties_command.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "checker/cli/exit_code.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "props/property.hpp"

namespace stormproof::cli {

namespace {

std::string engines_of(const props::Property& property) {
  std::string text;
  for (const props::Engine engine : property.engines) {
    text += (text.empty() ? "" : ", ") + std::string{name_of(engine)};
  }
  return text;
}

std::string to_text(const props::Property& property) {
  std::string text = std::string{property.id} + "\n";
  const auto line = [&](const char* label, std::string_view content) {
    if (!content.empty()) text += report::paragraph(label, content);
  };
  line("  ", property.statement);
  line("  formal       ", property.formal);
  line("  Fast DDS     ", property.fastdds);
  line("  assuming     ", property.assumptions);
  line("  decided by   ", engines_of(property));
  line("  source       ", property.source);
  return text + "\n";
}

nlohmann::ordered_json to_json(const props::Property& property) {
  nlohmann::ordered_json json;
  json["id"] = property.id;
  json["statement"] = property.statement;
  json["formal"] = property.formal;
  json["fastdds"] = statement_of(property, model::ImplementationKind::fastdds);
  json["assumptions"] = property.assumptions;
  json["engines"] = nlohmann::ordered_json::array();
  for (const props::Engine engine : property.engines) json["engines"].push_back(name_of(engine));
  json["source"] = property.source;
  return json;
}

}  // namespace

int properties(bool json) {
  if (json) {
    nlohmann::ordered_json document;
    document["properties"] = nlohmann::ordered_json::array();
    for (const props::Property& property : props::catalogue()) {
      document["properties"].push_back(to_json(property));
    }
    fmt::print("{}\n", document.dump(2));
    return established;
  }
  for (const props::Property& property : props::catalogue()) fmt::print("{}", to_text(property));
  return established;
}

}  // namespace stormproof::cli
