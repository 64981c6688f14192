// The JSON of the mutants.
#include "checker/presentation/json/schema.hpp"
#include "checker/verification/mutate/mutate_report.hpp"
#include "props/laws/law.hpp"
#include "props/property.hpp"

namespace stormproof::mutate {

template <class V>
void describe(V& v, const MutantResult& mutant) {
  v("id", mutant.id);
  v("kind", mutant.kind);
  v("description", mutant.description);
  v("killed_by", mutant.killed_by);
  v.or_null("reason", mutant.noticed() ? "" : mutant.reason);
  v("killed_by_laws", mutant.killed_by_laws);
  v("makes_a_difference", !mutant.unseen());
  v("harm", mutant.harm);
}

template <class V>
void describe(V& v, const Share& share) {
  v("composition", share.composition);
  v("seen", share.seen);
  v("noticed_in_rules", share.noticed);
  v("suffices", share.suffices());
}

namespace {

struct ByProperty {
  const MutationReport& report;
};

template <class V>
void describe(V& v, const ByProperty& killed) {
  for (const props::Property& property : props::catalogue()) {
    v(property.id, killed.report.killed_by(property.id));
  }
}

struct ByLaw {
  const MutationReport& report;
};

template <class V>
void describe(V& v, const ByLaw& killed) {
  for (const props::Law& law : props::laws()) v(law.id, killed.report.killed_by_law(law.id));
}

}  // namespace

template <class V>
void describe(V& v, const MutationReport& report) {
  v("everybody", report.everybody);
  v("mutants", report.mutants);
  v("killed", report.killed());
  v("unseen", report.unseen());
  v("only_followed", report.only_followed());
  v("seen_at_effects", report.seen_at_effects());
  v("noticed_in_rules", report.noticed_in_rules());
  v("shares", report.shares());
  v("killed_by_property", ByProperty{report});
  v("killed_by_any_law", report.killed_by_laws());
  v("tried_on_laws", report.tried_on_laws());
  v("killed_by_law", ByLaw{report});
  v("seconds", report.seconds);
}

nlohmann::ordered_json to_json(const MutationReport& report) { return report::json_of(report); }

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<MutationReport>(definitions);
}

}  // namespace stormproof::mutate
