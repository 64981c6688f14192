// Drawings of compositions: everything is in them, links lead somewhere, texts can be read on the
// screen and on paper; and the graph behind them: who is on which side, what is told when.
#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "checker/presentation/composition/composition_drawing.hpp"
#include "checker/presentation/composition/composition_graph.hpp"
#include "checker/presentation/composition/composition_words.hpp"
#include "fsm/composition/compositions.hpp"
#include "tests/checker/presentation/diagrams/svg_texts.hpp"

namespace stormproof::draw {
namespace composition_pictures_test {

using fsm::composition::BlockInfo;
using fsm::composition::CompositionInfo;
using fsm::composition::EffectInfo;
using fsm::composition::RuleInfo;
using Names = std::vector<std::string>;

EffectInfo effect(std::string_view kind, std::string_view target, std::string detail = "",
                  std::vector<BlockInfo> blocks = {}) {
  return {"", kind, target, "", std::move(detail), std::move(blocks), "", 0};
}
RuleInfo rule(std::string id, std::string_view trigger, std::string_view cause,
              std::vector<EffectInfo> effects) {
  for (std::size_t k = 0; k < effects.size(); ++k) {
    effects[k].id = id + "." + std::to_string(k + 1);
  }
  return {std::move(id), trigger, cause, trigger.empty() ? "" : "relation", std::move(effects)};
}

/// Names and conditions that are longer than any that there are; a packet that RTPS has not; a
/// procedure that calls itself; conditions in conditions, more than a printed page of them.
CompositionInfo invented() {
  CompositionInfo info;
  info.name = "invented & <long>";
  info.parts = {{"AMachineWhoseNameIsLonger", "SingleShot", "participant", {}, {}}};
  info.timers = {{"ATimerWhoseNameIsQuiteLong", "writer"}};
  info.packets = {{"Hello", "relation"}};
  info.occasions = {{"SomethingHappensOutside", "writer"}};
  const std::string condition =
      "if this is so and that is so or neither is the case but there is more to be said about it";
  std::vector<EffectInfo> many;
  for (unsigned k = 0; k < 60; ++k) {
    std::vector<BlockInfo> blocks;
    for (unsigned depth = 0; depth <= k % 5; ++depth) blocks.push_back({condition, 5 * k + depth});
    many.push_back(effect(k % 2 == 0 ? "emit" : "at", k % 2 == 0 ? "Hello" : info.timers[0].name,
                          "A = " + condition, blocks));
  }
  info.rules = {
      rule("AnOccasionThatIsOutsideHappens", "happens", "SomethingHappensOutside",
           {effect("feed", info.parts[0].name, "Requested"), effect("call", "Again", "One")}),
      rule("HelloArrives", "received", "Hello", many),
      rule("HelloAlsoArrivesAtThisOneHere", "received", "Hello", {effect("cancel", "ATimer")}),
      rule("HelloLeaves", "left", "Hello", {}),
      rule("ATimerWhoseNameIsQuiteLongIsDue", "due", info.timers[0].name,
           {effect("perform", "Nothing")})};
  info.procedures = {rule("Again One", "", "", {effect("call", "Again", "One")})};
  info.steps = {rule("Nothing", "", "", {})};
  return info;
}

std::vector<CompositionInfo> all() {
  std::vector<CompositionInfo> all = fsm::composition::compositions();
  all.push_back(invented());
  return all;
}

Names ids(const std::vector<const RuleInfo*>& rules) {
  Names names;
  for (const RuleInfo* one : rules) names.push_back(one->id);
  return names;
}
Names ids(const CompositionInfo& composition) {
  Names names;
  for (const auto* rules : {&composition.rules, &composition.procedures, &composition.steps}) {
    for (const RuleInfo& one : *rules) names.push_back(one.id);
  }
  return names;
}
Names sorted(Names names) {
  std::ranges::sort(names);
  return names;
}
std::string joined(std::string text, char from, char to) {
  std::ranges::replace(text, from, to);
  return text;
}

TEST(CompositionGraph, TellsEveryRuleOnceAndWhatItCallsAfterItsCallers) {
  for (const CompositionInfo& composition : all()) {
    const Names order = ids(reading_order(composition));
    EXPECT_EQ(sorted(order), sorted(ids(composition)));
    const auto place = [&](const std::string& id) { return std::ranges::find(order, id); };
    for (const std::string& id : order) {
      for (const std::string& caller : callers_of(composition, id)) {
        EXPECT_LE(place(caller), place(id)) << caller << " calls " << id;
      }
    }
    for (std::size_t k = 1; k < composition.rules.size(); ++k) {
      EXPECT_LT(place(composition.rules[k - 1].id), place(composition.rules[k].id));
    }
  }
}

/// The names of the sides with their machines: "reader side: Reader InitialTimer".
Names sides(const CompositionInfo& composition) {
  Names names;
  for (const Party& party : parties(composition)) {
    names.push_back(party.name + ":");
    for (const auto& part : party.parts) names.back() += " " + std::string{part.name};
  }
  return names;
}

TEST(CompositionGraph, FindsTheSides) {
  const auto compositions = all();
  EXPECT_EQ(sides(compositions[0]),
            (Names{"participant: AnnouncementTimer", "reader side: Reader InitialTimer",
                   "writer side: C HeartbeatClock"}));
  EXPECT_EQ(sides(compositions[1]),
            (Names{"participant: AnnouncementTimer", "reader side: Reader InitialTimer Reply",
                   "writer side: C Suppression NackResponse AsyncRun HeartbeatClock",
                   "control traffic, writer side: ControlWriterSide LookupExpiry",
                   "control traffic, reader side: ControlReaderSide ControlInitialTimer "
                   "ControlReply"}));
}

TEST(CompositionGraph, ARuleThatFeedsBothSidesMakesThemOne) {
  CompositionInfo composition = all()[0];
  composition.rules.push_back(
      rule("Wrong", "received", "Data",
           {effect("feed", "Reader", "DataReceived"), effect("feed each", "C", "RepairDue")}));
  EXPECT_EQ(sides(composition).size(), 2U);
}

TEST(CompositionSvg, HasEveryRuleAndEffectAndNothingOverlaps) {
  for (const CompositionInfo& composition : all()) {
    const auto svg = read_svg(composition_svg(composition));
    ASSERT_TRUE(svg) << composition.name;
    EXPECT_EQ(svg->fault(), "") << composition.name;
    const std::set<std::string> groups{svg->groups.begin(), svg->groups.end()};
    EXPECT_EQ(groups.size(), svg->groups.size()) << "an id twice";
    std::string said;
    for (const PlacedText& text : svg->texts) {
      const std::size_t begin = text.text.find_first_not_of(' ');
      if (begin != std::string::npos) said += " " + text.text.substr(begin);
    }
    for (const RuleInfo* one : reading_order(composition)) {
      EXPECT_TRUE(groups.contains(joined(one->id, ' ', '-'))) << one->id;
      for (const ProgramLine& line : program(*one)) {
        EXPECT_NE(said.find(line.text), std::string::npos) << line.text;
        if (line.effect == nullptr) continue;
        EXPECT_TRUE(groups.contains(joined(line.effect->id, ' ', '-'))) << line.effect->id;
      }
    }
    for (const std::string& link : svg->links) {
      EXPECT_TRUE(groups.contains(link.substr(1))) << link << " leads nowhere";
    }
    for (const auto& part : composition.parts) {
      EXPECT_GE(svg->count(std::string{part.name}), 1U) << part.name;
    }
  }
}

/// Printed on A4 in its own size, see composition_pen.cpp.
TEST(CompositionSvg, NoTextIsCutByTheEndOfAPrintedPage) {
  constexpr int page = 748;
  for (const CompositionInfo& composition : all()) {
    const auto svg = read_svg(composition_svg(composition));
    EXPECT_LE(svg->width, 1122 - 45);
    for (const PlacedText& text : svg->texts) {
      EXPECT_EQ(text.top / page, text.bottom / page) << composition.name << ": " << text.text;
    }
  }
}

/// Names of an edge's line: source, label, target.
struct Line {
  std::string source, arrow, label, target;
};

/// What a Mermaid flowchart says, if it says it in the form that the grammar has.
struct Flow {
  std::map<std::string, std::string> nodes;  ///< and their labels
  std::vector<Line> edges;
  std::string fault;
};
Flow read_flow(const std::string& source) {
  static const std::regex node{R"re( +(\w+)(\[|\(\[|\[\[)"([^"]*)"(\]|\]\)|\]\]))re"};
  static const std::regex edge{R"re(  (\w+) (==>|-\.->|-->)\|"([^"]+)"\| (\w+))re"};
  static const std::regex open{R"re(  subgraph \w+\["[^"]+"\])re"};
  Flow flow;
  std::istringstream lines{source};
  std::string line;
  std::getline(lines, line);
  if (line != "flowchart TB") flow.fault = line;
  int depth = 0;
  while (std::getline(lines, line)) {
    std::smatch found;
    if (std::regex_match(line, found, node)) {
      flow.nodes[found[1]] = found[3];
    } else if (std::regex_match(line, found, edge)) {
      flow.edges.push_back({found[1], found[2], found[3], found[4]});
    } else if (std::regex_match(line, open)) {
      ++depth;
    } else if (line == "  end") {
      --depth;
    } else if (!line.starts_with("  %% ")) {
      flow.fault = line;
    }
    if (depth < 0 || depth > 1) flow.fault = "subgraphs are not closed: " + line;
  }
  if (depth != 0) flow.fault = "a subgraph stays open";
  return flow;
}

TEST(CompositionMermaid, HasEveryRuleAndAnEdgeForAllThatLeadsSomewhere) {
  for (const CompositionInfo& composition : all()) {
    const Flow flow = read_flow(composition_mermaid(composition));
    EXPECT_EQ(flow.fault, "");
    for (const RuleInfo* one : reading_order(composition)) {
      const std::string node = joined(one->id, ' ', '_');
      const bool left_out = one->trigger.empty() && one->effects.empty();
      EXPECT_EQ(flow.nodes.contains(node), !left_out) << node;
      for (const EffectInfo& effect : one->effects) {
        for (const std::string& to : led_to(composition, effect)) {
          const std::string target = joined(to, ' ', '_');
          if (!flow.nodes.contains(target)) continue;  // a step that does nothing
          const auto drawn = std::ranges::any_of(flow.edges, [&](const Line& line) {
            return line.source == node && line.target == target &&
                   (line.label + " ").find(std::string{number_of(effect)} + " ") !=
                       std::string::npos;
          });
          EXPECT_TRUE(drawn) << effect.id << " to " << to;
        }
      }
    }
    for (const Line& line : flow.edges) {
      EXPECT_TRUE(flow.nodes.contains(line.source) && flow.nodes.contains(line.target));
      EXPECT_NE(line.label.find(joined(line.source, '_', ' ') + "."), std::string::npos);
    }
  }
}

TEST(CompositionMermaid, DrawsPacketsThickAndTimersDotted) {
  const Flow flow = read_flow(composition_mermaid(all()[0]));
  std::set<std::string> seen;
  for (const Line& line : flow.edges) {
    seen.insert(line.source + line.arrow + line.target + " " + line.label);
  }
  for (const char* edge : {"AckNackDue==>AckNackArrives AckNack<br/>AckNackDue.2",
                           "AckNackArrives-.->RepairIsDue RepairGeneration<br/>AckNackArrives.4",
                           "Hear-->WriterSideOpens WriterOpens<br/>Hear.8 .9",
                           "RepairIsDue-->Generate RepairIsDue.2"}) {
    EXPECT_TRUE(seen.contains(edge)) << edge;
  }
}

TEST(CompositionMermaid, ReadingNoticesWhatTheGrammarHasNot) {
  EXPECT_NE(read_flow("flowchart TB\n  A[\"a\n").fault, "");
  EXPECT_NE(read_flow("flowchart TB\n  subgraph s[\"x\"]\n").fault, "");
  EXPECT_NE(read_flow("graph\n").fault, "");
  EXPECT_EQ(read_flow("flowchart TB\n  A[\"a\"]\n  A ==>|\"x\"| A\n").fault, "");
}

}  // namespace composition_pictures_test
}  // namespace stormproof::draw
