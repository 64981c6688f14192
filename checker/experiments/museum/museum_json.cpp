// All exhibits that were shown, each with the verdicts before and after its repair.
#include "checker/experiments/museum/museum.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::museum {

namespace {

struct Change {
  std::string key;
  std::string value;
};

template <class V>
void describe(V& v, const Change& change) {
  v("key", change.key);
  v("value", change.value);
}

/// What was decided of one set of rules.
struct Decided {
  const Variant& variant;
  const Found& found;
};

template <class V>
void describe(V& v, const Decided& decided) {
  const Found& found = decided.found;
  std::optional<model::Nanoseconds> time;
  std::string reason;
  std::vector<Change> changes;
  for (const auto& [key, value] : decided.variant.changes) changes.push_back({key, value});
  if (found.counterexample) {
    time = found.counterexample->time;
    reason = found.counterexample->reason;
  }
  v.or_null("title", decided.variant.title);
  v("changes", changes);
  v("verdict", found.verdict);
  v("expected_verdict", decided.variant.expected);
  v("how", found.how);
  v("assumptions", found.assumptions);
  v("runs", found.runs);
  v("lost_packets", found.lost);
  v("time_ns", time);
  v.or_null("reason", reason);
  v("latest_ns", found.latest);
}

}  // namespace

template <class V>
void describe(V& v, const ShownExhibit& shown) {
  const Exhibit& exhibit = shown.exhibit;
  std::vector<Decided> decoys;
  for (std::size_t k = 0; k < shown.decoys.size(); ++k) {
    decoys.push_back({exhibit.decoys[k], shown.decoys[k]});
  }
  v("id", exhibit.id);
  v("vendor", exhibit.vendor);
  v("year", exhibit.year);
  v("title", exhibit.title);
  v("sentence", exhibit.sentence);
  v("fix", exhibit.fix);
  v("links", exhibit.links);
  v("changed_rules", exhibit.rules);
  v("property", exhibit.claim);
  v("before", Decided{exhibit.before, shown.before});
  v("after", Decided{exhibit.after, shown.after});
  v("decoys", decoys);
  v("as_expected", shown.as_expected());
}

template <class V>
void describe(V& v, const Report& report) {
  v("exhibits", report.exhibits);
}

nlohmann::ordered_json to_json(const Report& report) { return report::json_of(report); }

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<Report>(definitions);
}

}  // namespace stormproof::museum
