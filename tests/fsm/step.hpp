// One line per row: a helper for the machines' tests that makes one step and compares the new state
// and ALL outputs with what is expected, so that a row that asks for something more than it should
// fails, too.
#pragma once

#include <sstream>
#include <string>

#include <boost/pfr.hpp>
#include <gtest/gtest.h>

#include "fsm/flyweight.hpp"

namespace stormproof::fsm {

template <class Fields>
std::string in_words(const Fields& fields) {
  std::ostringstream text;
  text << boost::pfr::io_fields(fields);
  return text.str();
}

/// In `Source`, `Event` with `input` leads to `Target` and asks for exactly `output`.
template <class Machine, class Source, class Event, class Target>
void expect_step(const typename Flyweight<Machine>::Input& input,
                 const typename Flyweight<Machine>::Output& output = {}) {
  using Info = Reflect<Machine>;
  Flyweight<Machine> engine;
  typename Flyweight<Machine>::Output actual{};
  const StateId after = engine.template step<Event>(Info::template id<Source>, input, actual);
  EXPECT_EQ(Info::state_names[after], name_of<Target>())
      << name_of<Source>() << " on " << name_of<Event>();
  EXPECT_TRUE(boost::pfr::eq_fields(actual, output))
      << name_of<Source>() << " on " << name_of<Event>() << ": outputs " << in_words(actual)
      << ", expected " << in_words(output);
}

/// The step changes nothing and asks for nothing.
template <class Machine, class Source, class Event>
void expect_ignored(const typename Flyweight<Machine>::Input& input) {
  expect_step<Machine, Source, Event, Source>(input);
}

}  // namespace stormproof::fsm
