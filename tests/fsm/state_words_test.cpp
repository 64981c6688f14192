// States with a letter for a name have words, and the guide has the same ones.
#include "fsm/state_words.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "fsm/machines.hpp"

namespace stormproof::fsm {
namespace state_words_test {

TEST(StateWords, EveryLetterHasThemAndNoWordDoes) {
  std::size_t letters = 0;
  for (const MachineInfo& machine : machines()) {
    for (const std::string_view state : machine.states) {
      EXPECT_EQ(words_of_state(state).empty(), state.size() > 1) << machine.name << " " << state;
      if (state.size() == 1) ++letters;
    }
  }
  EXPECT_EQ(letters, 15U) << "five of the paper, twice, five of Fast DDS";
}

TEST(StateWords, TheGuideSaysTheSame) {
  std::ifstream file{STORMPROOF_SPECS_DIR "/guide/model.md"};
  std::stringstream text;
  text << file.rdbuf();
  const std::string page = std::regex_replace(text.str(), std::regex{"\\s+"}, " ");
  ASSERT_FALSE(page.empty());
  for (const auto& [state, words] : state_words()) {
    const std::string said = "**" + std::string{state} + "** " + std::string{words};
    EXPECT_NE(page.find(said), std::string::npos) << said;
  }
}

}  // namespace state_words_test
}  // namespace stormproof::fsm
