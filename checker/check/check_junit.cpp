// A check as JUnit XML, the form that CI systems show as test results.
#include <fmt/core.h>
#include <tinyxml2.h>

#include "checker/check/check_report.hpp"

namespace stormproof::checker {

namespace {

using props::VerdictKind;

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

void add_case(tinyxml2::XMLElement& suite, const PropertyResult& result,
              const CheckContext& context) {
  tinyxml2::XMLElement* test = suite.InsertNewChildElement("testcase");
  const std::string id{result.property->id};
  test->SetAttribute("classname", ("stormproof." + context.name).c_str());
  test->SetAttribute("name", id.c_str());
  double seconds = 0;
  for (const props::Finding& finding : result.findings) seconds += finding.seconds;
  test->SetAttribute("time", fmt::format("{:.3f}", seconds).c_str());
  const std::string text = lines_of(result, context);
  const bool violated = result.verdict == VerdictKind::violated;
  if (violated || result.verdict == VerdictKind::inconclusive) {
    tinyxml2::XMLElement* problem = test->InsertNewChildElement(violated ? "failure" : "error");
    const props::Counterexample* counterexample = result.counterexample();
    const std::string message =
        counterexample == nullptr ? result.decisive().how : counterexample->reason;
    problem->SetAttribute("type", name_of(result.verdict));
    problem->SetAttribute("message", message.c_str());
    problem->SetText(text.c_str());
  } else {
    test->InsertNewChildElement("system-out")
        ->SetText((std::string{name_of(result.verdict)} + "\n" + text).c_str());
  }
}

}  // namespace

std::string to_junit(const CheckReport& report, const CheckContext& context) {
  tinyxml2::XMLDocument document;
  document.InsertEndChild(document.NewDeclaration());
  tinyxml2::XMLElement* suites = document.NewElement("testsuites");
  document.InsertEndChild(suites);
  tinyxml2::XMLElement* suite = suites->InsertNewChildElement("testsuite");
  suite->SetAttribute("name", ("stormproof check " + context.name).c_str());
  suite->SetAttribute("tests", static_cast<unsigned>(report.results.size()));
  suite->SetAttribute("failures", static_cast<unsigned>(report.count(VerdictKind::violated)));
  suite->SetAttribute("errors", static_cast<unsigned>(report.count(VerdictKind::inconclusive)));
  suite->SetAttribute("time", fmt::format("{:.3f}", report.seconds).c_str());
  for (const PropertyResult& result : report.results) add_case(*suite, result, context);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace stormproof::checker
