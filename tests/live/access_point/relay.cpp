// Sleeps until shortly before the channel's next event, then polls until it is due.
#include "tests/live/access_point/relay.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <span>

#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>

namespace stormproof::live {

namespace {

/// A sleeping process wakes up late by about this much; the rest of the time is polled.
constexpr Nanoseconds polled{50'000};
/// Frames read from each device before deliveries that are due get their turn.
constexpr int frames_at_once = 32;
/// The largest frame of a TAP device, with room to see that it is larger than expected.
constexpr std::size_t buffer_bytes = 1U << 17U;

/// What the kernel takes for one conversation: of a whole IPv4 datagram its addresses and ports, of
/// a fragment its addresses alone. The sender has a queue of its own anyway.
model::Flow flow_of(std::span<const std::byte> frame, bool group) {
  const auto number = [&](std::size_t at) {
    return std::to_integer<std::uint32_t>(frame[at]) << 8U |
           std::to_integer<std::uint32_t>(frame[at + 1]);
  };
  constexpr std::size_t ip = ethernet_header_bytes;
  constexpr std::uint32_t ipv4 = 0x0800;
  constexpr std::uint32_t more_or_offset = 0x3FFF;
  const model::Flow hosts{.by_host = true, .destination = group ? model::Flow::everybody : 0};
  if (frame.size() < ip + 20 || number(ip - 2) != ipv4) return hosts;
  const std::size_t header = 4 * (std::to_integer<std::size_t>(frame[ip]) & 0xFU);
  const bool fragment = (number(ip + 6) & more_or_offset) != 0;
  if (fragment || frame.size() < ip + header + 4) return hosts;
  return {.source = number(ip + header),
          .destination = number(ip + header + 2),
          .port = group ? 1U : 0U};
}

/// A hardware address as one number; six bytes at this place of an Ethernet frame.
std::uint64_t address_at(const std::vector<std::byte>& frame, std::size_t at) {
  std::uint64_t address = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    address = address << 8U | std::to_integer<std::uint64_t>(frame[at + k]);
  }
  return address;
}

timespec to_timespec(Nanoseconds duration) {
  const std::int64_t ns = duration > Nanoseconds{0} ? duration.count() : 0;
  return {.tv_sec = ns / 1'000'000'000, .tv_nsec = ns % 1'000'000'000};
}

}  // namespace

Relay::Relay(HalfDuplexChannel& channel, const std::vector<TapDevice>& taps)
    : channel_{channel},
      taps_{taps},
      start_{std::chrono::steady_clock::now()},
      buffer_(buffer_bytes) {}

std::optional<std::string> Relay::run(int stop) {
  prctl(PR_SET_TIMERSLACK, 1);  // nanosecond; the default lets the kernel wake us 50 us later
  // The hosts share the processors with their access point; a real one would not wait for them.
  const sched_param priority{.sched_priority = 1};
  statistics_.realtime = sched_setscheduler(0, SCHED_RR, &priority) == 0;
  Wake wake = Wake::work;
  while ((wake = wait(stop)) == Wake::work) {
    read_frames();
    channel_.advance(now());
    deliver();
  }
  statistics_.duration = now();
  statistics_.inside_at_end = channel_.frames_inside();
  if (wake == Wake::stopped) return std::nullopt;
  return "a TAP device has gone (was its network namespace removed?)";
}

Nanoseconds Relay::now() const {
  return Nanoseconds{std::chrono::duration_cast<std::chrono::nanoseconds>(
                         std::chrono::steady_clock::now() - start_)
                         .count()};
}

/// Until there is a frame, or until shortly before something happens in the channel.
Relay::Wake Relay::wait(int stop) {
  std::vector<pollfd> watched;
  for (const TapDevice& tap : taps_) watched.push_back({tap.descriptor(), POLLIN, 0});
  watched.push_back({stop, POLLIN, 0});
  const std::optional<Nanoseconds> due = channel_.next_event();
  const timespec limit = due ? to_timespec(*due - now() - polled) : timespec{};
  if (ppoll(watched.data(), watched.size(), due ? &limit : nullptr, nullptr) <= 0) {
    readable_ = {};
    return Wake::work;
  }
  if (watched.back().revents != 0) return Wake::stopped;
  for (std::size_t station = 0; station < taps_.size(); ++station) {
    if ((watched[station].revents & (POLLERR | POLLNVAL)) != 0) return Wake::tap_gone;
    readable_[station] = (watched[station].revents & POLLIN) != 0;
  }
  return Wake::work;
}

/// Takes turns, so that one station's burst does not stand before all of the others'.
void Relay::read_frames() {
  for (int k = 0; k < frames_at_once && std::ranges::count(readable_, true) > 0; ++k) {
    for (std::uint32_t station = 0; station < taps_.size(); ++station) {
      if (readable_[station]) readable_[station] = read_frame(station);
    }
  }
}

bool Relay::read_frame(std::uint32_t station) {
  const std::optional<std::size_t> bytes = taps_[station].read(buffer_);
  if (!bytes || *bytes < static_cast<std::size_t>(ethernet_header_bytes)) return false;
  // The first bit on the wire of the destination address tells a group from one station.
  const bool group = (buffer_[0] & std::byte{1}) != std::byte{0};
  constexpr std::size_t source = 6;
  stations_[address_at(buffer_, source)] = station;
  const std::optional<std::uint32_t> name = channel_.request(
      now(), {station, static_cast<std::int64_t>(*bytes), group ? Cast::multicast : Cast::unicast,
              flow_of(std::span{buffer_}.first(*bytes), group), receiver_of(group)});
  if (!name) return true;
  if (*name >= contents_.size()) contents_.resize(*name + 1);
  const auto end = buffer_.begin() + static_cast<std::ptrdiff_t>(*bytes);
  contents_[*name].assign(buffer_.begin(), end);
  return true;
}

std::optional<std::uint32_t> Relay::receiver_of(bool group) const {
  const auto found = stations_.find(address_at(buffer_, 0));
  return group || found == stations_.end() ? std::nullopt : std::optional{found->second};
}

void Relay::deliver() {
  for (const Service& service : channel_.take_services()) {
    if (service.outcome != ServiceEnd::delivered) continue;
    statistics_.lateness.add(now() - service.end);
    for (std::uint32_t station = 0; station < taps_.size(); ++station) {
      if (station != service.station && service.receiver.value_or(station) == station) {
        give(station, service);
      }
    }
  }
}

void Relay::give(std::uint32_t receiver, const Service& service) {
  if (!taps_[receiver].write(contents_[service.frame])) ++statistics_.refused[receiver];
}

}  // namespace stormproof::live
