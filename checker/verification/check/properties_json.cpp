// The JSON of the catalogue.
#include "checker/presentation/json/describe.hpp"
#include "checker/verification/check/properties_report.hpp"
#include "model/implementations.hpp"
#include "props/property.hpp"

namespace stormproof::props {

template <class V>
void describe(V& v, const Property& property) {
  v("id", property.id);
  v("statement", property.statement);
  v("formal", property.formal);
  for (const model::ImplementationKind kind : model::implementations) {
    if (kind == model::default_implementation) continue;
    v(model::traits_of(kind).name, statement_of(property, kind));
  }
  v("assumptions", property.assumptions);
  v("engines", property.engines);
  v("source", property.source);
}

}  // namespace stormproof::props

namespace stormproof::checker {

nlohmann::ordered_json properties_json() {
  nlohmann::ordered_json json;
  json["properties"] = report::json_of(props::catalogue());
  return json;
}

}  // namespace stormproof::checker
