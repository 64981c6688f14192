// `stormproof properties`: the catalogue.
#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/rendered.hpp"
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

struct PropertiesArguments {};

Outcome run(PropertiesArguments& /*none*/, Session& session) {
  Answer answer;
  answer.json["properties"] = nlohmann::ordered_json::array();
  for (const props::Property& property : props::catalogue()) {
    answer.json["properties"].push_back(to_json(property));
  }
  answer.rendered = rendered(session, [](report::Format) {
    std::string text;
    for (const props::Property& property : props::catalogue()) text += to_text(property);
    return text;
  });
  return answer;
}

void declare(Options& /*none*/, PropertiesArguments& /*none*/) {}

}  // namespace

void declare_properties(Frame& frame) {
  frame.add<PropertiesArguments>({.name = "properties",
                                  .help = "List the properties that check knows",
                                  .exit_codes = "Exit code: 0.",
                                  .formats = Formats::plain,
                                  .takes_long = false},
                                 declare, run);
}

}  // namespace stormproof::cli
