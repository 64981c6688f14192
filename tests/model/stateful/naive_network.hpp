// The model of the network: packets, fragments, source queues and one server for each channel, as
// plain lists that are always searched from the start.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "model/wireless_profile.hpp"
#include "tests/model/stateful/engine_subject.hpp"

namespace stormproof::model::stateful {

enum NetworkCall : std::size_t { emission, next_event };
inline constexpr std::int64_t payloads[] = {68, 420, 1'472, 1'473, 3'000, 6'000};
inline constexpr std::int64_t sources = 3;

struct Setup {
  ServiceKind kind = ServiceKind::shared_channel;
  ServiceOrder order = ServiceOrder::fifo_uplink;
  FragmentRequest request = FragmentRequest::sequential;
  bool two_channels = false;
};

inline std::string network_words(std::int64_t now, const std::string& happened,
                                 std::uint64_t backlog, std::int64_t bytes, std::uint64_t waiting,
                                 std::size_t events) {
  return "at " + std::to_string(now) + happened + "; backlog " + std::to_string(backlog) + ", " +
         std::to_string(bytes) + " B admitted, " + std::to_string(waiting) + " waiting, " +
         std::to_string(events) + " events";
}

class Servers final : public PlainModel<Servers> {
 public:
  Servers(Wrong wrong, Setup setup) : wrong_{wrong}, setup_{setup} {}

  [[nodiscard]] bool possible(const Call& call) const override {
    return call.event == emission || !events_.empty();
  }
  std::string react(const Call& call) override {
    happened_.clear();
    if (call.event == emission) {
      emit(call.payload[0], payloads[call.payload[1]], call.payload[2] == 0);
    } else {
      const auto next = events_.begin();
      const Pending event = next->second;
      now_ = std::get<0>(next->first);
      events_.erase(next);
      process(event);
    }
    std::int64_t bytes = 0;
    for (const auto& [source, sum] : queued_) bytes += sum;
    return network_words(now_, happened_, backlog_.size(), bytes, waiting_.size(), events_.size());
  }

 private:
  enum class What { service_finished, source_completed, received, dispatch };
  struct Pending {
    What what{};
    int channel = 0;
    std::size_t packet = 0;
    int stage = 0;
    std::int64_t fragment = 0;
  };
  struct Sent {
    std::int64_t source = 0;
    std::int64_t payload = 0;
    bool multicast = false;
    [[nodiscard]] std::int64_t fragments() const { return (payload + 8 + 1'479) / 1'480; }
    [[nodiscard]] std::int64_t bytes(std::int64_t k) const {
      return std::min<std::int64_t>(1'480, payload + 8 - 1'480 * k) + 58;
    }
    [[nodiscard]] std::int64_t demand() const { return payload + 8 + 58 * fragments(); }
  };
  struct Waiting {
    std::int64_t time = 0;
    int rank = 0;
    int number = 0;
    Pending service;
  };

  [[nodiscard]] bool is(Wrong wrong) const { return wrong_ == wrong; }
  [[nodiscard]] int channel_of(int stage) const { return setup_.two_channels ? stage : 0; }
  [[nodiscard]] static bool is_lost(std::size_t packet) {
    return packet == 2 || packet == 3 || packet == 7 || packet == 8 || packet == 13 || packet == 20;
  }
  [[nodiscard]] int rank_of(int stage) const {
    if (setup_.order == ServiceOrder::fifo || is(Wrong::rank_ignored)) return 0;
    return setup_.order == ServiceOrder::fifo_downlink ? -stage : stage;
  }
  void schedule(std::int64_t time, int event_class, const Pending& event) {
    events_[{time, event_class, insertions_++}] = event;
  }

