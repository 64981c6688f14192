// Listed hosts: who is a station of which access point, who is on the cable, who sleeps; and
// transmissions that fail. Every question is answered by reading the deployment's lists again.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

const model::Host* entry_of(const World& w, Id host) {
  const std::vector<model::Host>& all = w.scenario.deployment.hosts;
  return host < all.size() ? &all.at(host) : nullptr;
}

/// The first time from now on that is a multiple of the interval.
Time next_beacon(Time now, Time interval) {
  Time beacon = now / interval * interval;
  while (beacon < now) beacon += interval;
  return beacon;
}

Time wakes(const World& w, Id host) {
  const model::Host* entry = entry_of(w, host);
  if (entry == nullptr || !entry->power_save || w.makes(WifiMistake::nobody_sleeps)) return w.now;
  return next_beacon(w.now, entry->power_save->beacon_interval.count());
}

Time all_wake(const World& w, const std::string& access_point) {
  Time latest = w.now;
  for (Id host = 0; host < w.scenario.deployment.hosts.size(); ++host) {
    const model::Host& entry = *entry_of(w, host);
    if (!entry.power_save || !is_station(w, host, access_point)) continue;
    const Time interval = entry.power_save->beacon_interval.count();
    const Time every = w.makes(WifiMistake::dtim_ignored) ? 1 : entry.power_save->dtim;
    latest = std::max(latest, next_beacon(w.now, interval * every));
  }
  return latest;
}

void send_down(World& w, const Packet& packet, std::size_t fragment,
               const std::string& access_point, Time when) {
  if (when == w.now) return request_frame(w, packet, fragment, 1, access_point);
  auto& waiting = w.asleep[{access_point, when}];
  if (waiting.empty()) {
    Event event;
    event.kind = EventKind::beacon;
    event.access_point = access_point;
    schedule(w, when, EventClass::service, event);
  }
  waiting.emplace_back(packet.id, fragment);
}

bool happens(World& w, const model::Ratio& probability) {
  const std::uint64_t drawn = w.random();
  return drawn % static_cast<std::uint64_t>(probability.denominator) <
         static_cast<std::uint64_t>(probability.numerator);
}

}  // namespace

bool over_access_points(const World& w) {
  return !w.scenario.deployment.hosts.empty() || w.scenario.wireless.loss.has_value() ||
         w.scenario.wireless.service == model::ServedBy::unit;
}

bool is_wired(const World& w, Id host) {
  const model::Host* entry = entry_of(w, host);
  return entry != nullptr && entry->link == model::Link::wired;
}

Id host_total(const World& w) {
  auto total = static_cast<Id>(w.scenario.deployment.hosts.size());
  for (const Participant& p : w.participants) total = std::max(total, p.host + 1);
  return total;
}

std::vector<std::string> access_points(const World& w) {
  std::vector<std::string> names;
  for (const model::AccessPoint& one : w.scenario.deployment.access_points) {
    names.push_back(one.name);
  }
  if (names.empty()) names.emplace_back();
  return names;
}

std::string access_point_of(const World& w, Id host) {
  const model::Host* entry = entry_of(w, host);
  const std::string first = access_points(w).front();
  return entry == nullptr ? first : entry->access_point.value_or(first);
}

std::string radio_of(const World& w, const std::string& access_point) {
  if (w.makes(WifiMistake::one_channel)) return {};
  for (const model::AccessPoint& one : w.scenario.deployment.access_points) {
    if (one.name == access_point) return one.channel;
  }
  return {};
}

bool is_station(const World& w, Id host, const std::string& access_point) {
  return !is_wired(w, host) && access_point_of(w, host) == access_point;
}

std::int64_t rate_of(const World& w, Id host, std::int64_t usual) {
  const model::Host* entry = entry_of(w, host);
  if (entry == nullptr || !entry->rate || w.makes(WifiMistake::equal_rates)) return usual;
  return entry->rate->count();
}

bool transmission_fails(World& w, Id host) {
  const model::FrameLoss& loss = *w.scenario.wireless.loss;
  if (!loss.bursts || w.makes(WifiMistake::no_bursts)) return happens(w, loss.probability);
  bool& worse = w.worse[host];
  if (worse && happens(w, loss.bursts->end)) {
    worse = false;
  } else if (!worse && happens(w, loss.bursts->begin)) {
    worse = true;
  }
  return happens(w, worse ? loss.bursts->probability : loss.probability);
}

std::vector<Id> deaf_to_multicast(World& w, const Packet& packet, const std::string& access_point) {
  std::vector<Id> deaf;
  for (Id host = 0; host < host_total(w); ++host) {
    if (!is_station(w, host, access_point) || host == w.participants.at(packet.source).host) {
      continue;
    }
    if (transmission_fails(w, host)) deaf.push_back(host);
  }
  return deaf;
}

void distribute(World& w, std::uint64_t id, std::size_t fragment) {
  const Packet packet = w.packets.at(id);
  const bool last = fragment + 1 == packet.fragments.size();
  if (!packet.destination) {
    for (const std::string& access_point : access_points(w)) {
      send_down(w, packet, fragment, access_point, all_wake(w, access_point));
      if (w.makes(WifiMistake::multicast_at_first_only)) break;
    }
    if (last) arrive_on_cable(w, w.packets.at(id));
    return;
  }
  const Id host = w.participants.at(*packet.destination).host;
  if (!is_wired(w, host)) {
    send_down(w, packet, fragment, access_point_of(w, host), wakes(w, host));
  } else if (last) {
    arrive_on_cable(w, w.packets.at(id));
  }
}

void distribution(World& w, std::uint64_t id) {
  for (std::size_t k = 0; k < w.packets.at(id).fragments.size(); ++k) distribute(w, id, k);
}

void beacon(World& w, const std::string& access_point) {
  const auto waiting = w.asleep[{access_point, w.now}];
  w.asleep.erase({access_point, w.now});
  for (const auto& [id, fragment] : waiting) {
    request_frame(w, w.packets.at(id), fragment, 1, access_point);
  }
}

}  // namespace stormproof::oracle::fastdds
