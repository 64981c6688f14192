// The report in the forms that CI systems take: JUnit XML with a case for each relation, SARIF with
// a result for each unexplained event (the file is the capture; captures have no lines).
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/evidence/conform/report/chart.hpp"
#include "checker/evidence/conform/report/findings.hpp"
#include "checker/evidence/conform/report/names.hpp"
#include "checker/evidence/conform/report/report.hpp"
#include "checker/presentation/document/junit.hpp"
#include "checker/presentation/document/sarif.hpp"

namespace stormproof::conform {

namespace {

using Outcome = report::JUnitCase::Outcome;

/// One sentence with when and which packet.
std::string message_of(const Names& names, const Unexplained& one) {
  const capture::Event& event = names.event(one.event);
  return fmt::format("{}: {} ({} after the first packet, {})", names.place(one.place), one.what,
                     names.elapsed(event.time_ns), names.packet(event));
}

void fail(report::JUnitCase& one, const Report& report, const Names& names,
          const Unexplained& unexplained) {
  one.outcome = Outcome::failed;
  one.type = name_of(unexplained.fault);
  one.message = message_of(names, unexplained);
  one.text = fmt::format("breaks: {}\nnearest assignment: {}\n", rule_broken_by(unexplained.fault),
                         unexplained.nearest);
  for (const Need& need : unexplained.needs) one.text += "needs " + need_text(need) + "\n";
  one.text += text_chart(chart_of(report, unexplained));
}

std::string identity_of(const Report& report) {
  std::string text = report.profile;
  for (const auto& capture : report.conversation.captures) text += " " + capture.name;
  return text;
}

}  // namespace

std::string to_junit(const Report& report) {
  const Names names{report.conversation};
  const Conformance& result = report.result;
  report::JUnitSuite suite;
  suite.name = fmt::format("stormproof conform {} to {}", captures_text(report), report.profile);
  std::set<Place> failed;
  for (const Unexplained& unexplained : result.unexplained) {
    report::JUnitCase one;
    one.class_name = "stormproof.conform." + report.profile;
    one.name = names.place(unexplained.place);
    fail(one, report, names, unexplained);
    suite.cases.push_back(std::move(one));
    failed.insert(unexplained.place);
  }
  for (const PlaceResult& place : result.places) {
    if (failed.contains(place.place)) continue;
    report::JUnitCase one;
    one.class_name = "stormproof.conform." + report.profile;
    one.name = names.place(place.place);
    one.text = fmt::format("{} events explained, {} datagrams taken as lost\n", place.explained,
                           place.lost);
    suite.cases.push_back(std::move(one));
  }
  if (result.verdict == Verdict::inconclusive) {
    report::JUnitCase one;
    one.class_name = "stormproof.conform." + report.profile;
    one.name = "all places";
    one.outcome = Outcome::error;
    one.type = verdict_token(result.verdict);
    one.message = result.why_inconclusive;
    suite.cases.push_back(std::move(one));
  }
  suite.notes = verdict_line(report) + "\n" + verdict_meaning(report) + "\n";
  for (const std::string& assumption : result.assumptions) {
    suite.notes += "assuming " + assumption + "\n";
  }
  return to_xml(suite);
}

nlohmann::ordered_json to_sarif(const Report& report) {
  const Names names{report.conversation};
  const Conformance& result = report.result;
  report::SarifLog log;
  log.exit_code = report.exit_code;
  log.command = report.command;
  log.complete = result.verdict != Verdict::inconclusive;
  for (const FaultGroup& group : by_fault(result)) {
    log.rules.push_back({fmt::format("conform.{}", name_of(group.fault)),
                         std::string{rule_broken_by(group.fault)}, ""});
  }
  for (const Unexplained& one : result.unexplained) {
    report::SarifResult finding;
    finding.rule = fmt::format("conform.{}", name_of(one.fault));
    finding.message = message_of(names, one);
    if (!one.nearest.empty()) finding.message += " Nearest assignment: " + one.nearest;
    report::SarifLocation location;
    location.file = names.capture_name(names.event(one.event));
    location.message = names.packet(names.event(one.event));
    finding.locations.push_back(std::move(location));
    finding.identity = {identity_of(report), names.place(one.place)};
    log.results.push_back(std::move(finding));
  }
  if (result.verdict == Verdict::inconclusive) {
    log.rules.push_back({"conform.inconclusive", "nobody knows whether the capture conforms", ""});
    report::SarifResult finding;
    finding.rule = "conform.inconclusive";
    finding.level = report::SarifResult::Level::warning;
    finding.message = verdict_meaning(report);
    finding.identity = {identity_of(report)};
    log.results.push_back(std::move(finding));
  }
  return to_json(log);
}

}  // namespace stormproof::conform