  void emit(std::int64_t source, std::int64_t payload, bool multicast) {
    const std::size_t packet = sent_.size();
    sent_.push_back({source, payload, multicast});
    if (setup_.kind == ServiceKind::constant_delay) {
      schedule(now_, 1, {What::source_completed, 0, packet});
      schedule(now_ + 5, 0, {What::received, 0, packet});
      return;
    }
    backlog_.push_back(packet);
    admit(source);
  }
  void admit(std::int64_t source) {
    while (true) {
      const auto head = std::find_if(backlog_.begin(), backlog_.end(), [&](std::size_t packet) {
        return sent_[packet].source == source;
      });
      if (head == backlog_.end()) return;
      const std::size_t packet = *head;
      const std::int64_t demand = sent_[packet].demand();
      const bool full =
          is(Wrong::admits_one_more) ? queued_[source] >= 4'000 : queued_[source] + demand > 4'000;
      if (queued_[source] > 0 && full) return;
      queued_[source] += demand;
      backlog_.erase(head);
      if (setup_.request == FragmentRequest::sequential) {
        request(packet, 0, 0);
      } else {
        request_all(packet, 0);
      }
    }
  }
  void request_all(std::size_t packet, int stage) {
    for (std::int64_t k = 0; k < sent_[packet].fragments(); ++k) request(packet, k, stage);
  }
  void request(std::size_t packet, std::int64_t fragment, int stage) {
    const int channel = channel_of(stage);
    waiting_.push_back({now_,
                        rank_of(stage),
                        requests_++,
                        {What::service_finished, channel, packet, stage, fragment}});
    wake(channel);
  }
  void wake(int channel) {
    if (busy_[channel] || dispatching_[channel]) return;
    dispatching_[channel] = true;
    schedule(now_, 2, {What::dispatch, channel});
  }

  void process(const Pending& event) {
    switch (event.what) {
      case What::dispatch:
        return dispatch(event.channel);
      case What::service_finished:
        return finish(event);
      case What::source_completed:
        happened_ += ", completed " + std::to_string(event.packet);
        return;
      case What::received:
        receive(event.packet);
    }
  }
  void receive(std::size_t packet) {
    if (is_lost(packet) && !is(Wrong::loses_nothing)) return;
    happened_ += ", received " + std::to_string(packet);
  }
  void dispatch(int channel) {
    dispatching_[channel] = false;
    auto best = waiting_.end();
    for (auto w = waiting_.begin(); w != waiting_.end(); ++w) {
      if (w->service.channel != channel) continue;
      const auto key = [](const Waiting& x) { return std::tuple{x.time, x.rank, x.number}; };
      if (best == waiting_.end() || key(*w) < key(*best)) best = w;
    }
    if (busy_[channel] || best == waiting_.end()) return;
    const Pending service = best->service;
    waiting_.erase(best);
    busy_[channel] = !is(Wrong::serves_two_at_once);
    const Sent& packet = sent_[service.packet];
    const bool as_multicast = packet.multicast && service.stage == 1;
    const std::int64_t rate = as_multicast ? 700'000'000'000 : 3'000'000'000'000;
    const std::int64_t half = is(Wrong::airtime_rounded_down) ? 0 : rate / 2;
    const std::int64_t bits = 8 * packet.bytes(service.fragment);
    const std::int64_t airtime = (as_multicast ? 20 : 10) + (bits * 1'000'000'000 + half) / rate;
    schedule(now_ + airtime, 0, service);
  }
  void finish(const Pending& service) {
    busy_[service.channel] = false;
    const std::size_t packet = service.packet;
    const bool last = service.fragment + 1 == sent_[packet].fragments();
    const bool whole = setup_.order == ServiceOrder::datagram_uplink;
    const bool sequential = setup_.request == FragmentRequest::sequential;
    if (service.stage == 0) {
      const auto next = [&] {
        if (!last && sequential) request(packet, service.fragment + 1, 0);
      };
      const auto forward = [&] {
        if (!whole) request(packet, service.fragment, 1);
      };
      if (whole && last) request_all(packet, 1);
      if (is(Wrong::forwards_first)) forward();
      next();
      if (!is(Wrong::forwards_first)) forward();
      if (last) leave(packet);
    } else if (last || is(Wrong::receives_by_fragment)) {
      receive(packet);
    }
    const bool anything = std::any_of(waiting_.begin(), waiting_.end(), [&](const Waiting& w) {
      return w.service.channel == service.channel;
    });
    if (anything) wake(service.channel);
  }
  void leave(std::size_t packet) {
    const std::int64_t source = sent_[packet].source;
    queued_[source] -= sent_[packet].demand();
    if (!is(Wrong::completes_late)) happened_ += ", completed " + std::to_string(packet);
    admit(source);
  }

  Wrong wrong_;
  Setup setup_;
  std::int64_t now_ = 0;
  int insertions_ = 0;
  int requests_ = 0;
  std::string happened_;
  std::vector<Sent> sent_;
  std::vector<std::size_t> backlog_;
  std::map<std::int64_t, std::int64_t> queued_;
  std::vector<Waiting> waiting_;
  std::map<int, bool> busy_;
  std::map<int, bool> dispatching_;
  std::map<std::tuple<std::int64_t, int, int>, Pending> events_;
};

}  // namespace stormproof::model::stateful
