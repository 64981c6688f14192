// The statistics as text. Their keys are the interface of the scripts that run the live bed.
#include "tests/live/access_point/statistics.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"

namespace stormproof::live {

using Json = nlohmann::ordered_json;

void Lateness::add(Nanoseconds late) {
  const std::int64_t late_ns = std::max<std::int64_t>(late.count(), 0);
  const auto bucket = static_cast<std::size_t>((late_ns + 999) / 1000);
  if (bucket < buckets) {
    if (bucket >= by_microsecond_.size()) by_microsecond_.resize(bucket + 1);
    ++by_microsecond_[bucket];
  }
  ++count_;
  sum_ += Nanoseconds{late_ns};
  max_ = std::max(max_, Nanoseconds{late_ns});
}

Nanoseconds Lateness::mean() const {
  if (count_ == 0) return Nanoseconds{0};
  return Nanoseconds{sum_.count() / static_cast<std::int64_t>(count_)};
}

Nanoseconds Lateness::percentile(int percent) const {
  std::uint64_t covered = 0;
  for (std::size_t k = 0; k < by_microsecond_.size(); ++k) {
    covered += by_microsecond_[k];
    if (covered * 100 >= count_ * static_cast<std::uint64_t>(percent)) {
      return std::min(max_, Nanoseconds{static_cast<std::int64_t>(k) * 1000});
    }
  }
  return max_;
}

namespace {

Json by_direction(const ChannelStatistics& channel, Direction direction) {
  const auto& [unicast, multicast] = channel.served[static_cast<std::size_t>(direction)];
  const auto one = [](const ChannelStatistics::Served& served) {
    return Json{
        {"frames", served.frames}, {"bytes", served.bytes}, {"busy_ns", served.busy.count()}};
  };
  return {{"frames", unicast.frames + multicast.frames},
          {"bytes", unicast.bytes + multicast.bytes},
          {"busy_ns", (unicast.busy + multicast.busy).count()},
          {"unicast", one(unicast)},
          {"multicast", one(multicast)}};
}

Json of_setting(const Setting& setting) {
  const auto limit = [](const std::optional<std::uint64_t>& frames) {
    return frames ? Json(*frames) : Json(nullptr);
  };
  return {{"wireless", model::config::effective_json(setting.wireless)},
          {"loss", setting.losses.probability},
          {"seed", setting.losses.seed},
          {"queue_frames", limit(setting.limits.downlink)},
          {"station_queue_frames", limit(setting.limits.station)}};
}

}  // namespace

std::string to_json(const Setting& setting, const ChannelStatistics& channel,
                    const RelayStatistics& relay) {
  Json json = of_setting(setting);
  json["duration_ns"] = relay.duration.count();
  json["realtime"] = relay.realtime;
  std::uint64_t dropped = 0;
  for (std::size_t k = 0; k < setting.taps.size(); ++k) {
    const ChannelStatistics::Station& station = channel.stations[k];
    dropped += station.dropped;
    json["stations"].push_back({{"tap", setting.taps[k]},
                                {"frames", station.frames},
                                {"bytes", station.bytes},
                                {"dropped", station.dropped},
                                {"deepest_queue", station.deepest_queue},
                                {"refused", relay.refused[k]}});
  }
  json["up"] = by_direction(channel, Direction::uplink);
  json["down"] = by_direction(channel, Direction::downlink);
  json["delivered"] = channel.delivered;
  json["lost"] = channel.lost;
  json["dropped"] = {{"station", dropped},
                     {"access_point", channel.dropped_downlink},
                     {"total", dropped + channel.dropped_downlink}};
  json["deepest_queue"] = {{"access_point", channel.deepest_downlink_queue},
                           {"total", channel.deepest_queue}};
  json["inside_at_end"] = relay.inside_at_end;
  const Lateness& lateness = relay.lateness;
  json["lateness_ns"] = {{"deliveries", lateness.count()},
                         {"mean", lateness.mean().count()},
                         {"p99", lateness.percentile(99).count()},
                         {"max", lateness.max().count()}};
  return json.dump(2) + "\n";
}

}  // namespace stormproof::live
