// JUnit XML, as CI systems read it: what does not hold is a failure, what nobody knows or what is
// disputed an error.
#include <algorithm>

#include <fmt/core.h>

#include "checker/presentation/diagrams/svg.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::report {

namespace {

using Outcome = Finding::Outcome;

std::string xml_attribute(const char* name, std::string_view value) {
  return fmt::format(" {}=\"{}\"", name, draw::xml_text(one_line(value)));
}

std::string xml_seconds(double seconds) {
  return xml_attribute("time", fmt::format("{:.3f}", seconds));
}

bool is_test(const Finding& finding) {
  return finding.outcome != Outcome::note && finding.shown != Finding::Shown::code;
}

bool is_error(const Finding& finding) {
  return finding.outcome == Outcome::unknown || finding.outcome == Outcome::disputed;
}

std::string lines_of(const Finding& finding) {
  std::string text = finding.details;
  if (finding.outcome == Outcome::passed && !finding.word.empty()) {
    text = finding.word + "\n" + text;
  }
  if (finding.command.empty()) return text;
  if (!text.empty() && !text.ends_with('\n')) text += '\n';
  return text + finding.command + "\n";
}

std::string test_case(const Finding& finding, const std::string& title) {
  std::string group = title;
  std::ranges::replace(group, ' ', '.');
  const std::string head =
      fmt::format("        <testcase{}{}{}>\n",
                  xml_attribute("classname", finding.group.empty() ? group : finding.group),
                  xml_attribute("name", finding.name.empty() ? finding.id : finding.name),
                  xml_seconds(finding.seconds));
  const std::string text = draw::xml_text(valid_text(lines_of(finding)));
  const std::string foot = "        </testcase>\n";
  if (finding.outcome == Outcome::passed) {
    return head + fmt::format("            <system-out>{}</system-out>\n", text) + foot;
  }
  const char* element = is_error(finding) ? "error" : "failure";
  return head +
         fmt::format("            <{0}{1}{2}>{3}</{0}>\n", element,
                     xml_attribute("type", finding.word), xml_attribute("message", finding.message),
                     text) +
         foot;
}

/// What is true of all test cases: assumptions, and the findings that are none.
std::string notes_of(const Document& document) {
  std::string text;
  for (const Text& assumption : document.assumptions)
    text += "assuming " + assumption.plain() + "\n";
  for (const Finding& finding : document.findings) {
    if (finding.outcome != Outcome::note || finding.shown == Finding::Shown::code) continue;
    text += finding.statement + ": " + finding.message + "\n";
  }
  return text;
}

}  // namespace

std::string to_junit(const Document& document) {
  std::size_t tests = 0;
  std::size_t failures = 0;
  std::size_t errors = 0;
  std::string cases;
  for (const Finding& finding : document.findings) {
    if (!is_test(finding)) continue;
    ++tests;
    if (finding.outcome == Outcome::failed) ++failures;
    if (is_error(finding)) ++errors;
    cases += test_case(finding, document.title);
  }
  const std::string notes = notes_of(document);
  if (!notes.empty()) {
    cases +=
        fmt::format("        <system-out>{}</system-out>\n", draw::xml_text(valid_text(notes)));
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
      "    <testsuite{} tests=\"{}\" failures=\"{}\" errors=\"{}\"{}>\n{}    </testsuite>\n"
      "</testsuites>\n",
      xml_attribute("name", document.title), tests, failures, errors, xml_seconds(document.seconds),
      cases);
}

}  // namespace stormproof::report
