// What a recorded program keeps of its rules: when something is read, what a term is about, and
// which rules are refused because a reader could not do what they do.
#include <stdexcept>

#include <gtest/gtest.h>

#include "fsm/composition/paper.hpp"
#include "fsm/program/programs.hpp"
#include "fsm/program/record.hpp"

namespace stormproof::fsm::program {
namespace recorder_test {

using namespace composition;

struct Counter : Number<owner::relation> {};
struct Mark : Flag<owner::descriptor> {};
struct Asks : Occasion<owner::relation> {};
struct Answers : Occasion<owner::relation> {};
struct Saying : Packet<owner::relation, Listed> {};

template <class... Rs>
struct Small {
  static constexpr std::string_view name = "small";
  using AckNack = Saying;
  using IsOpen = HeartbeatSeen;
  using Parts = TypeList<>;
  using Timers = TypeList<>;
  using State = TypeList<Counter, Mark>;
  using Packets = TypeList<Saying>;
  using Occasions = TypeList<Asks, Answers>;
  using Rules = TypeList<Rs...>;
  static constexpr std::array<Unused, 0> unused{};
  static constexpr std::array<FromOutside, 0> from_outside{};
};

struct Counts : composition::Rule<Happens<Asks>> {
  template <class W>
  static void run(W& w) {
    const auto before = w(Counter{});
    w.set(Counter{}, before + 1);
    w.when(before > 0, [&] {
      w.emit(Saying{}, says(Says{Listed{}, [](auto& d) { return d(Mark{}); }}));
    });
  }
};

TEST(ProgramRecorder, WhatARuleReadsIsReadThen) {
  const Program program = recorded<Small<Counts>>();
  const Steps& steps = program.rules.at(0).body;
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps[0].what, Do::let);
  EXPECT_EQ(program.terms[steps[0].value].op, Op::read);
  EXPECT_EQ(steps[1].what, Do::set);
  const Term& condition = program.terms[steps[2].value];
  EXPECT_EQ(condition.op, Op::greater);
  EXPECT_EQ(program.terms[condition.a].op, Op::let);
  EXPECT_EQ(program.terms[condition.a].reg, steps[0].reg);
}

TEST(ProgramRecorder, ATermOfADescriptorReadsWhereItIsEvaluated) {
  const Program program = recorded<Small<Counts>>();
  const Step& emit = program.rules.at(0).body.at(2).body.at(0);
  ASSERT_EQ(emit.what, Do::emit);
  EXPECT_TRUE(emit.with.at(0).inner);
  EXPECT_EQ(program.terms[emit.with.at(0).value].op, Op::read);
  EXPECT_EQ(program.things[emit.fields.at(0)].name, "Listed");
}

struct Echo : composition::Rule<Happens<Asks>> {
  template <class W>
  static void run(W& w) {
    w.raise(Answers{});
  }
};
struct EchoOfEcho : composition::Rule<Happens<Answers>> {
  template <class W>
  static void run(W& w) {
    w.raise(Asks{});
  }
};
TEST(ProgramRecorder, RefusesARuleThatRunsWithinItself) {
  EXPECT_THROW(((void)recorded<Small<Echo, EchoOfEcho>>()), std::logic_error);
  EXPECT_NO_THROW((void)recorded<Small<Echo>>());
}

struct Captures : composition::Rule<Happens<Asks>> {
  template <class W>
  static void run(W& w) {
    w.set_each(Mark{}, [](auto& d) {
      const auto here = d(Mark{});
      return d.some_from_here([&](auto& e) { return e(X{}) && here; });
    });
  }
};
TEST(ProgramRecorder, RefusesATermThatReadsAtAnotherPlace) {
  EXPECT_THROW((void)recorded<Small<Captures>>(), std::logic_error);
}

namespace elsewhere {
struct Mark : Flag<owner::relation> {};
}  // namespace elsewhere
struct TwoMarks : composition::Rule<Happens<Asks>> {
  template <class W>
  static void run(W& w) {
    w.set(elsewhere::Mark{}, typename W::Bool(true));
  }
};
TEST(ProgramRecorder, RefusesTwoThingsOfOneName) {
  EXPECT_THROW((void)recorded<Small<TwoMarks>>(), std::logic_error);
}

struct Takes : composition::Procedure {
  template <class W, class Outbox>
  static void body(W& w, const Outbox& outbox) {
    w.when(outbox.schedule, [&] { w.set(Counter{}, 0); });
  }
};
struct First : Part<InitialAckNack, owner::relation> {};
struct Second : Part<InitialAckNack, owner::relation> {};
template <class P>
struct Feeds : composition::Rule<Happens<Asks>> {
  template <class W>
  static void run(W& w) {
    w.call(Takes{}, w.feed(First{}, on<initial_acknack::AttemptDue>));
    w.call(Takes{}, w.feed(P{}, on<initial_acknack::AttemptDue>));
  }
};
TEST(ProgramRecorder, RefusesAProcedureThatIsGivenOutboxesOfDifferentParts) {
  EXPECT_THROW((void)recorded<Small<Feeds<Second>>>(), std::logic_error);
  EXPECT_EQ((recorded<Small<Feeds<First>>>().procedures.size()), 1U);
}

/// An input that a rule leaves out, and an outbox, have the sort of their field.
TEST(ProgramRecorder, NumbersThatNobodySetsAreZero) {
  const Program program = recorded<Small<Feeds<First>>>();
  const Step& feed = program.rules.at(0).body.at(0);
  const Machine& machine = program.machine_of(feed.target);
  ASSERT_EQ(feed.with.size(), machine.inputs.size());
  for (std::size_t k = 0; k < feed.with.size(); ++k) {
    const Op unset = machine.inputs[k] == Sort::number ? Op::integer : Op::truth;
    EXPECT_EQ(program.terms[feed.with[k].value].op, unset) << k;
  }
  EXPECT_EQ(machine.outputs.at(0).sort, Sort::truth);
  EXPECT_EQ(machine.outputs.at(2).name, "next_delay");
  EXPECT_EQ(machine.outputs.at(2).sort, Sort::number);
}

TEST(Programs, KnowWhichRulesAreTheExchange) {
  const Program& paper = programs().at(0);
  EXPECT_EQ(paper.name, "paper");
  EXPECT_EQ(paper.rule_for(Trigger::due, paper.find("Announcement"))->group,
            Rule::Group::announcing);
  EXPECT_EQ(paper.rule_for(Trigger::left, paper.find("Data"))->group, Rule::Group::exchange);
  EXPECT_EQ(paper.rule_for(Trigger::left, paper.find("Heartbeat")), nullptr);
  EXPECT_TRUE(paper.comes_from_outside(paper.find("Announcement")));
  EXPECT_FALSE(paper.opening.empty());
}

}  // namespace recorder_test
}  // namespace stormproof::fsm::program
