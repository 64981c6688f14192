// Chains of questions about types and their answers: captures of real participants conform, and
// histories that cannot have happened do not, whatever part of a chain is wrong.
#include <algorithm>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "checker/evidence/capture/type_lookup.hpp"
#include "tests/checker/evidence/conform/captures.hpp"

namespace stormproof::conform::testing {
namespace type_lookups_test {

using capture::Event;
using capture::TypeLookup;

constexpr const char* shown = "fastdds-3/fastdds362_ap150_simple_xtypes_unknown_np1_ne2_r1";

/// A sample of the capture and the last event that carries it.
struct Sample {
  capture::TypeLookups::iterator entry;
  std::size_t event = 0;
};

class TypeLookups : public ::testing::Test {
 protected:
  TypeLookups() : conversation_{shipped(shown)} {}

  /// In the order of the capture.
  std::vector<Sample> samples(bool answers, bool dependencies) {
    std::vector<Sample> found;
    for (std::size_t k = 0; k < conversation_.events.size(); ++k) {
      const Event& event = conversation_.events[k];
      if (event.data() == nullptr) continue;
      const auto entry =
          conversation_.lookups.find({event.source, event.writer, event.data()->sequence_number});
      if (entry == conversation_.lookups.end()) continue;
      const TypeLookup& says = entry->second;
      if (says.is_answer == answers && says.is_about_dependencies == dependencies) {
        found.push_back({entry, k});
      }
    }
    return found;
  }
  /// The sample again, at the end, as another one of its writer.
  TypeLookup& repeat(const Sample& sample) {
    Event again = conversation_.events[sample.event];
    std::get<capture::DataEvent>(again.content).sequence_number += 1'000;
    again.time_ns = conversation_.events.back().time_ns;
    conversation_.events.push_back(again);
    return conversation_.lookups[{again.source, again.writer, again.data()->sequence_number}] =
               sample.entry->second;
  }
  void expect_refused(const std::string& what) {
    const Conformance result = conformance(conversation_, profile("fastdds-3.6"));
    ASSERT_EQ(result.verdict, Verdict::does_not_conform) << what;
    const auto fault =
        std::ranges::find(result.unexplained, Fault::lookup_cause, &Unexplained::fault);
    ASSERT_NE(fault, result.unexplained.end()) << description(result);
    EXPECT_EQ(fault->what, what);
  }

  capture::Conversation conversation_;
};

TEST_F(TypeLookups, AreChainsOfFour) {
  // 24 types in all, as each of the two has 12 that the other one lacks.
  for (const bool answers : {false, true}) {
    EXPECT_EQ(samples(answers, true).size(), 24U);
    EXPECT_EQ(samples(answers, false).size(), 24U);
  }
  std::set<capture::TypeHash> types;
  for (const Sample& one : samples(false, true)) {
    ASSERT_EQ(one.entry->second.types.size(), 1U);
    types.insert(one.entry->second.types.front());
  }
  EXPECT_EQ(types.size(), 24U);
  const Conformance result = conformance(conversation_, profile("fastdds-3.6"));
  EXPECT_EQ(result.verdict, Verdict::conforms) << description(result);
}

TEST_F(TypeLookups, AnAnswerNeedsAQuestion) {
  for (const bool dependencies : {true, false}) {
    for (const Sample& one : samples(true, dependencies)) {
      const std::int64_t number = std::exchange(one.entry->second.number, 1'000);
      expect_refused("an answer about types that nobody has asked");
      one.entry->second.number = number;
    }
  }
}

TEST_F(TypeLookups, AnAnswerIsOfTheKindOfItsQuestion) {
  for (const Sample& one : samples(true, true)) {
    one.entry->second.is_about_dependencies = false;
    expect_refused("an answer about types that nobody has asked");
    one.entry->second.is_about_dependencies = true;
  }
}

TEST_F(TypeLookups, AQuestionIsAnsweredOnce) {
  for (const bool dependencies : {true, false}) {
    repeat(samples(true, dependencies).front());
    expect_refused("an answer to a question that has been answered");
    conversation_ = shipped(shown);
  }
}

TEST_F(TypeLookups, AKnownTypeIsNotAskedForAgain) {
  repeat(samples(false, true).front()).number = 1'000;
  expect_refused("a question about a type that was asked for before");
}

TEST_F(TypeLookups, ATypeOfOnesOwnIsNotAskedFor) {
  const std::vector<Sample> questions = samples(false, true);
  const Sample& last = questions.back();
  const auto other = std::ranges::find_if(questions, [&](const Sample& one) {
    return one.entry->second.asker != last.entry->second.asker;
  });
  ASSERT_NE(other, questions.end());
  TypeLookup& again = repeat(last);
  again.types = other->entry->second.types;  // what the other one lacks is its own
  conversation_.events.back().time_ns += 1'000'000'000;
  expect_refused("a question about a type of which the asker has announced an endpoint");
}

TEST_F(TypeLookups, ATypeThatNobodyAnnouncedIsNotAskedFor) {
  samples(false, true).front().entry->second.types.front().back() ^= 1U;
  expect_refused("a question about a type of which the asked has announced no endpoint");
}

TEST_F(TypeLookups, ATypeIsAskedForAfterItsDependencies) {
  const std::vector<Sample> dependencies = samples(false, true);
  const std::vector<Sample> types = samples(false, false);
  ASSERT_EQ(types.size(), 24U);
  for (const Sample& one : types) {
    const capture::TypeHash type = one.entry->second.types.front();
    one.entry->second.types.front().back() ^= 1U;
    expect_refused("a question about a type before its dependencies were answered");
    one.entry->second.types.front() = type;
  }
}

}  // namespace type_lookups_test
}  // namespace stormproof::conform::testing
