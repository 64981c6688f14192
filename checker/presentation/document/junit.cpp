// Writes the document with tinyxml2, which escapes; what XML cannot hold is taken out before.
#include "checker/presentation/document/junit.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::report {

namespace {

using Outcome = JUnitCase::Outcome;

void set(tinyxml2::XMLElement& element, const char* name, const std::string& value) {
  element.SetAttribute(name, one_line(value).c_str());
}

void add(tinyxml2::XMLElement& suite, const JUnitCase& one) {
  tinyxml2::XMLElement* test = suite.InsertNewChildElement("testcase");
  set(*test, "classname", one.class_name);
  set(*test, "name", one.name);
  set(*test, "time", fmt::format("{:.3f}", one.seconds));
  const std::string text = valid_text(one.text);
  if (one.outcome == Outcome::passed) {
    test->InsertNewChildElement("system-out")->SetText(text.c_str());
    return;
  }
  tinyxml2::XMLElement* problem =
      test->InsertNewChildElement(one.outcome == Outcome::failed ? "failure" : "error");
  set(*problem, "type", one.type);
  set(*problem, "message", one.message);
  problem->SetText(text.c_str());
}

}  // namespace

std::string to_xml(const JUnitSuite& suite) {
  const auto count = [&](Outcome outcome) {
    return static_cast<unsigned>(std::ranges::count(suite.cases, outcome, &JUnitCase::outcome));
  };
  tinyxml2::XMLDocument document;
  document.InsertEndChild(document.NewDeclaration());
  tinyxml2::XMLElement* suites = document.NewElement("testsuites");
  document.InsertEndChild(suites);
  tinyxml2::XMLElement* element = suites->InsertNewChildElement("testsuite");
  set(*element, "name", suite.name);
  element->SetAttribute("tests", static_cast<unsigned>(suite.cases.size()));
  element->SetAttribute("failures", count(Outcome::failed));
  element->SetAttribute("errors", count(Outcome::error));
  set(*element, "time", fmt::format("{:.3f}", suite.seconds));
  for (const JUnitCase& one : suite.cases) add(*element, one);
  if (!suite.notes.empty()) {
    element->InsertNewChildElement("system-out")->SetText(valid_text(suite.notes).c_str());
  }
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace stormproof::report
