// The report as JSON; specs/guide/conforming.md explains the keys. Names in a capture are any
// bytes, so every text is made valid here.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "checker/evidence/conform/report/coverage.hpp"
#include "checker/evidence/conform/report/findings.hpp"
#include "checker/evidence/conform/report/names.hpp"
#include "checker/evidence/conform/report/report.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::conform {

namespace {

using Json = nlohmann::ordered_json;
using report::valid_text;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json{};
}

Json bounds_json(const Bounds& bounds) {
  return {
      {"least_delay_ns", bounds.least_delay_ns},     {"most_delay_ns", bounds.most_delay_ns},
      {"most_send_lag_ns", bounds.most_send_lag_ns}, {"most_lateness_ns", bounds.most_lateness_ns},
      {"clock_error_ns", bounds.clock_error_ns},     {"may_lose", bounds.may_lose}};
}

Json place_json(const Place& place) {
  return {{"source", place.source},
          {"destination", or_null(place.destination)},
          {"writer", writer_name(place.writer)}};
}

Json event_json(const Names& names, std::size_t index) {
  const capture::Event& event = names.event(index);
  const auto destination = event.destination ? names.number(*event.destination) : std::nullopt;
  return {{"event", index},
          {"time_ns", event.time_ns},
          {"datagram", event.datagram},
          {"capture", valid_text(names.capture_name(event))},
          {"packet", names.datagram(event).packet},
          {"source", or_null(names.number(event.source))},
          {"destination", or_null(destination)},
          {"multicast", event.is_multicast},
          {"text", event_text(event)}};
}

Json unexplained_json(const Names& names, const Unexplained& one) {
  Json json = event_json(names, one.event);
  json["place"] = place_json(one.place);
  json["fault"] = name_of(one.fault);
  json["rule_broken"] = rule_broken_by(one.fault);
  json["what"] = valid_text(one.what);
  json["nearest"] = valid_text(one.nearest);
  json["needs"] = Json::array();
  for (const Need& need : one.needs) {
    json["needs"].push_back({{"what", valid_text(need.what)},
                             {"needed_ns", or_null(need.needed_ns)},
                             {"bound_ns", or_null(need.bound_ns)}});
  }
  json["context"] = Json::array();
  for (const std::size_t event : one.context) json["context"].push_back(event_json(names, event));
  return json;
}

Json faults_json(const Conformance& result) {
  Json json = Json::object();
  for (const FaultGroup& group : by_fault(result)) {
    json[std::string{name_of(group.fault)}] = group.places;
  }
  return json;
}

Json rules_json(const Conformance& result) {
  Json json;
  for (std::size_t k = 0; k < rule_count; ++k) {
    json[std::string{name_of(static_cast<Rule>(k))}] = result.by_rule[k];
  }
  return json;
}

Json machines_json(const Report& report) {
  Json machines = Json::array();
  for (const MachineCoverage& machine : coverage_of(report.result.rows, report.dds)) {
    Json rows = Json::array();
    for (const RowCoverage& row : machine.rows) {
      rows.push_back(
          {{"row", row.use->row},
           {"text", row.use->text},
           {"times", row.use->times},
           {"ruled_out_by", row.ruled_out_by.empty() ? Json{} : Json(row.ruled_out_by)}});
    }
    machines.push_back({{"machine", machine.machine},
                        {"fired", machine.used},
                        {"possible", machine.rows.size() - machine.ruled_out},
                        {"rows", std::move(rows)}});
  }
  return machines;
}

Json participants_json(const capture::Topology& topology) {
  Json json = Json::array();
  for (const capture::Participant& one : topology.participants) {
    json.push_back({{"guid_prefix", to_string(one.prefix)},
                    {"host", one.host},
                    {"vendor", capture::vendor_name(one.vendor)},
                    {"name", valid_text(one.name)}});
  }
  return json;
}

Json places_json(const Conformance& result) {
  Json json = Json::array();
  for (const PlaceResult& one : result.places) {
    Json place = place_json(one.place);
    place["explained"] = one.explained;
    place["lost"] = one.lost;
    place["unexplained"] = one.unexplained;
    json.push_back(std::move(place));
  }
  return json;
}

Json captures_json(const capture::Conversation& conversation) {
  Json json = Json::array();
  for (const capture::CaptureInfo& one : conversation.captures) {
    json.push_back({{"name", valid_text(one.name)},
                    {"packets", one.packets},
                    {"datagrams", one.datagrams},
                    {"merged", one.merged}});
  }
  return json;
}

const char* token(Hidden::Kind kind) {
  switch (kind) {
    case Hidden::Kind::received:
      return "received";
    case Hidden::Kind::lost:
      return "lost";
    case Hidden::Kind::dropped:
      return "dropped";
    case Hidden::Kind::still_under_way:
      return "still_under_way";
    case Hidden::Kind::recognised:
      return "recognised";
    case Hidden::Kind::timer:
      return "timer";
  }
  return "";
}

/// What makes a result comparable with another one: verdict, profile, captures, bounds.
Json head_json(const Report& report) {
  const Conformance& result = report.result;
  Json json = {{"verdict", verdict_token(result.verdict)},
               {"profile", valid_text(report.profile)},
               {"captures", captures_json(report.conversation)},
               {"first_ns", report.conversation.first_ns},
               {"until_ns", std::min(report.until_ns, report.conversation.last_ns)},
               {"bounds", bounds_json(result.bounds)}};
  if (result.verdict == Verdict::inconclusive) {
    json["why_inconclusive"] = valid_text(result.why_inconclusive);
  }
  return json;
}

}  // namespace

nlohmann::ordered_json to_json(const Report& report) {
  const Conformance& result = report.result;
  const Names names{report.conversation};
  Json json = head_json(report);
  json["bounds_used"] = {{"send_lag_ns", result.used_send_lag_ns},
                         {"lateness_ns", result.used_lateness_ns}};
  json["checked"] = result.checked;
  json["explained"] = result.explained;
  json["not_checked"] = result.not_checked;
  json["not_replayed"] = result.not_replayed;
  json["undecided"] = result.undecided;
  json["lost"] = result.lost;
  json["unexplained"] = Json::array();
  for (const Unexplained& one : result.unexplained) {
    json["unexplained"].push_back(unexplained_json(names, one));
  }
  json["faults"] = faults_json(result);
  json["rules"] = rules_json(result);
  json["machines"] = machines_json(report);
  json["participants"] = participants_json(report.conversation.topology);
  json["places"] = places_json(result);
  json["assumptions"] = Json::array();
  for (const std::string& one : result.assumptions) {
    json["assumptions"].push_back(valid_text(one));
  }
  report::add_unmodelled(json, report.dds);
  return json;
}

std::string assignment_lines(const Report& report) {
  const Names names{report.conversation};
  const auto line = [](const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  };
  Json head = {{"format", "stormproof-assignment"}, {"version", 1}};
  head.update(head_json(report));
  std::string text = line(head);
  for (const Hidden& hidden : report.result.hidden) {
    Json json = {{"kind", token(hidden.kind)}, {"time_ns", hidden.time_ns}};
    json.update(place_json(hidden.place));
    if (!hidden.machine.empty()) json["machine"] = hidden.machine;
    if (hidden.event) {
      const capture::Event& event = names.event(*hidden.event);
      json["event"] = *hidden.event;
      json["sent_ns"] = event.time_ns;
      json["capture"] = valid_text(names.capture_name(event));
      json["packet"] = names.datagram(event).packet;
      json["text"] = event_text(event);
    }
    text += line(json);
  }
  return text;
}

}  // namespace stormproof::conform
