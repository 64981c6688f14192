// The page for scripts; specs/guide/doctor.md explains the keys.
#include "checker/evidence/capture/describe_capture.hpp"
#include "checker/evidence/doctor/doctor.hpp"
#include "checker/presentation/json/describe_model.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::doctor {

template <class V>
void describe(V& v, const Product& product) {
  v("vendor", product.vendor);
  v.or_null("version", product.version);
  v("participant_count", product.participants);
}

template <class V>
void describe(V& v, const Cause& cause) {
  v("id", cause.id);
  v("messages", cause.messages);
  v("text", cause.sentence);
}

template <class V>
void describe(V& v, const Reason& reason) {
  v("id", reason.id);
  v("probability", reason.probability);
  v("text", reason.sentence);
  v("remedy", reason.remedy);
  v("keeps_apart", reason.keeps_apart);
}

template <class V>
void describe(V& v, const Heard::From& from) {
  v("host", from.host);
  v("datagrams", from.datagrams);
  v("sent", from.sent);
}

template <class V>
void describe(V& v, const Heard& heard) {
  v("capture", heard.capture);
  v("from", heard.hosts);
}

template <class V>
void describe(V& v, const Predicted& predicted) {
  v("t_disc_ns", predicted.completion_ns);
  v("messages", predicted.messages);
}

template <class V>
void describe(V& v, const Advice& advice) {
  v("change", advice.settings);
  v("before", advice.before);
  v("after", advice.after);
  v("prerequisites", advice.prerequisites);
  v("xml", advice.xml);
}

template <class V>
void describe(V& v, const Basis& basis) {
  v("dds_profile", basis.dds);
  v("wireless_profile", basis.wireless);
  v("t_disc_ratio", basis.completion_ratio);
  v("message_ratio", basis.message_ratio);
}

template <class V>
void describe(V& v, const OneMachine& machine) {
  v("machine_id", machine.identity);
  v("on_hosts", machine.hosts);
}

namespace {

struct UnknownTypes {
  const capture::UnknownTypes& types;
};

template <class V>
void describe(V& v, const UnknownTypes& unknown) {
  v("can_be_looked_up", unknown.types.can_be_looked_up);
  v("most_of_a_participant", unknown.types.most_of_a_participant);
  v("lookup_due", unknown.types.lookups);
}

struct Missing {
  const Report& report;
};

template <class V>
void describe(V& v, const Missing& missing) {
  v("required", missing.report.counting.required);
  v("count", missing.report.missing);
}

}  // namespace

template <class V>
void describe(V& v, const Report& report) {
  const bool has_product = !report.products.empty();
  v("verdict", report.health);
  v.or_null("why_unknown", report.why_unknown);
  v.or_null("vendor", has_product ? report.products.front().vendor : "");
  v.or_null("version", has_product ? report.products.front().version : "");
  v("products", report.products);
  v("discovery_server", report.has_server);
  v("presets", report.presets);
  v("captures", report.conversation.captures);
  v("hosts", report.conversation.topology.hosts);
  v("participant_count", report.conversation.topology.participants.size());
  v("complete", report.complete());
  v("missing", Missing{report});
  v("known_before", report.known_before);
  v("completion_ns", report.completion_ns);
  v("storm", report.storm);
  v("needless_ratio", report.took.ratio());
  v("lookup_storm", report.lookup_storm());
  v("counts", report.counting.counts);
  v("failure_free", report.failure_free);
  v("later_announcements", report.later_announcements);
  v("lookups", capture::Lookups{report.counting});
  v("unknown_types", UnknownTypes{report.types});
  v("same_machine", report.machines);
  v("reasons", report.reasons);
  v("causes", report.causes);
  v("remarks", report.conversation.remarks);
  v("heard", report.heard);
  v("prediction", report.basis);
  v("advice", report.advice);
  v.or_null("no_advice", report.no_advice);
  v("without_lookups", report.without_lookups);
}

nlohmann::ordered_json to_json(const Report& report) { return report::json_of(report); }

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<Report>(definitions);
}

}  // namespace stormproof::doctor
