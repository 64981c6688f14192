// The seed corpus through every reader, without libFuzzer: what the name of a file announces
// (accepted-… or refused-…) is what its own reader says, and no other reader falls over it. Inputs
// that once broke a reader stay in the corpus, so this is also their regression test.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>

#include <gtest/gtest.h>

#include "tests/fuzzing/targets.hpp"

namespace stormproof::fuzzing {

/// For the names of the tests.
void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

namespace corpus_test {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream in{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

std::vector<fs::path> files_of(const Target& target) {
  std::vector<fs::path> files;
  const fs::path folder = fs::path{STORMPROOF_SOURCE_DIR "/tests/fuzzing/corpus"} / target.name;
  for (const auto& entry : fs::directory_iterator{folder}) files.push_back(entry.path());
  return files;
}

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, ItsOwnReaderSaysWhatTheNameAnnounces) {
  const std::vector<fs::path> files = files_of(GetParam());
  EXPECT_GE(files.size(), 3U);
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    const bool accepted = name.starts_with("accepted-");
    EXPECT_TRUE(accepted || name.starts_with("refused-")) << name;
    const Outcome outcome = GetParam().run(content(file));
    EXPECT_EQ(outcome, accepted ? Outcome::accepted : Outcome::refused) << name;
  }
}

TEST_P(Corpus, OtherReadersSurviveIt) {
  for (const Target& other : targets) {
    for (const fs::path& file : files_of(other)) {
      SCOPED_TRACE(file.string());
      const Outcome outcome = GetParam().run(content(file));
      EXPECT_TRUE(outcome == Outcome::accepted || outcome == Outcome::refused);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzzing, Corpus, testing::ValuesIn(targets),
                         [](const auto& target) { return std::string{target.param.name}; });

}  // namespace corpus_test
}  // namespace stormproof::fuzzing
