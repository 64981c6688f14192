// The statistics: lateness, and the keys that scripts read.
#include "tests/live/access_point/statistics.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stormproof::live {
namespace statistics_test {

Lateness of(const std::vector<std::int64_t>& values_ns) {
  Lateness lateness;
  for (const std::int64_t ns : values_ns) lateness.add(Nanoseconds{ns});
  return lateness;
}

TEST(AccessPointLateness, IsZeroWithoutDeliveries) {
  const Lateness none;
  EXPECT_EQ(none.count(), 0U);
  EXPECT_EQ(none.mean().count(), 0);
  EXPECT_EQ(none.percentile(99).count(), 0);
}

TEST(AccessPointLateness, GivesMeanMaximumAndPercentiles) {
  std::vector<std::int64_t> values;
  for (std::int64_t k = 1; k <= 100; ++k) values.push_back(k * 1'000);
  const Lateness lateness = of(values);
  EXPECT_EQ(lateness.mean().count(), 50'500);
  EXPECT_EQ(lateness.max().count(), 100'000);
  EXPECT_EQ(lateness.percentile(50).count(), 50'000);
  EXPECT_EQ(lateness.percentile(99).count(), 99'000);
  EXPECT_EQ(lateness.percentile(100).count(), 100'000);
}

TEST(AccessPointLateness, RoundsUpToMicrosecondsButNotBeyondTheMaximum) {
  EXPECT_EQ(of({1, 1, 5'000}).percentile(50).count(), 1'000);
  EXPECT_EQ(of({1, 1}).percentile(50).count(), 1);
  EXPECT_EQ(of({-5}).max().count(), 0);
}

TEST(AccessPointLateness, KeepsHugeValues) {
  const Lateness lateness = of({1'000, 7'000'000'000});
  EXPECT_EQ(lateness.percentile(99).count(), 7'000'000'000);
  EXPECT_EQ(lateness.percentile(50).count(), 1'000);
}

TEST(AccessPointStatistics, SaysWhatWasServedAndWithWhat) {
  Setting setting{{"left", "right"}, {}, {.station = {}, .downlink = 1'000}, {0.05, 9}};
  setting.wireless.overhead_unicast = Nanoseconds{150'000};
  ChannelStatistics channel;
  channel.served[0][0] = {3, 300, Nanoseconds{450'000}};
  channel.served[0][1] = {1, 60, Nanoseconds{150'000}};
  channel.served[1][1] = {1, 60, Nanoseconds{230'000}};
  channel.stations[1].dropped = 4;
  channel.dropped_downlink = 2;
  channel.lost = 1;
  RelayStatistics relay;
  relay.lateness = of({2'000});
  relay.refused = {0, 5};
  relay.realtime = true;
  const auto json = nlohmann::json::parse(to_json(setting, channel, relay));
  EXPECT_EQ(json["wireless"]["overhead_unicast"], "150us");
  EXPECT_EQ(json["queue_frames"], 1'000);
  EXPECT_TRUE(json["station_queue_frames"].is_null());
  EXPECT_EQ(json["loss"], 0.05);
  EXPECT_EQ(json["stations"][0]["tap"], "left");
  EXPECT_EQ(json["stations"][1]["refused"], 5);
  EXPECT_EQ(json["realtime"], true);
  EXPECT_EQ(json["up"]["frames"], 4);
  EXPECT_EQ(json["up"]["busy_ns"], 600'000);
  EXPECT_EQ(json["up"]["unicast"]["bytes"], 300);
  EXPECT_EQ(json["down"]["multicast"]["busy_ns"], 230'000);
  EXPECT_EQ(json["dropped"]["station"], 4);
  EXPECT_EQ(json["dropped"]["total"], 6);
  EXPECT_EQ(json["lost"], 1);
  EXPECT_EQ(json["lateness_ns"]["max"], 2'000);
}

}  // namespace statistics_test
}  // namespace stormproof::live
