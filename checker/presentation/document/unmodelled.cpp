// Says what the model leaves out: to people as assumptions, to code scanning as notes.
#include "checker/presentation/document/unmodelled.hpp"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/engine/profiles.hpp"

namespace stormproof::report {

void add_unmodelled(Document& document, const model::DdsProfile& dds, std::string_view whose,
                    const model::config::Places* places) {
  const std::string of = whose.empty() ? std::string{} : ", of " + std::string{whose};
  for (const auto& [setting, effect] : dds.unmodelled) {
    document.assumptions.push_back(code(setting) + (" (not in the model" + of + "): " + effect));
    if (places == nullptr) continue;
    Finding& note = document.findings.emplace_back();
    note.id = "stormproof.unmodelled";
    note.statement = unmodelled_heading;
    note.description = "No result depends on a setting that the model has not got.";
    note.outcome = Finding::Outcome::note;
    note.shown = Finding::Shown::code;
    note.message = setting + ": " + effect;
    note.identity = {document.title, std::string{whose}, setting};
    const auto place = places->find("dds.unmodelled." + setting);
    if (place != places->end()) note.locations.emplace_back(place->second);
  }
}

void add_unmodelled(Document& document, const model::Scenario& scenario,
                    const model::config::Places* places) {
  add_unmodelled(document, scenario.dds, "", places);
  const model::Profiles profiles{scenario};
  for (std::uint32_t k = 1; k < profiles.different().size(); ++k) {
    const model::DdsProfile& dds = profiles.different()[k];
    if (dds.unmodelled == scenario.dds.unmodelled) continue;
    std::vector<std::uint32_t> whose;
    for (std::uint32_t i = 0; i < scenario.deployment.size(); ++i) {
      if (profiles.number_of(i) == k) whose.push_back(i);
    }
    const char* word = whose.size() == 1 ? "participant" : "participants";
    add_unmodelled(document, dds, fmt::format("{} {}", word, fmt::join(whose, ", ")));
  }
}

}  // namespace stormproof::report
