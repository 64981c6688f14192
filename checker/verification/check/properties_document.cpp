// The catalogue as a table; what is said of a property stands below it.
#include <fmt/core.h>

#include "checker/verification/check/properties_report.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"

namespace stormproof::checker {

namespace {

std::string engines_of(const props::Property& property) {
  std::string text;
  for (const props::Engine engine : property.engines) {
    text += (text.empty() ? "" : ", ") + std::string{name_of(engine)};
  }
  return text;
}

report::Table::Row row_of(const props::Property& property) {
  report::Facts facts;
  const auto fact = [&](std::string_view label, std::string_view text) {
    if (!text.empty()) facts.rows.emplace_back(label, text);
  };
  fact("formal", property.formal);
  for (const model::ImplementationKind kind : model::implementations) {
    fact(model::traits_of(kind).whose, applicability_of(property, kind).addition);
  }
  fact("assuming", property.assumptions);
  fact("decided by", engines_of(property));
  fact("source", property.source);
  return {{report::code(property.id), property.statement},
          false,
          {std::move(facts)},
          "formally, and who decides it"};
}

}  // namespace

report::Document properties_document() {
  report::Document document;
  document.title = "stormproof properties";
  document.answer = fmt::format("{} properties, and who decides them", props::catalogue().size());
  report::Table table;
  table.columns = {{"property"}, {"what it says", report::Column::Align::left, true}};
  for (const props::Property& property : props::catalogue()) {
    table.rows.push_back(row_of(property));
  }
  document.blocks.emplace_back(std::move(table));
  return document;
}

}  // namespace stormproof::checker
