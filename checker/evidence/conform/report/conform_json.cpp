// The report as JSON; specs/guide/conforming.md explains the keys.
#include <algorithm>

#include "checker/evidence/capture/describe_capture.hpp"
#include "checker/evidence/conform/report/coverage.hpp"
#include "checker/evidence/conform/report/describe_bounds.hpp"
#include "checker/evidence/conform/report/effect_coverage.hpp"
#include "checker/evidence/conform/report/findings.hpp"
#include "checker/evidence/conform/report/names.hpp"
#include "checker/evidence/conform/report/report.hpp"
#include "checker/presentation/composition/composition_words.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::conform {

template <class V>
void describe(V& v, const Place& place) {
  v("source", place.source);
  v("destination", place.destination);
  v("writer", writer_name(place.writer));
}

template <class V>
void describe(V& v, const Need& need) {
  v("what", need.what);
  v("needed_ns", need.needed_ns);
  v("bound_ns", need.bound_ns);
}

template <class V>
void describe(V& v, const PlaceResult& result) {
  describe(v, result.place);
  v("explained", result.explained);
  v("lost", result.lost);
  v("unexplained_count", result.unexplained);
}

template <class V>
void describe(V& v, const RowCoverage& row) {
  v("row", row.use->row);
  v("text", row.use->text);
  v("times", row.use->times);
  v.or_null("ruled_out_by", row.ruled_out_by);
}

static RowCoverage example_of(report::Type<RowCoverage>) {
  static const RowUse use;
  return {.use = &use};
}

template <class V>
void describe(V& v, const MachineCoverage& machine) {
  v("machine", machine.machine);
  v("fired", machine.used);
  v("possible", machine.rows.size() - machine.ruled_out);
  v("rows", machine.rows);
}

template <class V>
void describe(V& v, const EffectCoverage& one) {
  v("effect", one.effect->id);
  v("text", draw::sentence(*one.effect));
  v("condition", draw::condition_words(*one.effect));
  v("sends", one.packets);
  v("times", one.times);
  v.or_null("ruled_out_by", one.ruled_out_by);
}

static EffectCoverage example_of(report::Type<EffectCoverage>) {
  static const fsm::composition::EffectInfo effect;
  return {.effect = &effect};
}

template <class V>
void describe(V& v, const RuleCoverage& rule) {
  v("rule", rule.rule);
  v("seen", rule.seen());
  v("possible", rule.possible());
}

/// Rules, or effects: how many of those that a capture shows, which, and which others there are.
template <class One>
struct Observed {
  std::uint64_t seen = 0;
  std::uint64_t possible = 0;
  std::vector<One> observable;
  const std::vector<std::string_view>& unobservable;
};

template <class V, class One>
void describe(V& v, const Observed<One>& all) {
  v("seen", all.seen);
  v("possible", all.possible);
  v("observable", all.observable);
  v("unobservable", all.unobservable);
}

template <class V>
void describe(V& v, const CompositionCoverage& coverage) {
  std::vector<EffectCoverage> effects;
  for (const RuleCoverage& rule : coverage.rules) {
    effects.insert(effects.end(), rule.effects.begin(), rule.effects.end());
  }
  v("composition", coverage.composition);
  v("rule_coverage", Observed<RuleCoverage>{coverage.rules_seen(), coverage.rules_possible(),
                                            coverage.rules, coverage.unobservable_rules});
  v("effect_coverage", Observed<EffectCoverage>{coverage.seen(), coverage.possible(),
                                                std::move(effects), coverage.unobservable});
  v("unattributed", coverage.unattributed);
}

static Names example_of(report::Type<Names>) {
  static const auto conversation = example_of(report::Type<capture::Conversation>{});
  return Names{conversation};
}

