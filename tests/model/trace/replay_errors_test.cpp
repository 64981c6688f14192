// Files that are not traces, or are damaged, are errors with their place and what was expected.
#include <gtest/gtest.h>

#include "model/trace/line_reader.hpp"
#include "model/trace/replay.hpp"
#include "tests/model/config/test_files.hpp"
#include "tests/model/trace/recording.hpp"

namespace stormproof::model::trace {
namespace replay_errors_test {

using config::TestFiles;

/// The error of a replay, as it is printed, with the file's folder cut off.
std::string error_of(const TestFiles& files, const std::string& file) {
  const auto result = replay(file, config::source_specs());
  if (result) return std::string{"no error: "} + name_of(result->verdict);
  std::string text = to_string(result.error());
  if (text.rfind(files.root() + "/", 0) == 0) text.erase(0, files.root().size() + 1);
  return text;
}

std::string error_for(const std::string& text) {
  const TestFiles files{};
  return error_of(files, files.write("t.jsonl", text));
}

testing::AssertionResult starts_with(const std::string& text, const std::string& start) {
  if (text.rfind(start, 0) == 0) return testing::AssertionSuccess();
  return testing::AssertionFailure() << text;
}

std::vector<std::string> good_lines() { return record(case_named("hosts2x1x2")).lines; }

TEST(ReplayErrors, FileThatIsNotThere) {
  const TestFiles files{};
  EXPECT_EQ(error_of(files, files.path("none")), "none: cannot be read");
}

TEST(ReplayErrors, Folder) {
  const TestFiles files{};
  EXPECT_TRUE(starts_with(error_of(files, files.root()),
                          files.root() + ": is a directory; expected a file"));
}

TEST(ReplayErrors, EmptyFile) {
  EXPECT_TRUE(starts_with(error_for(""), "t.jsonl: the file is empty; expected a trace"));
}

TEST(ReplayErrors, NotATrace) {
  const std::string binary{
      "\x7f"
      "ELF\0\x01\xff\n",
      8};
  for (const std::string& text :
       {std::string{"hello\n"}, std::string{"{}\n"}, std::string{"[1,2]\n"}, std::string{"\n"},
        binary, std::string{R"({"format":"something"})"}, std::string{R"({"format":17})"}}) {
    EXPECT_TRUE(starts_with(error_for(text), "t.jsonl:1: not a trace; expected a trace, which"));
  }
}

TEST(ReplayErrors, UnknownVersion) {
  EXPECT_EQ(error_for(R"({"format":"stormproof-trace","version":2,"scenario":{}})"),
            "t.jsonl:1: version 2 of the trace format; expected version 1");
  EXPECT_EQ(error_for(R"({"format":"stormproof-trace"})"),
            "t.jsonl:1: version null of the trace format; expected version 1");
}

TEST(ReplayErrors, HeaderWithoutAScenario) {
  EXPECT_TRUE(starts_with(error_for(R"({"format":"stormproof-trace","version":1})"),
                          "t.jsonl:1: the header has no scenario; expected"));
}

TEST(ReplayErrors, HeaderWithABadScenarioGivesTheColumn) {
  std::vector<std::string> lines = good_lines();
  const std::size_t found = lines[0].find(R"("200s")");
  lines[0].replace(found, 6, R"("200x")");
  EXPECT_TRUE(
      starts_with(error_for(joined(lines)), "t.jsonl:1:" + std::to_string(found + 1) + ": "));
}

TEST(ReplayErrors, HeaderThatIsCutOff) {
  EXPECT_TRUE(starts_with(error_for(good_lines()[0].substr(0, 500)), "t.jsonl:1: not a trace"));
}

TEST(ReplayErrors, LineThatIsNotJson) {
  for (const char* bad : {"hello", "", "17", "[]", "{\"n\":1", "{\"n\":1}{\"n\":1}"}) {
    std::vector<std::string> lines = good_lines();
    lines[12] = bad;
    EXPECT_EQ(error_for(joined(lines)),
              "t.jsonl:13: not a JSON object; expected the line of one event");
  }
}

TEST(ReplayErrors, LineThatIsNestedTooDeeply) {
  std::vector<std::string> lines = good_lines();
  lines[12] = R"({"n":)" + std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}";
  EXPECT_TRUE(starts_with(error_for(joined(lines)), "t.jsonl:13: not a JSON object"));
}

TEST(ReplayErrors, LineThatIsCutOff) {
  std::vector<std::string> lines = good_lines();
  lines.resize(30);
  std::string text = joined(lines);
  text.resize(text.size() - 20);
  EXPECT_TRUE(starts_with(error_for(text), "t.jsonl:30: the line is cut off; expected"));
}

TEST(ReplayErrors, EndlessLine) {
  std::vector<std::string> lines = good_lines();
  lines[12] = std::string(LineReader::max_line_bytes + 1, ' ');
  EXPECT_TRUE(starts_with(error_for(joined(lines)), "t.jsonl:13: the line is longer than"));
  EXPECT_TRUE(starts_with(error_for(lines[12]), "t.jsonl:1: the line is too long; expected"));
}

TEST(ReplayErrors, LinesAfterTheEnd) {
  std::vector<std::string> lines = good_lines();
  lines.push_back(lines.back());
  EXPECT_EQ(error_for(joined(lines)), "t.jsonl:" + std::to_string(lines.size()) +
                                          ": a line after the last line of the trace; expected "
                                          "the end of the file");
}

}  // namespace replay_errors_test
}  // namespace stormproof::model::trace
