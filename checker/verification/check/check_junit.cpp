// A check as JUnit XML, the form that CI systems show as test results.
#include <fmt/core.h>

#include "checker/presentation/document/junit.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/verification/check/check_report.hpp"

namespace stormproof::checker {

namespace {

using props::VerdictKind;
using Outcome = report::JUnitCase::Outcome;

std::string lines_of(const PropertyResult& result, const CheckContext& context) {
  std::string text;
  for (const props::Finding& finding : result.findings) {
    text += fmt::format("{}: {}: {}\n", finding.engine, name_of(finding.kind), finding.how);
    for (const std::string& line : finding.assumptions) text += "  assuming " + line + "\n";
  }
  const auto file = context.counterexamples.find(result.property->id);
  if (file != context.counterexamples.end()) text += "counterexample: " + file->second + "\n";
  return text;
}

report::JUnitCase case_of(const PropertyResult& result, const CheckContext& context) {
  report::JUnitCase one;
  one.class_name = "stormproof." + context.name;
  one.name = result.property->id;
  for (const props::Finding& finding : result.findings) one.seconds += finding.seconds;
  one.type = name_of(result.verdict);
  one.text = lines_of(result, context);
  if (result.verdict == VerdictKind::violated) {
    one.outcome = Outcome::failed;
  } else if (result.verdict == VerdictKind::inconclusive) {
    one.outcome = Outcome::error;
  } else {
    one.text = one.type + "\n" + one.text;
  }
  const props::Counterexample* counterexample = result.counterexample();
  one.message = counterexample == nullptr ? result.decisive().how : counterexample->reason;
  return one;
}

}  // namespace

std::string to_junit(const CheckReport& report, const CheckContext& context) {
  report::JUnitSuite suite;
  suite.name = "stormproof check " + context.name;
  suite.seconds = report.seconds;
  for (const PropertyResult& result : report.results) {
    suite.cases.push_back(case_of(result, context));
  }
  suite.notes = report::unmodelled_text(context.scenario.dds);
  return to_xml(suite);
}

}  // namespace stormproof::checker
