// The channel of the access point on cases worked out by hand: times to the nanosecond, queues,
// losses. Overhead 150 us, 144.4 Mbit/s, multicast downlink 6 Mbit/s, so a frame of 1444 bytes
// takes 230000 ns as unicast, and one of 750 bytes takes 1150000 ns as multicast.
#include <gtest/gtest.h>

#include "tests/live/access_point/half_duplex_channel.hpp"

namespace stormproof::live {
namespace channel_test {

constexpr std::int64_t us = 1'000;

model::WirelessProfile emulated() {
  model::WirelessProfile wireless;
  wireless.overhead_unicast = Nanoseconds{150 * us};
  wireless.overhead_multicast = Nanoseconds{150 * us};
  wireless.link_overhead_bytes = model::Bytes{ethernet_header_bytes};
  wireless.order = model::ServiceOrder::fifo;
  return wireless;
}

/// A channel, and what came out of it so far.
class Bed {
 public:
  explicit Bed(const QueueLimits& limits = {}, const Losses& losses = {},
               const model::WirelessProfile& wireless = emulated())
      : channel{wireless, limits, losses} {}

  std::optional<std::uint32_t> send(std::int64_t at_ns, std::uint32_t station,
                                    std::int64_t bytes = 1444, Cast cast = Cast::unicast) {
    return channel.request(Nanoseconds{at_ns}, {station, bytes, cast});
  }
  std::vector<Service> until(std::int64_t ns) {
    channel.advance(Nanoseconds{ns});
    return channel.take_services();
  }

