// The JSON of the catalogue.
#include "checker/presentation/json/schema.hpp"
#include "checker/verification/check/properties_report.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"
#include "props/property.hpp"

namespace stormproof::props {

template <class V>
void describe(V& v, const Property& property) {
  v("id", property.id);
  v("statement", property.statement);
  v("formal", property.formal);
  for (const model::ImplementationKind kind : model::implementations) {
    if (kind == model::default_implementation) continue;
    const std::string_view name = model::traits_of(kind).name;
    if (model::traits_of(kind).is_known_to_engines) {
      v(name, statement_of(property, kind));
    } else {
      const bool applies = applicability_of(property, kind).applies();
      v.unless_empty(name, applies ? statement_of(property, kind) : std::string{});
    }
  }
  v("assumptions", property.assumptions.empty() ? std::vector<std::string_view>{}
                                                : std::vector{property.assumptions});
  v("engines", property.engines);
  v("reference", property.source);
}

}  // namespace stormproof::props

namespace stormproof::checker {

namespace {

struct Catalogue {};

template <class V>
void describe(V& v, const Catalogue&) {
  v("properties", props::catalogue());
}

}  // namespace

nlohmann::ordered_json properties_json() { return report::json_of(Catalogue{}); }

nlohmann::ordered_json properties_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<Catalogue>(definitions);
}

}  // namespace stormproof::checker
