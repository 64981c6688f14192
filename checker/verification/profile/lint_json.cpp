// The JSON of `profile lint`.
#include "checker/presentation/json/schema.hpp"
#include "checker/verification/profile/lint_report.hpp"

namespace stormproof::model::config {

template <class V>
void describe(V& v, const InputError& error) {
  v("where", error.where);
  v("message", error.message);
}

namespace vendor {

template <class V>
void describe(V& v, const Remark& remark) {
  v("severity", remark.severity);
  v("rule", remark.rule);
  v("file", remark.place.source ? *remark.place.source : "");
  v("line", remark.place.line);
  v("column", remark.place.column);
  v("message", remark.message);
  v.or_null("hint", remark.hint);
}

}  // namespace vendor

}  // namespace stormproof::model::config

namespace stormproof::report {

template <class V>
void describe(V& v, const LintedFile& file) {
  v("file", file.reference);
  v("error", file.error);
  v.or_null("preset", file.preset);
  v("remarks", file.remarks);
  v("unmodelled_below", file.unmodelled_below);
}

template <class V>
void describe(V& v, const LintCounts& counts) {
  v("errors", counts.errors);
  v("warnings", counts.warnings);
  v("notes", counts.notes);
  v("unreadable", counts.unreadable);
}

namespace {

struct LintedFiles {
  const std::vector<LintedFile>& files;
};

template <class V>
void describe(V& v, const LintedFiles& all) {
  v("files", all.files);
  v("totals", count(all.files));
}

}  // namespace

nlohmann::ordered_json to_json(const std::vector<LintedFile>& files) {
  return json_of(LintedFiles{files});
}

nlohmann::ordered_json lint_schema(SchemaDefinitions& definitions) {
  return schema_form<LintedFiles>(definitions);
}

}  // namespace stormproof::report