  HalfDuplexChannel channel;
};

constexpr std::int64_t long_time = 1'000'000 * us;

std::vector<std::int64_t> ends(const std::vector<Service>& services) {
  std::vector<std::int64_t> times;
  for (const Service& service : services) times.push_back(service.end.count());
  return times;
}

std::vector<std::uint32_t> stations(const std::vector<Service>& services, Direction direction) {
  std::vector<std::uint32_t> list;
  for (const Service& service : services) {
    if (service.direction == direction) list.push_back(service.station);
  }
  return list;
}

using Times = std::vector<std::int64_t>;
using Stations = std::vector<std::uint32_t>;

TEST(AccessPointChannel, ServesAFrameTwice) {
  Bed bed;
  ASSERT_TRUE(bed.send(7, 0));
  const auto services = bed.until(long_time);
  ASSERT_EQ(ends(services), (Times{230'007, 460'007}));
  EXPECT_EQ(services[0].outcome, ServiceEnd::forwarded);
  EXPECT_EQ(services[1].outcome, ServiceEnd::delivered);
  EXPECT_EQ(services[1].start, services[0].end);
}

TEST(AccessPointChannel, MulticastGoesDownAtItsOwnRate) {
  Bed bed;
  bed.send(0, 1, 750, Cast::multicast);
  // up as unicast: 150000 + 6000 bit / 144.4 Mbit/s = 41551 (rounded); down: 6000 bit / 6 Mbit/s
  EXPECT_EQ(ends(bed.until(long_time)), (Times{191'551, 191'551 + 1'150'000}));
}

TEST(AccessPointChannel, RoundsAirtimeToTheNearestNanosecond) {
  Bed bed;
  bed.send(0, 0, 1514);  // 12112 bit / 144.4 Mbit/s = 83878.116… ns
  EXPECT_EQ(ends(bed.until(long_time)), (Times{233'878, 467'756}));
  Bed other;
  other.send(0, 0, 60);  // 480 bit: 3324.099… ns
  EXPECT_EQ(ends(other.until(long_time)), (Times{153'324, 306'648}));
}

TEST(AccessPointChannel, CountsTheLinkOverheadOfTheProfileInsteadOfTheEthernetHeader) {
  model::WirelessProfile wireless = emulated();
  wireless.link_overhead_bytes = model::Bytes{38};
  Bed bed{{}, {}, wireless};
  bed.send(0, 0, 1444 - 24);
  EXPECT_EQ(ends(bed.until(long_time)), (Times{230'000, 460'000}));
}

TEST(AccessPointChannel, IsHalfDuplexAndFirstComeFirstServed) {
  Bed bed;
  bed.send(0, 0);
  bed.send(10, 1);
  bed.send(20, 0);
  // The first downlink is requested at 230000, after both other uplinks.
  const auto services = bed.until(long_time);
  EXPECT_EQ(ends(services), (Times{230'000, 460'000, 690'000, 920'000, 1'150'000, 1'380'000}));
  EXPECT_EQ(stations(services, Direction::uplink), (Stations{0, 1, 0}));
  EXPECT_EQ(services[1].direction, Direction::uplink);
  EXPECT_EQ(services[3].direction, Direction::downlink);
}

TEST(AccessPointChannel, ADownlinkGoesBeforeALaterUplink) {
  Bed bed;
  bed.send(0, 0);
  bed.send(230'001, 1);  // one nanosecond after the first frame has gone up
  const auto services = bed.until(long_time);
  ASSERT_EQ(services.size(), 4U);
  EXPECT_EQ(services[1].station, 0U);
  EXPECT_EQ(services[1].direction, Direction::downlink);
  EXPECT_EQ(services[2].start.count(), 460'000);
}

/// At one instant: an uplink ends, and another frame requests service.
std::uint32_t served_second(model::ServiceOrder order) {
  model::WirelessProfile wireless = emulated();
  wireless.order = order;
  Bed bed{{}, {}, wireless};
  bed.send(0, 0);
  bed.send(230'000, 1);
  return bed.until(long_time).at(1).station;
}

TEST(AccessPointChannel, TheOrderDecidesAmongRequestsOfOneInstant) {
  EXPECT_EQ(served_second(model::ServiceOrder::fifo), 0U);
  EXPECT_EQ(served_second(model::ServiceOrder::fifo_downlink), 0U);
  EXPECT_EQ(served_second(model::ServiceOrder::fifo_uplink), 1U);
}

TEST(AccessPointChannel, IsIdleBetweenFramesAndSaysWhenItIsDue) {
  Bed bed;
  EXPECT_FALSE(bed.channel.next_event());
  bed.send(1'000, 0);
  EXPECT_EQ(bed.channel.next_event(), Nanoseconds{1'000});
  EXPECT_TRUE(bed.until(230'999).empty());
  EXPECT_EQ(bed.channel.next_event(), Nanoseconds{231'000});
  EXPECT_EQ(bed.until(231'000).size(), 1U);
  EXPECT_EQ(bed.until(461'000).size(), 1U);
  EXPECT_FALSE(bed.channel.next_event());
  EXPECT_EQ(bed.channel.frames_inside(), 0U);
  bed.send(900'000, 1);
  EXPECT_EQ(ends(bed.until(long_time)), (Times{1'130'000, 1'360'000}));
}

TEST(AccessPointChannel, BeingAskedLateChangesNoTime) {
  Bed prompt;
  Bed late;
  Times expected;
  for (std::int64_t k = 0; k < 20; ++k) {
    prompt.send(k * 100'000, k % 2 == 0 ? 0 : 1);
    late.send(k * 100'000, k % 2 == 0 ? 0 : 1);
    for (std::int64_t t = 0; t < 100'000; t += 9'973) {
      const Times more = ends(prompt.until(k * 100'000 + t));
      expected.insert(expected.end(), more.begin(), more.end());
    }
  }
  const Times rest = ends(prompt.until(long_time));
  expected.insert(expected.end(), rest.begin(), rest.end());
  EXPECT_EQ(expected.size(), 40U);
  EXPECT_EQ(ends(late.until(long_time)), expected);
}

TEST(AccessPointChannel, AFrameKeepsItsNameUntilItsEndIsTaken) {
  Bed bed;
  const auto first = bed.send(0, 0);
  const auto second = bed.send(long_time, 0);  // by now the first one is delivered, but not taken
  EXPECT_NE(first, second);
  EXPECT_EQ(bed.channel.take_services().size(), 2U);
  EXPECT_EQ(bed.send(long_time, 1), first);
}

TEST(AccessPointChannel, AFullStationQueueDropsTheFrame) {
  Bed bed{{.station = 2, .downlink = {}}};
  EXPECT_TRUE(bed.send(0, 0));
  EXPECT_TRUE(bed.send(1, 0));  // the first one is in service and waits no more
  EXPECT_TRUE(bed.send(2, 0));
  EXPECT_FALSE(bed.send(3, 0));
  EXPECT_TRUE(bed.send(4, 1));         // another station, another queue
  EXPECT_FALSE(bed.send(230'000, 0));  // the channel chooses after all requests of its instant
  EXPECT_TRUE(bed.send(230'001, 0));
  const auto& statistics = bed.channel.statistics();
  EXPECT_EQ(statistics.stations[0].dropped, 2U);
  EXPECT_EQ(statistics.stations[0].frames, 6U);
  EXPECT_EQ(statistics.stations[0].deepest_queue, 2U);
  EXPECT_EQ(statistics.stations[1].dropped, 0U);
  EXPECT_EQ(bed.until(long_time).size(), 10U);
}

TEST(AccessPointChannel, AFullDownlinkQueueDropsAfterTheUplink) {
  Bed bed{{.station = {}, .downlink = 1}};
  for (int k = 0; k < 3; ++k) bed.send(k, 0);
  const auto services = bed.until(long_time);
  // All three go up first; the second and the third find the first one waiting.
  EXPECT_EQ(ends(services), (Times{230'000, 460'000, 690'000, 920'000}));
  EXPECT_EQ(services[0].outcome, ServiceEnd::forwarded);
  EXPECT_EQ(services[1].outcome, ServiceEnd::dropped);
  EXPECT_EQ(services[2].outcome, ServiceEnd::dropped);
  EXPECT_EQ(services[3].outcome, ServiceEnd::delivered);
  EXPECT_EQ(bed.channel.statistics().dropped_downlink, 2U);
  EXPECT_EQ(bed.channel.statistics().deepest_downlink_queue, 1U);
}

std::vector<ServiceEnd> outcomes_of_downlinks(const Losses& losses, int frames) {
  Bed bed{{}, losses};
  for (int k = 0; k < frames; ++k) bed.send(k, 0);
  std::vector<ServiceEnd> outcomes;
  for (const Service& service : bed.until(10 * long_time)) {
    if (service.direction == Direction::downlink) outcomes.push_back(service.outcome);
  }
  return outcomes;
}

TEST(AccessPointChannel, ALostFrameTakesItsAirtime) {
  Bed bed{{}, {.probability = 1, .seed = 1}};
  bed.send(0, 0);
  const auto services = bed.until(long_time);
  ASSERT_EQ(ends(services), (Times{230'000, 460'000}));
  EXPECT_EQ(services[1].outcome, ServiceEnd::lost);
  EXPECT_EQ(bed.channel.statistics().lost, 1U);
  EXPECT_EQ(bed.channel.statistics().delivered, 0U);
}

TEST(AccessPointChannel, LosesTheGivenPartAndTheSameWithTheSameSeed) {
  const auto some = outcomes_of_downlinks({.probability = 0.05, .seed = 3}, 10'000);
  const auto lost = std::count(some.begin(), some.end(), ServiceEnd::lost);
  EXPECT_EQ(some.size(), 10'000U);
  EXPECT_NEAR(static_cast<double>(lost), 500, 88);  // four standard deviations
  EXPECT_EQ(some, outcomes_of_downlinks({.probability = 0.05, .seed = 3}, 10'000));
  EXPECT_NE(some, outcomes_of_downlinks({.probability = 0.05, .seed = 4}, 10'000));
  const auto none = outcomes_of_downlinks({.probability = 0, .seed = 3}, 1'000);
  EXPECT_EQ(std::count(none.begin(), none.end(), ServiceEnd::lost), 0);
}

TEST(AccessPointChannel, AccountsForEveryFrameAndNanosecond) {
  Bed bed;
  for (int k = 0; k < 3; ++k) bed.send(k, 0);
  bed.send(3, 1, 750, Cast::multicast);
  bed.until(long_time);
  const ChannelStatistics& statistics = bed.channel.statistics();
  const auto& [up, down] = statistics.served;
  EXPECT_EQ(up[0].frames, 3U);
  EXPECT_EQ(up[0].bytes, 3 * 1444);
  EXPECT_EQ(up[0].busy.count(), 690'000);
  EXPECT_EQ(up[1].busy.count(), 191'551);
  EXPECT_EQ(down[0].busy.count(), 690'000);
  EXPECT_EQ(down[1].frames, 1U);
  EXPECT_EQ(down[1].bytes, 750);
  EXPECT_EQ(down[1].busy.count(), 1'150'000);
  EXPECT_EQ(statistics.delivered, 4U);
  EXPECT_EQ(statistics.stations[0].bytes, 3 * 1444);
  EXPECT_EQ(statistics.deepest_downlink_queue, 4U);
  EXPECT_EQ(statistics.deepest_queue, 4U);
}

TEST(AccessPointChannel, QueuesOfTheProfileDrop) {
  model::WirelessProfile wireless = emulated();
  wireless.service = model::ServedBy::unit;
  wireless.fragment_request = model::FragmentRequest::at_admission;
  wireless.queue =
      model::QueueManagement{model::QueueDiscipline::tail_drop, model::QueuesOf::everybody, 1, {}};
  wireless.aggregation.max_frames = 1;
  Bed bed{{}, {}, wireless};
  EXPECT_TRUE(bed.send(0, 0));
  EXPECT_TRUE(bed.send(0, 0));  // the queue of the station is full
  const std::vector<Service> services = bed.until(long_time);
  ASSERT_EQ(services.size(), 3U);
  EXPECT_EQ(services[0].outcome, ServiceEnd::dropped);
  EXPECT_EQ(services[0].direction, Direction::uplink);
  EXPECT_EQ(services[1].outcome, ServiceEnd::forwarded);
  EXPECT_EQ(services[2].outcome, ServiceEnd::delivered);
  EXPECT_EQ(bed.channel.statistics().stations[0].dropped, 1U);
  EXPECT_EQ(bed.channel.statistics().dropped_downlink, 0U);
  EXPECT_EQ(bed.channel.frames_inside(), 0U);
}

}  // namespace channel_test
}  // namespace stormproof::live
