// The guide refers to rules and effects of the compositions by their ids, `§AckNackArrives` and
// `§AckNackArrives.4`. An id that does not exist, and a rule that its implementation's page does
// not mention, are mistakes; invented pages show that they are noticed.
#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "fsm/composition/compositions.hpp"
#include "tests/files.hpp"

namespace stormproof::fsm::composition {
namespace guide_test {

using Complaints = std::vector<std::string>;

struct Reference {
  std::string id;
  std::size_t line = 0;
};

/// Each "§" of a page, with the id after it; of one that is not written as `§Id` without an id.
std::vector<Reference> references(const std::string& page) {
  static const std::string sign = "§";
  static const std::regex id{"[A-Z]\\w*(\\s+[A-Z]\\w*)?(\\.\\d+)?"};
  std::vector<Reference> found;
  for (std::size_t at = page.find(sign); at != std::string::npos; at = page.find(sign, at + 1)) {
    const auto line =
        1 + std::count(page.begin(), page.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    const std::size_t begin = at + sign.size();
    const std::size_t end = page.find('`', begin);
    std::string text = end == std::string::npos ? "" : page.substr(begin, end - begin);
    if (at == 0 || page[at - 1] != '`' || !std::regex_match(text, id)) text.clear();
    found.push_back(
        {std::regex_replace(text, std::regex{"\\s+"}, " "), static_cast<std::size_t>(line)});
  }
  return found;
}

/// Rules, procedures and steps.
std::vector<RuleInfo> rules_of(const CompositionInfo& composition) {
  std::vector<RuleInfo> rules = composition.rules;
  for (const auto* more : {&composition.procedures, &composition.steps}) {
    rules.insert(rules.end(), more->begin(), more->end());
  }
  return rules;
}

std::set<std::string> ids_of(const CompositionInfo& composition) {
  std::set<std::string> ids;
  for (const RuleInfo& rule : rules_of(composition)) {
    ids.insert(rule.id);
    for (const EffectInfo& effect : rule.effects) ids.insert(effect.id);
  }
  return ids;
}

/// References of a page to what does not exist.
Complaints wrong_references(const std::string& page, const std::set<std::string>& ids) {
  Complaints complaints;
  for (const Reference& reference : references(page)) {
    const std::string line = "line " + std::to_string(reference.line) + ": ";
    if (reference.id.empty())
      complaints.push_back(line + "§ is followed by an id, both in backticks");
    else if (!ids.contains(reference.id))
      complaints.push_back(line + reference.id + " is no rule or effect");
  }
  return complaints;
}

/// Rules that a page does not mention, by themselves or by one of their effects.
Complaints not_mentioned(const std::string& page, const CompositionInfo& composition) {
  std::set<std::string> mentioned;
  for (const Reference& reference : references(page)) {
    mentioned.insert(reference.id.substr(0, reference.id.find('.')));
  }
  Complaints complaints;
  for (const RuleInfo& rule : rules_of(composition)) {
    if (!mentioned.contains(rule.id)) complaints.push_back(rule.id + " is not mentioned");
  }
  return complaints;
}

std::string lines(const Complaints& complaints) {
  std::string text;
  for (const std::string& complaint : complaints) text += complaint + "\n";
  return text;
}

/// The pages that state the rules of a composition; with a life Fast DDS and Cyclone DDS have those
/// of their own pages, too. Others may speak of any of them.
const std::multimap<std::string, std::string_view> page_of{
    {"model.md", "paper"},
    {"fastdds.md", "fastdds"},
    {"cyclone.md", "cyclone"},
    {"museum.md", "paper-amended"},
    {"museum.md", "fastdds-living"},
    {"discovery-server.md", "fastdds-server"},
    {"discovery-server.md", "fastdds-server-living"},
    {"cyclone-life.md", "cyclone-living"}};

TEST(Guide, RefersToRulesAndEffectsThatExist) {
  std::size_t pages = 0;
  for (const auto& entry : std::filesystem::directory_iterator{STORMPROOF_SPECS_DIR "/guide"}) {
    const std::string name = entry.path().filename().string();
    std::set<std::string> ids;
    for (const CompositionInfo& composition : compositions()) {
      const auto [begin, end] = page_of.equal_range(name);
      const auto is_its = [&](const auto& page) { return page.second == composition.name; };
      if (begin != end && std::none_of(begin, end, is_its)) continue;
      ids.merge(ids_of(composition));
    }
    EXPECT_EQ(lines(wrong_references(files::content(entry.path()), ids)), "") << name;
    ++pages;
  }
  EXPECT_GT(pages, 15U);
}

TEST(Guide, StatesEveryRule) {
  for (const CompositionInfo& composition : compositions()) {
    for (const auto& [page, name] : page_of) {
      if (name != composition.name) continue;
      std::string text = files::content(std::string{STORMPROOF_SPECS_DIR "/guide/"} + page);
      if (name.ends_with("-living")) {
        const std::string without{name.substr(0, name.find('-'))};
        text += files::content(STORMPROOF_SPECS_DIR "/guide/" + without + ".md");
      }
      EXPECT_EQ(lines(not_mentioned(text, composition)), "") << page;
    }
  }
}

TEST(GuideMistakes, AnIdThatDoesNotExistIsNoticed) {
  const std::set<std::string> ids{"A", "A.1", "B C", "B C.1"};
  EXPECT_EQ(wrong_references("A rule (`§A`), its effect `§A.1`, and `§B\n  C.1`.", ids),
            Complaints{});
  EXPECT_EQ(wrong_references("One (`§Aa`)\nand `§A.2`\n and `§B`, `§B C.2`", ids),
            (Complaints{"line 1: Aa is no rule or effect", "line 2: A.2 is no rule or effect",
                        "line 3: B is no rule or effect", "line 3: B C.2 is no rule or effect"}));
  EXPECT_NE(wrong_references("`§QueueIsSent`", ids_of(compositions()[0])), Complaints{});
}

TEST(GuideMistakes, AnotherNotationIsNoticed) {
  const std::set<std::string> ids{"A"};
  for (const char* page : {"§A", "(§A)", "`x §A`", "`§A", "`§ A`", "`§A and more`", "`§A.`"}) {
    EXPECT_EQ(wrong_references(page, ids).size(), 1U) << page;
  }
}

TEST(GuideMistakes, ARuleThatNobodyMentionsIsNoticed) {
  CompositionInfo composition;
  composition.rules = {{"A", "", "", "", {}}, {"B", "", "", "", {}}};
  composition.procedures = {{"C", "", "", "", {}}};
  composition.steps = {{"D One", "", "", "", {}}};
  EXPECT_EQ(not_mentioned("`§A` `§B.2` `§C.1` `§D One`", composition), Complaints{});
  EXPECT_EQ(not_mentioned("`§A.1` A B `C` `§D Two`", composition),
            (Complaints{"B is not mentioned", "C is not mentioned", "D One is not mentioned"}));
}

}  // namespace guide_test
}  // namespace stormproof::fsm::composition
