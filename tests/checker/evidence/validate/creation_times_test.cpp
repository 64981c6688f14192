// What HEARTBEATs and DATA prove of the last creation, and what they do not.
#include "checker/evidence/validate/creation_times.hpp"

#include <gtest/gtest.h>

#include "tests/checker/evidence/validate/invented.hpp"

namespace stormproof::validate::testing {
namespace creation_times_test {

constexpr std::int64_t always = INT64_MAX;

CreationTimes of_first(Invented& invented) {
  return creation_times(invented.conversation(), always).at(Invented::prefix(0));
}

TEST(CreationTimes, HeartbeatsBoundTheLastCreation) {
  Invented invented = two_hosts();
  invented.heartbeat(0, pubs, 1, 1, 10 * ms).heartbeat(0, pubs, 2, 1, 20 * ms);
  invented.asks(1, pubs, 1, 0, 22 * ms).asks(1, pubs, 2, 0, 22 * ms);
  invented.describes_all(0, pubs, 2, 1, 30 * ms);
  const CreationTimes times = of_first(invented);
  EXPECT_EQ(times.last_earliest, 10 * ms);
  EXPECT_EQ(times.last_latest, 20 * ms);
  EXPECT_TRUE(times.seen.empty());
}

TEST(CreationTimes, PushedDataShowsItsCreation) {
  Invented invented = two_hosts();
  invented.describes(0, pubs, 1, 1, 10 * ms).describes(0, pubs, 2, 1, 25 * ms);
  const CreationTimes times = of_first(invented);
  EXPECT_EQ(times.last_earliest, 25 * ms);
  EXPECT_EQ(times.last_latest, 25 * ms);
  ASSERT_EQ(times.seen.size(), 2U);
  EXPECT_EQ(times.seen[0].time_ns, 10 * ms);
  EXPECT_EQ(times.seen[1].number, 2);
}

TEST(CreationTimes, APushOfAnEarlierDescriptorIsALowerBound) {
  Invented invented = two_hosts();
  invented.describes(0, pubs, 1, 1, 10 * ms).heartbeat(0, pubs, 2, 1, 40 * ms);
  invented.asks(1, pubs, 2, 0, 45 * ms).describes(0, pubs, 2, 1, 50 * ms);
  const CreationTimes times = of_first(invented);
  EXPECT_EQ(times.last_earliest, 10 * ms);
  EXPECT_EQ(times.last_latest, 40 * ms);
}

TEST(CreationTimes, DataThatWasAskedForOrAnnouncedIsNoPush) {
  Invented asked = two_hosts();
  asked.asks(1, pubs, 1, 0, 5 * ms).describes(0, pubs, 1, 1, 10 * ms);
  EXPECT_TRUE(of_first(asked).seen.empty());
  Invented announced = two_hosts();
  announced.heartbeat(0, pubs, 1, 1, 5 * ms).describes(0, pubs, 1, 1, 10 * ms);
  EXPECT_TRUE(of_first(announced).seen.empty());
  EXPECT_EQ(of_first(announced).last_latest, 5 * ms);
}

TEST(CreationTimes, TheLaterStreamDecides) {
  Invented invented = two_hosts();
  invented.describes(0, pubs, 1, 1, 10 * ms).describes(0, subs, 1, 1, 30 * ms);
  EXPECT_EQ(of_first(invented).last_earliest, 30 * ms);
  EXPECT_EQ(of_first(invented).last_latest, 30 * ms);
}

TEST(CreationTimes, RenewedAndEndedDescriptionsAreNoCreations) {
  Invented invented = two_hosts();
  invented.describes(0, pubs, 1, 1, 10 * ms);
  capture::Event again = invented.event(0, 1, pubs, 50 * ms);
  again.content = capture::DataEvent{
      .sequence_number = 2, .endpoint = invented.conversation().events.back().data()->endpoint};
  invented.adds(again);
  capture::Event gone = again;
  gone.time_ns = 60 * ms;
  gone.content =
      capture::DataEvent{.sequence_number = 3, .endpoint = again.data()->endpoint, .is_gone = true};
  invented.adds(gone);
  EXPECT_EQ(of_first(invented).last_latest, 10 * ms);
}

TEST(CreationTimes, NothingAfterTheCutCounts) {
  Invented invented = two_hosts();
  invented.describes(0, pubs, 1, 1, 10 * ms).describes(0, pubs, 2, 1, 25 * ms);
  const auto times = creation_times(invented.conversation(), 20 * ms);
  EXPECT_EQ(times.at(Invented::prefix(0)).last_latest, 10 * ms);
}

}  // namespace creation_times_test
}  // namespace stormproof::validate::testing
