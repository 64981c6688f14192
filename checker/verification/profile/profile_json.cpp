// The JSON of `profile show`.
#include "checker/presentation/json/schema.hpp"
#include "checker/verification/profile/profile_report.hpp"

namespace stormproof::model::config {

template <class V>
void describe(V& v, const Distribution& distribution) {
  v("name", distribution.name);
  v("ships", distribution.ships);
  v("profile_name", distribution.profile);
  v("stands_in", stands_in(distribution));
  v("why", distribution.why);
}

}  // namespace stormproof::model::config

namespace stormproof::model::config::vendor {

template <class V>
void describe(V& v, const Setting& setting) {
  v("path", setting.path);
  v("value", setting.value);
  v("line", setting.place.line);
  v("column", setting.place.column);
  v("effect", setting.effect);
  v("note", setting.note);
}

}  // namespace stormproof::model::config::vendor

namespace stormproof::report {

template <class V>
void describe(V& v, const Origin& origin) {
  v("by", origin.giver);
  const auto known = [](int number) { return number > 0 ? std::optional{number} : std::nullopt; };
  v.unless_empty("file", origin.place.source ? std::string_view{*origin.place.source} : "");
  v.unless_empty("line", known(origin.place.line));
  v.unless_empty("column", known(origin.place.column));
  v.unless_empty("preset", origin.preset);
  v.unless_empty("evidence", origin.evidence);
  v.unless_empty("element", origin.element);
}

template <class V>
void describe(V& v, const Access& access) {
  v("changeable", access.changeable);
  v.or_null("setting", access.changeable ? access.setting : "");
  v("why", access.why);
}

template <class V>
void describe(V& v, const KnobRow& row) {
  v("key", row.key);
  v("value", row.value);
  v("origin", row.origin);
  v("user", row.access);
}

template <class V>
void describe(V& v, const UnmodelledRow& row) {
  v("setting", row.setting);
  v("effect", row.effect);
  v("origin", row.origin);
}

template <class V>
void describe(V& v, const ProfileReport& report) {
  v("profile_name", report.reference);
  v.or_null("preset", report.preset);
  v("distribution", report.distribution);
  v("vendor", report.vendor);
  v.or_null("vendor_file", report.vendor_file);
  v.or_null("selected", report.selected);
  v("knobs", report.knobs);
  v("settings", report.others);
  v("unmodelled_settings", report.unmodelled);
  v("remark_count", report.remarks);
}

nlohmann::ordered_json to_json(const ProfileReport& report) { return json_of(report); }

nlohmann::ordered_json profile_schema(SchemaDefinitions& definitions) {
  return schema_form<ProfileReport>(definitions);
}

}  // namespace stormproof::report
