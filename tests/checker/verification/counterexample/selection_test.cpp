// What repeats itself is told once at its beginning and once at its end.
#include "checker/verification/counterexample/selection.hpp"

#include <gtest/gtest.h>

namespace stormproof::counterexample {
namespace selection_test {

/// Each letter is an event of this shape, with a gap before each; step 10 K is the event K.
std::string told(const std::string& shapes) {
  std::vector<Selected> selected;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (k > 0) selected.push_back({true, 10 * k - 9, 10 * k - 1});
    selected.push_back({false, 10 * k, 10 * k});
  }
  const auto kept = without_repetition(
      selected, [&](std::size_t step) { return std::string{shapes[step / 10]}; });
  std::string text;
  std::size_t next = 0;
  for (const Selected& one : kept) {
    EXPECT_EQ(one.step, next) << "nothing is forgotten";
    next = one.last + 1;
    if (!one.gap)
      text += shapes[one.step / 10];
    else if (one.last - one.step >= 10)
      text += "…";
  }
  EXPECT_EQ(next, 10 * shapes.size() - 9);
  return text;
}

TEST(WithoutRepetition, KeepsTheFirstAndTheLast) {
  EXPECT_EQ(told("abbbbbbc"), "ab…bc");
  EXPECT_EQ(told("aaaa"), "a…a");
  EXPECT_EQ(told("xabababab"), "xab…ab");
  EXPECT_EQ(told("abcabcabcx"), "abc…abcx");
  EXPECT_EQ(told("aaaabbbb"), "a…ab…b");
}

TEST(WithoutRepetition, KeepsWhatIsShort) {
  for (const char* shapes : {"abcdefg", "aaab", "ababc", "abcabc", "a"}) {
    EXPECT_EQ(told(shapes), shapes);
  }
}

}  // namespace selection_test
}  // namespace stormproof::counterexample
