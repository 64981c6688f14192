// The suites that diff and conform still make, as findings of a document.
#include "checker/presentation/document/junit.hpp"
#include "checker/presentation/document/render.hpp"

namespace stormproof::report {

std::string to_xml(const JUnitSuite& suite) {
  Document document;
  document.title = suite.name;
  document.seconds = suite.seconds;
  for (const JUnitCase& one : suite.cases) {
    Finding& finding = document.findings.emplace_back();
    finding.group = one.class_name;
    finding.name = one.name;
    finding.seconds = one.seconds;
    finding.outcome = one.outcome == JUnitCase::Outcome::passed   ? Finding::Outcome::passed
                      : one.outcome == JUnitCase::Outcome::failed ? Finding::Outcome::failed
                                                                  : Finding::Outcome::unknown;
    if (finding.outcome != Finding::Outcome::passed) finding.word = one.type;
    finding.message = one.message;
    finding.details = one.text;
  }
  if (!suite.notes.empty()) document.assumptions.emplace_back(suite.notes);
  return to_junit(document);
}

}  // namespace stormproof::report
