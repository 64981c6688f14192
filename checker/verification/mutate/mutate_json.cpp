// The JSON of the mutants.
#include "checker/presentation/json/describe.hpp"
#include "checker/verification/mutate/mutate_report.hpp"
#include "props/laws/law.hpp"
#include "props/property.hpp"

namespace stormproof::mutate {

template <class V>
void describe(V& v, const MutantResult& mutant) {
  v("id", mutant.id);
  v("kind", name_of(mutant.kind));
  v("description", mutant.description);
  v("killed_by", mutant.killed_by);
  v.or_null("reason", mutant.noticed() ? "" : mutant.reason);
  v("killed_by_laws", mutant.killed_by_laws);
  v("makes_a_difference", mutant.makes_a_difference);
}

template <class V>
void describe(V& v, const MutationReport& report) {
  nlohmann::ordered_json properties;
  for (const props::Property& property : props::catalogue()) {
    properties[std::string{property.id}] = report.killed_by(property.id);
  }
  nlohmann::ordered_json laws;
  for (const props::Law& law : props::laws()) {
    laws[std::string{law.id}] = report.killed_by_law(law.id);
  }
  v("mutants", report.mutants);
  v("killed", report.killed());
  v("harmless", report.harmless());
  v("properties", properties);
  v("killed_by_laws", report.killed_by_laws());
  v("tried_on_laws", report.tried_on_laws());
  v("laws", laws);
  v("seconds", report.seconds);
}

nlohmann::ordered_json to_json(const MutationReport& report) { return report::json_of(report); }

}  // namespace stormproof::mutate
