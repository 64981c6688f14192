// What is said of properties by name.
#include "props/property.hpp"

#include "props/applicability.hpp"
#include "props/limits.hpp"

namespace stormproof::props {

const char* name_of(Engine engine) {
  switch (engine) {
    case Engine::tables:
      return "tables";
    case Engine::explorer:
      return "explorer";
    case Engine::timelines:
      return "timelines";
    case Engine::exact_run:
      return "exact run";
    case Engine::calculus:
      return "network calculus";
  }
  return "";
}

const char* name_of(Reach reach) {
  switch (reach) {
    case Reach::deployment:
      return "deployment";
    case Reach::profile:
      return "profile";
    case Reach::rules:
      return "rules";
  }
  return "";
}

std::string statement_of(const Property& property, model::ImplementationKind implementation) {
  const Applicability answer = applicability_of(property, implementation);
  std::string text{property.statement};
  if (!answer.addition.empty()) text.append(" ").append(answer.addition);
  if (answer.is_about_clients) text.append(" It is about what clients tell the server.");
  return text;
}

const Property* find_property(std::string_view id) {
  for (const Property& property : catalogue()) {
    if (property.id == id) return &property;
  }
  for (const Property& property : limit_properties()) {
    if (property.id == id) return &property;
  }
  return nullptr;
}

}  // namespace stormproof::props
