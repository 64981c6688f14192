// Tables of mutants and of properties.
#include "checker/verification/mutate/mutate_report.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "props/laws/law.hpp"
#include "props/property.hpp"

namespace stormproof::mutate {

namespace {

/// What the property tests say about a mutant.
std::string laws_text(const MutantResult& mutant) {
  if (!mutant.killed_by_laws) return "property tests: – (no run shows it)";
  if (mutant.killed_by_laws->empty()) return "property tests: none";
  return fmt::format("property tests: {}", fmt::join(*mutant.killed_by_laws, ", "));
}

}  // namespace

std::string to_text(const MutationReport& report) {
  constexpr std::size_t id_columns = 34;
  std::string text = report::left("mutant", id_columns) + "what is wrong, and who notices\n";
  for (const MutantResult& mutant : report.mutants) {
    text += report::paragraph(report::left(mutant.id, id_columns), mutant.description);
    const bool survives = mutant.killed_by.empty();
    text += report::paragraph(
        std::string(id_columns, ' ') + (survives ? "SURVIVES: " : "→ "),
        survives ? mutant.reason : fmt::format("{}", fmt::join(mutant.killed_by, ", ")));
    text += report::paragraph(std::string(id_columns, ' '), laws_text(mutant));
  }
  text += "\n" + report::left("property", id_columns) + "mutants that it notices\n";
  for (const props::Property& property : props::catalogue()) {
    text += fmt::format("{}{}\n", report::left(std::string{property.id}, id_columns),
                        report.killed_by(property.id));
  }
  text += "\n" + report::left("law", id_columns) + "mutants that it notices\n";
  for (const props::Law& law : props::laws()) {
    text += fmt::format("{}{}\n", report::left(std::string{law.id}, id_columns),
                        report.killed_by_law(law.id));
  }
  const std::size_t total = report.mutants.size();
  const auto share = [](std::size_t part, std::size_t whole) {
    return report::percent(static_cast<double>(part), static_cast<double>(whole));
  };
  text += fmt::format("\n{} of {} mutants are noticed ({}), in {:.1f} s\n", report.killed(), total,
                      share(report.killed(), total), report.seconds);
  text += fmt::format("killed by property tests: {} of the {} that a run can show ({})\n",
                      report.killed_by_laws(), report.tried_on_laws(),
                      share(report.killed_by_laws(), report.tried_on_laws()));
  if (report.interrupted) text += "Interrupted: the other mutants were not tried.\n";
  return text;
}

nlohmann::ordered_json to_json(const MutationReport& report) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["mutants"] = Json::array();
  for (const MutantResult& mutant : report.mutants) {
    Json entry;
    entry["id"] = mutant.id;
    entry["description"] = mutant.description;
    entry["killed_by"] = mutant.killed_by;
    entry["reason"] = mutant.killed_by.empty() ? Json(mutant.reason) : Json();
    entry["killed_by_laws"] = mutant.killed_by_laws ? Json(*mutant.killed_by_laws) : Json();
    json["mutants"].push_back(entry);
  }
  json["killed"] = report.killed();
  json["properties"] = Json::object();
  for (const props::Property& property : props::catalogue()) {
    json["properties"][std::string{property.id}] = report.killed_by(property.id);
  }
  json["killed_by_laws"] = report.killed_by_laws();
  json["tried_on_laws"] = report.tried_on_laws();
  json["laws"] = Json::object();
  for (const props::Law& law : props::laws()) {
    json["laws"][std::string{law.id}] = report.killed_by_law(law.id);
  }
  json["seconds"] = report.seconds;
  json["interrupted"] = report.interrupted;
  return json;
}

}  // namespace stormproof::mutate
