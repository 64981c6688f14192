// The includes and words of fsm, model, props and checker obey the rules; and the rules can fail,
// which invented trees show.
#include <gtest/gtest.h>

#include "tests/structure/callers.hpp"
#include "tests/structure/host_functions.hpp"
#include "tests/structure/includes.hpp"
#include "tests/structure/knobs.hpp"
#include "tests/structure/rules.hpp"
#include "tests/structure/words.hpp"

namespace stormproof::structure {
namespace structure_test {

using Complaints = std::vector<std::string>;

std::string lines(const Complaints& complaints) {
  std::string text;
  for (const std::string& complaint : complaints) text += complaint + "\n";
  return text;
}

const Texts& texts() {
  static const Texts all = read_texts(STORMPROOF_SOURCE_DIR, {"fsm", "model", "props", "checker"});
  return all;
}
const Includes& sources() {
  static const Includes includes = includes_of(texts());
  return includes;
}

std::string data_file(const std::string& name) {
  return STORMPROOF_SOURCE_DIR "/tests/structure/" + name;
}

TEST(Structure, IncludesGoDownwards) {
  EXPECT_EQ(lines(check_folders(sources(), read_words(data_file("folders.txt")))), "");
}

TEST(Structure, HeadersDoNotDragInWhatTheyDoNotNeed) {
  std::map<std::string, HeavyHeaders> rules;
  for (const std::vector<std::string>& words : read_words(data_file("heavy_headers.txt"))) {
    ASSERT_TRUE(words.size() == 1 || words.size() == 2) << "expected: library [header] # reason";
    HeavyHeaders& rule = rules[words[0]];
    rule.library = words[0];
    if (words.size() == 2) rule.allowed.push_back(words[1]);
  }
  for (const char* library : {"boost/", "z3++.h", "nlohmann/json.hpp", "CLI/"}) {
    ASSERT_TRUE(rules.contains(library)) << library;
    EXPECT_EQ(lines(check_heavy_headers(sources(), rules[library])), "");
  }
}

TEST(Structure, WordsStayWhereTheyBelong) {
  std::map<std::string, ReservedWord> rules;
  for (const std::vector<std::string>& words : read_words(data_file("reserved_words.txt"))) {
    ASSERT_TRUE(words.size() == 1 || words.size() == 2) << "expected: word [file] # reason";
    ReservedWord& rule = rules[words[0]];
    rule.word = words[0];
    if (words.size() == 2) rule.allowed.push_back(words[1]);
  }
  for (const char* word : {"ImplementationKind::", "is_fastdds"}) {
    ASSERT_TRUE(rules.contains(word)) << word;
  }
  for (const auto& [word, rule] : rules) EXPECT_EQ(lines(check_word(texts(), rule)), "");
}

TEST(Structure, HostsDoNotGrowAccessors) {
  HostFunctions most;
  for (const std::vector<std::string>& words : read_words(data_file("host_functions.txt"))) {
    ASSERT_EQ(words.size(), 2U) << "expected: file number # reason";
    most[words[0]] = std::stoul(words[1]);
  }
  EXPECT_EQ(lines(check_hosts(texts(), most)), "");
}

TEST(Structure, FunctionsHaveCallersBesideTests) {
  std::vector<std::string> allowed;
  for (const std::vector<std::string>& words : read_words(data_file("callers.txt"))) {
    ASSERT_EQ(words.size(), 1U) << "expected: function # reason";
    allowed.push_back(words[0]);
  }
  EXPECT_EQ(lines(check_callers(texts(), allowed)), "");
}

TEST(Structure, AKnobIsNamedInFewPlaces) {
  constexpr const char* table = "model/config/knobs/dds_knobs.hpp";
  Texts places = read_texts(STORMPROOF_SOURCE_DIR, {"fsm/composition", "model/config"});
  for (const char* file : {"model/dds_profile.hpp", "model/amendments.hpp",
                           "model/engine/composition_knobs.hpp", table}) {
    ASSERT_TRUE(texts().contains(file)) << file;
    places[file] = texts().at(file);
  }
  std::map<std::string, std::size_t> listed;
  for (const std::vector<std::string>& words : read_words(data_file("knobs.txt"))) {
    ASSERT_EQ(words.size(), 2U) << "expected: key files # reason";
    listed[words[0]] = std::stoul(words[1]);
  }
  const std::vector<std::string> knobs = knobs_of(texts().at(table));
  EXPECT_GT(knobs.size(), 70U);
  EXPECT_EQ(lines(check_knobs(knobs, places, 4, listed)), "");
}

TEST(Structure, ReadsIncludes) {
  EXPECT_EQ(includes_of("// a\n#include <z3++.h>\n  #  include \"a/b.hpp\"  // why\n"
                        "const char* text = \"#include <no>\";\n#define X\n"),
            (Complaints{"z3++.h", "a/b.hpp"}));
  EXPECT_GT(sources().size(), 400U);
  EXPECT_TRUE(sources().contains("model/probe.hpp"));
}

/// Three layers; `wing` and `tail` stand side by side, and so does a file of `body`.
const Layers layers{{"body"}, {"wing", "tail", "body/engine"}, {"wing/tip"}};

TEST(Folders, ArrowsDownAndInsideAreAllowed) {
  const Includes tree{{"body/a.hpp", {"vector", "body/b.hpp"}},
                      {"body/b.hpp", {}},
                      {"body/engine.cpp", {"body/a.hpp"}},
                      {"tail/a.cpp", {"body/a.hpp", "z3++.h"}},
                      {"wing/a.hpp", {"wing/b.hpp"}},
                      {"wing/b.hpp", {"wing/a.hpp"}},
                      {"wing/tip/a.cpp", {"tail/a.cpp", "body/engine.cpp"}}};
  EXPECT_EQ(check_folders(tree, layers), Complaints{});
}

TEST(Folders, ArrowsUpAndSidewaysAreNot) {
  const Includes tree{{"body/a.hpp", {"wing/a.hpp"}},
                      {"body/engine.hpp", {}},
                      {"tail/a.cpp", {"wing/a.hpp"}},
                      {"wing/a.hpp", {"body/engine.hpp"}},
                      {"wing/tip/a.hpp", {}}};
  EXPECT_EQ(check_folders(tree, layers),
            (Complaints{"body/a.hpp includes wing/a.hpp: wing is above body",
                        "tail/a.cpp includes wing/a.hpp: wing is beside tail",
                        "wing/a.hpp includes body/engine.hpp: body/engine is beside wing"}));
}

TEST(Folders, ACycleHasAnArrowUp) {
  const Includes tree{{"a/x.hpp", {"b/x.hpp"}}, {"b/y.hpp", {"a/x.hpp"}}, {"b/x.hpp", {}}};
  EXPECT_EQ(check_folders(tree, {{"a"}, {"b"}}).size(), 1U);
  EXPECT_EQ(check_folders(tree, {{"b"}, {"a"}}).size(), 1U);
  EXPECT_EQ(check_folders(tree, {{"a", "b"}}).size(), 2U);
}

TEST(Folders, TheListIsComplete) {
  const Includes tree{{"body/a.hpp", {}}, {"fin/a.hpp", {}}};
  EXPECT_EQ(check_folders(tree, {{"body"}, {"wing", "body"}}),
            (Complaints{"body stands in the list twice", "fin/a.hpp is in no folder of the list",
                        "wing has no file"}));
}

TEST(HeavyHeaders, AreFoundOverOtherHeaders) {
  const Includes tree{{"a.hpp", {"z3++.h"}},
                      {"b.hpp", {"vector", "a.hpp"}},
                      {"b.cpp", {"b.hpp"}},
                      {"c.hpp", {"c.hpp", "string"}}};
  EXPECT_EQ(check_heavy_headers(tree, {"z3++.h", {"a.hpp"}}),
            Complaints{"b.hpp is not to reach z3++.h: b.hpp → a.hpp → z3++.h"});
  EXPECT_EQ(check_heavy_headers(tree, {"z3++.h", {"a.hpp", "b.hpp"}}), Complaints{});
  EXPECT_EQ(check_heavy_headers(tree, {"boost/", {}}), Complaints{});
}

TEST(HeavyHeaders, PermissionsThatNobodyNeedsAreNoticed) {
  const Includes tree{{"a/x.hpp", {"boost/msm/row.hpp"}}, {"b/x.hpp", {}}};
  EXPECT_EQ(check_heavy_headers(tree, {"boost/", {"a/", "b/"}}),
            Complaints{"b/ does not reach boost/, and need not be allowed to"});
}

TEST(Knobs, AreCountedByFiles) {
  const Texts tree{{"table.hpp", "visit.knob(\"first\", x);\nvisit.knob(\n    \"second\", y);\n"},
                   {"a.cpp", "p.first = 1;  // second\n"},
                   {"b.cpp", "set(\"sedp.first\"); the_second(1);\n"}};
  const std::vector<std::string> knobs = knobs_of(tree.at("table.hpp"));
  ASSERT_EQ(knobs, (std::vector<std::string>{"first", "second"}));
  EXPECT_EQ(check_knobs(knobs, tree, 3, {}), Complaints{});
  EXPECT_EQ(check_knobs(knobs, tree, 1, {}), Complaints{"first is named in 3 files, not 1"});
  EXPECT_EQ(check_knobs(knobs, tree, 1, {{"first", 3}}), Complaints{});
  EXPECT_EQ(
      check_knobs(knobs, tree, 1, {{"first", 4}, {"third", 1}}),
      (Complaints{"first is listed with 4 files, and needs 3", "third is listed and no knob"}));
}

TEST(ReservedWords, AreFoundWithBlanksInThem) {
  const Texts tree{{"home.hpp", "switch (kind) { case Kind::round: }"},
                   {"a.cpp", "if (kind == Kind::square) roll();"},
                   {"b.cpp", "enum class Kind : char { round };"},
                   {"c.cpp", "using enum\n  Kind;"}};
  EXPECT_EQ(check_word(tree, {"Kind::", {"home.hpp"}}), Complaints{"a.cpp is not to say Kind::"});
  EXPECT_EQ(check_word(tree, {"Kind::", {"home.hpp", "a.cpp"}}), Complaints{});
  EXPECT_EQ(check_word(tree, {"usingenumKind", {}}),
            Complaints{"c.cpp is not to say usingenumKind"});
}

TEST(Callers, OfFunctionsOnlyDeclaredAndDefinedAreMissed) {
  const Texts tree{
      {"a/x.hpp",
       "int used(int);\nstd::string& lone(int a);\n/// dead(1) is mine\nint dead(int);\n"
       "struct S {\n  [[nodiscard]] bool inside() const { return used(1) > 0; }\n};\n"},
      {"a/x.cpp",
       "int used(int a) { return a; }\nstd::string& lone(int a) {\n  return f(\"dead(\");\n}\n"}};
  EXPECT_EQ(check_callers(tree, {}), (Complaints{"dead of a/x.hpp is called by no source",
                                                 "inside of a/x.hpp is called by no source",
                                                 "lone of a/x.hpp is called by no source"}));
  EXPECT_EQ(check_callers(tree, {"a/"}), Complaints{});
  EXPECT_EQ(check_callers(tree, {"a/", "used"}),
            Complaints{"used need not be allowed to have no caller"});
}

TEST(Callers, ACallIsOneWhereverItStands) {
  EXPECT_EQ(check_callers({{"a.hpp", "int f(int);\n"}, {"b.cpp", "int g = f(2);\n"}}, {}),
            Complaints{});
  EXPECT_EQ(check_callers({{"a.hpp", "int f(int);\n"}, {"b.cpp", "  f(2);\n"}}, {}), Complaints{});
  EXPECT_EQ(check_callers({{"a.hpp", "int f(int);\n"}, {"b.cpp", "auto all = {&f};\n"}}, {}),
            Complaints{});
  EXPECT_EQ(check_callers({{"a.hpp", "int f(int);\nint f(long);\n"}}, {}), Complaints{})
      << "two of them";
}

TEST(Callers, CommentsAndQuotesAreNoCode) {
  EXPECT_EQ(code_of("a // b\nc \"d\\\" e\" f R\"(g \" h)\" i"), "a \nc \"\" f R\"\" i");
}

TEST(ReservedWords, PermissionsThatNobodyNeedsAreNoticed) {
  EXPECT_EQ(check_word({{"a.cpp", "no"}, {"b.cpp", "yes"}}, {"yes", {"a.cpp", "b.cpp"}}),
            Complaints{"a.cpp does not say yes, and need not be allowed to"});
}

TEST(HostFunctions, AreDeclarations) {
  const auto count = [](const char* text) { return count_host_functions(text); };
  EXPECT_EQ(count("[[nodiscard]] bool value(Open, int r) const { return open_[r]; }"), 1U);
  EXPECT_EQ(
      count("auto& state(Reader, int r);\nT* driver(Reader);\nvoid assign(Open, int, bool) {}"),
      3U);
  EXPECT_EQ(count("std::vector<int> word(Known);\nstatic constexpr auto\n    lane_order(C);"), 2U);
  EXPECT_EQ(count("return value(Open{}, r);\nx = value(a);\nif (value(b)) host.assign(c);"), 0U);
  EXPECT_EQ(count("a && value(b);\na & word(b);\na * value(c);\np->emit(d);\nBase::emit(e);"), 0U);
  EXPECT_EQ(count("// auto& state(Reader);\nvoid has_value(int);\nusing Stored::word;"), 0U);
}

TEST(HostFunctions, MoreThanTheListSaysAreRefused) {
  const Texts tree{{"a.hpp", "class A : public Stored<A> { bool said(X); int word(Y); };"},
                   {"b.hpp", "class B : public model::Kept<B> { void emit(X); };"},
                   {"c.hpp", "class C : public Stored<C> {};"},
                   {"d.hpp", "class D { bool said(X); };"}};
  EXPECT_EQ(check_hosts(tree, {{"a.hpp", 2}, {"b.hpp", 1}}), Complaints{});
  EXPECT_EQ(check_hosts(tree, {{"a.hpp", 1}, {"b.hpp", 3}, {"c.hpp", 1}}),
            (Complaints{"a.hpp has 2 functions that a world asks for, and had 1",
                        "c.hpp has none, and need not be in the list"}));
  EXPECT_EQ(check_hosts(tree, {{"a.hpp", 2}, {"e.hpp", 1}}),
            (Complaints{"e.hpp has none, and need not be in the list",
                        "b.hpp has a store, and is not in the list"}));
}

}  // namespace structure_test
}  // namespace stormproof::structure
