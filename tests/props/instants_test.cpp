// What monitors of instants are told: of an event that does not belong where it is, of the end of
// the first instant beyond a horizon and of no other, and of more events than an instant may have.
#include "props/monitors/instants.hpp"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace stormproof::props {
namespace instants_test {

using model::EventKind;
using model::Nanoseconds;

struct Told final : Instants::Listener {
  void out_of_order(const Instants::Place& before, const model::Event& event) override {
    misplaced.emplace_back(before.insertion, event.insertion());
  }
  void crowded(const model::Event&) override { ++surplus; }
  void over(Nanoseconds from, Nanoseconds to) override {
    ends.emplace_back(from.count(), to.count());
  }

  std::vector<std::pair<std::uint64_t, std::uint64_t>> misplaced;
  std::vector<std::pair<std::int64_t, std::int64_t>> ends;
  int surplus = 0;
};

model::Event at(std::int64_t time, std::uint64_t insertion,
                EventKind kind = EventKind::announcement_due) {
  model::Event event;
  event.time = Nanoseconds{time};
  event.order = insertion;
  event.kind = kind;
  return event;
}

TEST(Instants, TellWhichEventDoesNotBelongBehindTheOneBeforeIt) {
  Instants instants;
  Told told;
  instants.listen(told);
  for (const model::Event& event :
       {at(1, 5), at(1, 6), at(2, 3), at(2, 4, EventKind::dispatch), at(3, 1)}) {
    instants.event_started(event);
  }
  EXPECT_TRUE(told.misplaced.empty());
  instants.event_started(at(3, 0));                               // inserted before
  instants.event_started(at(3, 9, EventKind::service_finished));  // of a class before
  instants.event_started(at(2, 10));                              // time runs backwards
  const std::vector<std::pair<std::uint64_t, std::uint64_t>> expected{{1, 0}, {0, 9}, {9, 10}};
  EXPECT_EQ(told.misplaced, expected);
}

TEST(Instants, TellOfTheEndOfInstantsBeyondTheHorizonOnly) {
  Instants instants;
  Told told;
  Told other;
  const std::size_t number = instants.listen(told);
  instants.listen(other);
  instants.event_started(at(1, 0));
  instants.wait_beyond(number, Nanoseconds{5});
  for (const std::int64_t time : {2, 5, 5, 7, 7, 8}) instants.event_started(at(time, 1));
  const std::vector<std::pair<std::int64_t, std::int64_t>> both{{5, 7}, {7, 8}};
  EXPECT_EQ(told.ends, both);
  instants.wait_beyond(number, Instants::never);
  instants.event_started(at(9, 1));
  EXPECT_EQ(told.ends, both);
  EXPECT_TRUE(other.ends.empty());
}

TEST(Instants, TellOfEventsBehindTheMostThatOneMayHave) {
  Instants instants;
  Told told;
  instants.listen(told);
  for (std::uint64_t k = 0; k < Instants::most; ++k) instants.event_started(at(1, k));
  EXPECT_EQ(told.surplus, 0);
  instants.event_started(at(1, Instants::most));
  EXPECT_EQ(told.surplus, 1);
  instants.event_started(at(2, 0));
  EXPECT_EQ(told.surplus, 1);
}

}  // namespace instants_test
}  // namespace stormproof::props
