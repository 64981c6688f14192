// What only worlds that compare times need of a frame: comparisons that a zone leaves open, marks
// that are still to come, and packets of several parts.
#include <gtest/gtest.h>

#include "checker/engines/explorer/search.hpp"

namespace stormproof::explorer {
namespace choices_test {

constexpr Slot timer{What::ack_time};

/// A timer comes 10 to 20 ns after the start; a mark stands at 15.
struct Fixture {
  Scope scope;
  EventRules rules{{}, true};
  Frame frame{scope, rules};

  Fixture() {
    scope.least_delay = model::Nanoseconds{1};
    scope.largest_delay = model::Nanoseconds{5};
    frame.schedule_between(timer, 10, 20);
    frame.mark({What::hush_until}, 15);
  }
};

TEST(Comparison, ThatTheZoneLeavesOpenGoesBothWays) {
  for (const unsigned choices : {0U, 1U}) {
    Fixture f;
    f.frame.advance(f.frame.find(timer.what), 0, choices);
    const unsigned mark = f.frame.find(What::hush_until) + 1;
    const bool is_over = f.frame.holds(mark, 0, 0);
    EXPECT_EQ(is_over, choices == 0);
    EXPECT_EQ(f.frame.choices(), 1U);
    // From now on it is known, and asked again it is no choice.
    EXPECT_EQ(f.frame.zone().bound(mark, 0), is_over ? 0 : 5);
    EXPECT_EQ(f.frame.zone().bound(0, mark), is_over ? 5 : -1);
    EXPECT_EQ(f.frame.holds(mark, 0, 0), is_over);
    EXPECT_EQ(f.frame.choices(), 1U);
  }
}

TEST(Comparison, ThatTheZoneDecidesIsNoChoice) {
  Fixture f;
  f.frame.advance(f.frame.find(timer.what), 0, 0xff);
  const unsigned mark = f.frame.find(What::hush_until) + 1;
  EXPECT_TRUE(f.frame.holds(mark, 0, 5));
  EXPECT_FALSE(f.frame.holds(mark, 0, -6));
  EXPECT_EQ(f.frame.choices(), 0U);
}

TEST(Comparison, OfMoreThanALabelHoldsIsNotOverlooked) {
  Fixture f;
  f.frame.advance(f.frame.find(timer.what), 0);
  for (int k = 0; k < 9; ++k) {
    f.frame.mark({What::quiet_until}, k);
    f.frame.schedule_between(timer, 0, 20);
    EXPECT_FALSE(f.frame.overflowed()) << k;
    static_cast<void>(f.frame.holds(f.frame.count(), f.frame.count() - 1, 0));
  }
  EXPECT_TRUE(f.frame.overflowed());
}

TEST(Mark, CanBeStillToCome) {
  Fixture f;
  f.frame.schedule_with({What::heartbeat_time}, f.frame.find(What::hush_until));
  const unsigned event = f.frame.find(What::heartbeat_time);
  EXPECT_EQ(f.frame.zone().bound(event + 1, 0), 15);
  EXPECT_EQ(f.frame.zone().bound(0, event + 1), -15);
}

TEST(Packet, HasPartsThatArriveTogether) {
  for (const unsigned loss_mask : {0U, 1U}) {
    Fixture f;
    f.frame.set_losses(1);
    f.frame.advance(f.frame.find(timer.what), loss_mask);
    f.frame.emit({What::heartbeat, Slot::goes_on});
    f.frame.emit_part({What::data, 0, 1});
    EXPECT_EQ(f.frame.emitted(), 1U);
    const unsigned first = f.frame.find(What::heartbeat) + 1;
    const unsigned second = f.frame.find(What::data, 1) + 1;
    if (loss_mask != 0) {
      EXPECT_EQ(f.frame.pending(What::heartbeat, 0) + f.frame.pending(What::data, 0), 0U);
      continue;
    }
    EXPECT_EQ(f.frame.zone().bound(second, first), 0);
    EXPECT_EQ(f.frame.zone().bound(first, second), 0);
    EXPECT_EQ(f.frame.zone().bound(second, 0), 5);
    EXPECT_FALSE(f.frame.can_be_next(second - 1)) << "in their order";
    EXPECT_TRUE(f.frame.can_be_next(first - 1));
  }
}

}  // namespace choices_test
}  // namespace stormproof::explorer