namespace {

using report::json_of;

/// What only the conversation names.
struct NamedEvent {
  const Names& names;
  std::size_t index = 0;
};

template <class V>
void describe(V& v, const NamedEvent& one) {
  const Names& names = one.names;
  const capture::Event& event = names.event(one.index);
  v("event", one.index);
  v("time_ns", event.time_ns);
  v("datagram", event.datagram);
  v("capture", names.capture_name(event));
  v("packet", names.datagram(event).packet);
  v("source", names.number(event.source));
  v("destination", event.destination ? names.number(*event.destination) : std::nullopt);
  v("multicast", event.is_multicast);
  v("text", event_text(event));
}

struct NamedFault {
  const Names& names;
  const Unexplained& unexplained;
};

template <class V>
void describe(V& v, const NamedFault& fault) {
  const Unexplained& one = fault.unexplained;
  describe(v, NamedEvent{fault.names, one.event});
  v("place", one.place);
  v("fault", one.fault);
  v("rule_broken", rule_broken_by(one.fault));
  v("what", one.what);
  v("nearest", one.nearest);
  v("needs", one.needs);
  std::vector<NamedEvent> context;
  for (const std::size_t event : one.context) context.push_back({fault.names, event});
  v("context", context);
}

struct NamedHidden {
  const Names& names;
  const Hidden& hidden;
};

template <class V>
void describe(V& v, const NamedHidden& one) {
  const Hidden& hidden = one.hidden;
  v("kind", hidden.kind);
  v("time_ns", hidden.time_ns);
  describe(v, hidden.place);
  v.unless_empty("machine", hidden.machine);
  if (!hidden.event) return;
  const capture::Event& event = one.names.event(*hidden.event);
  v("event", *hidden.event);
  v("sent_ns", event.time_ns);
  v("capture", one.names.capture_name(event));
  v("packet", one.names.datagram(event).packet);
  v("text", event_text(event));
}

/// Who took part, without what only `capture summarize` says.
struct Peer {
  const capture::Participant& participant;
};

template <class V>
void describe(V& v, const Peer& peer) {
  v("guid_prefix", to_string(peer.participant.prefix));
  v("host", peer.participant.host);
  v("vendor", capture::vendor_name(peer.participant.vendor));
  v("name", peer.participant.name);
}

/// What makes a result comparable with another one: verdict, profile, captures, bounds.
template <class V>
void describe_head(V& v, const Report& report) {
  const Conformance& result = report.result;
  v("verdict", verdict_token(result.verdict));
  v("profile_name", report.profile);
  v("captures", report.conversation.captures);
  v("first_ns", report.conversation.first_ns);
  v("until_ns", std::min(report.until_ns, report.conversation.last_ns));
  v("bounds", result.bounds);
  v.unless_empty("why_inconclusive", result.why_inconclusive);
}

/// What explaining took of the bounds.
struct UsedBounds {
  const Conformance& result;
};

template <class V>
void describe(V& v, const UsedBounds& used) {
  v("send_lag_ns", used.result.used_send_lag_ns);
  v("lateness_ns", used.result.used_lateness_ns);
  v("clock_age_ns", used.result.used_clock_age_ns);
}

/// How many events each rule explains.
struct ByRule {
  const Conformance& result;
};

template <class V>
void describe(V& v, const ByRule& by) {
  for (std::size_t k = 0; k < rule_count; ++k) {
    v(name_of(static_cast<Rule>(k)), by.result.by_rule[k]);
  }
}

/// The first line of an assignment.
struct AssignmentHead {
  const Report& report;
};

template <class V>
void describe(V& v, const AssignmentHead& head) {
  v("format", "stormproof-assignment");
  v("version", 2);
  describe_head(v, head.report);
}

}  // namespace

template <class V>
void describe(V& v, const Report& report) {
  const Conformance& result = report.result;
  const Names names{report.conversation};
  describe_head(v, report);
  v("bounds_used", UsedBounds{result});
  v("checked", result.checked);
  v("explained", result.explained);
  v("not_checked", result.not_checked);
  v("not_replayed", result.not_replayed);
  v("undecided", result.undecided);
  v("lost", result.lost);
  std::vector<NamedFault> unexplained;
  for (const Unexplained& one : result.unexplained) unexplained.push_back({names, one});
  v("unexplained", unexplained);
  nlohmann::ordered_map<std::string, std::uint64_t> faults;
  for (const FaultGroup& group : by_fault(result)) {
    faults[std::string{name_of(group.fault)}] = group.places;
  }
  v("faults", faults);
  v("rules", ByRule{result});
  v("machines", coverage_of(result.rows, report.dds));
  v("composition_coverage", effect_coverage(result, report.dds, report.impossible));
  std::vector<Peer> participants;
  for (const auto& one : report.conversation.topology.participants) participants.push_back({one});
  v("participants", participants);
  v("places", result.places);
  v("assumptions", result.assumptions);
  v.unless_empty("unmodelled", report.dds.unmodelled);
}

nlohmann::ordered_json to_json(const Report& report) { return json_of(report); }

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<Report>(definitions);
}

std::string assignment_lines(const Report& report) {
  const Names names{report.conversation};
  const auto line = [](const nlohmann::ordered_json& json) { return json.dump() + "\n"; };
  std::string text = line(json_of(AssignmentHead{report}));
  for (const Hidden& hidden : report.result.hidden) {
    text += line(json_of(NamedHidden{names, hidden}));
  }
  return text;
}

}  // namespace stormproof::conform
