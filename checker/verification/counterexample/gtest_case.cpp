// Prints C++ that parses the scenario and runs it under the property's monitor.
#include "checker/verification/counterexample/gtest_case.hpp"

#include <cctype>

#include <fmt/format.h>

#include "checker/presentation/text/paragraph.hpp"
#include "checker/verification/counterexample/story.hpp"
#include "model/config/knobs/effective.hpp"
#include "props/property.hpp"

namespace stormproof::counterexample {

namespace {

/// "safety.ack-implies-received" → "SafetyAckImpliesReceived".
std::string camel_case(std::string_view id) {
  std::string name;
  bool upper = true;
  for (const char c : id) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      upper = true;
      continue;
    }
    name += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = false;
  }
  return name;
}

/// A raw string literal; its delimiter does not occur in the text.
std::string raw_string(const std::string& text) {
  std::string delimiter = "yaml";
  while (text.find(")" + delimiter + "\"") != std::string::npos) delimiter += "_";
  return fmt::format("R\"{0}(\n{1}){0}\"", delimiter, text);
}

/// `text` as the contents of an ordinary string literal.
std::string c_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else
      result += c;
  }
  return result + "\"";
}

/// A line comment. A backslash at its end would swallow the next line.
std::string comment(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\\') c = ' ';
  }
  return report::paragraph("// ", text, 97);
}

std::string commented(const std::string& paragraph) {
  std::string result;
  std::size_t begin = 0;
  while (begin < paragraph.size()) {
    const std::size_t end = paragraph.find('\n', begin);
    std::string line = paragraph.substr(begin, end - begin);
    if (!line.starts_with("//")) line = "//" + line.substr(std::min<std::size_t>(2, line.size()));
    result += line + "\n";
    begin = end + 1;
  }
  return result;
}

}  // namespace

std::string gtest_case(const props::Counterexample& counterexample, std::string_view found_by) {
  const props::Property* property = props::find_property(counterexample.property);
  std::string text;
  const auto say = [&](std::string line) { text += commented(comment(std::move(line))); };
  if (property != nullptr)
    say(fmt::format("{}: {}", counterexample.property, property->statement));
  else
    say(counterexample.property);
  say(fmt::format("Violated at event {}, {} ns after the start: {}", counterexample.event,
                  counterexample.time.count(), counterexample.reason));
  say(fmt::format("Found by {}.", found_by.empty() ? "stormproof check" : found_by));
  say(fmt::format("Run: {}; {}.", deployment_text(counterexample.scenario),
                  timers_text(counterexample.scenario)));
  say("The test fails until the defect is fixed.");
  text += fmt::format(
      R"(TEST(Counterexample, {name}AtEvent{event}) {{
  const auto scenario = stormproof::model::config::parse_scenario(
      {scenario},
      "{property}", {{}}, stormproof::model::config::SpecPath{{}});
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  const auto monitor = stormproof::props::make_monitor({id}, *scenario);
  ASSERT_NE(monitor, nullptr);
  const auto violation = stormproof::counterexample::observe(*scenario, *monitor);
  EXPECT_FALSE(violation) << "event " << violation->event << ": " << violation->reason;
}}
)",
      fmt::arg("name", camel_case(counterexample.property)),
      fmt::arg("event", counterexample.event),
      fmt::arg("scenario", raw_string(model::config::effective_yaml(counterexample.scenario))),
      fmt::arg("property", counterexample.property),
      fmt::arg("id", c_string(counterexample.property)));
  return text;
}

std::string gtest_file(std::span<const props::Counterexample> counterexamples,
                       std::string_view found_by) {
  std::string text =
      "// Counterexamples of stormproof as tests. Link with stormproof_counterexample and "
      "GTest::gtest_main.\n"
      "#include <gtest/gtest.h>\n\n"
      "#include \"checker/verification/counterexample/observe.hpp\"\n"
      "#include \"model/config/scenario_file.hpp\"\n"
      "#include \"props/monitor.hpp\"\n";
  for (const props::Counterexample& counterexample : counterexamples) {
    text += "\n" + gtest_case(counterexample, found_by);
  }
  return text;
}

}  // namespace stormproof::counterexample
