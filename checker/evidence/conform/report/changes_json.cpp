// The changes for programs.
#include "checker/evidence/conform/report/changes_report.hpp"
#include "checker/evidence/conform/report/describe_bounds.hpp"
#include "checker/evidence/conform/report/findings.hpp"
#include "checker/presentation/json/describe.hpp"

namespace stormproof::conform {

template <class V>
void describe(V& v, const Tried& one) {
  v("change", one.change);
  v("set", one.set);
  v("notice", std::string{name_of(one.notice)});
  v("fault", one.fault);
  v("places", one.places);
}

template <class V>
void describe(V& v, const Sensitivity& one) {
  v("capture", one.capture);
  v("profile", one.profile);
  v("verdict", verdict_token(one.verdict));
  v("changes", one.tried);
}

template <class V>
void describe(V& v, const ChangesReport& report) {
  v("bounds", report.bounds);
  v("captures", report.captures);
  v("unnoticed", unnoticed(report));
}

nlohmann::ordered_json to_json(const ChangesReport& report) { return report::json_of(report); }

}  // namespace stormproof::conform
