// Laws of accounting: every total of a result is the sum of what an observer saw happen.
#include <array>
#include <map>
#include <set>
#include <tuple>

#include <fmt/core.h>

#include "model/cyclone/endpoints.hpp"
#include "model/engine/submessage.hpp"
#include "props/laws/families.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/received_descriptors.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;
using model::Packet;
using model::PacketKind;
using model::Scenario;
using Broken = std::optional<std::string>;

Broken unequal(std::string_view what, std::uint64_t happened, std::uint64_t reported) {
  if (happened == reported) return std::nullopt;
  return fmt::format("{}: {} happened, {} are reported.", what, happened, reported);
}

/// Counts messages at their emission.
class MessageCounter final : public model::Probe {
 public:
  void run_started(const model::Topology& topology) override { generated_.reset(topology); }
  void emitted(const Packet& packet, std::uint32_t, std::span<const std::uint32_t>) override {
    switch (packet.kind) {
      case PacketKind::spdp_multicast:
        ++counts_.spdp_multicast;
        break;
      case PacketKind::spdp_unicast:
        counts_.spdp_unicast += packet.copies;
        break;
      case PacketKind::data:
        add_data(packet);
        break;
      case PacketKind::heartbeat:  // several may share a message without DATA
        counts_.heartbeat += std::max<std::uint64_t>(packet.copies, packet.heartbeats);
        break;
      case PacketKind::acknack:
        counts_.acknack += packet.copies;
        break;
      case PacketKind::user_heartbeat:
      case PacketKind::user_acknack:
        ++user_control_;
        break;
      case PacketKind::lookup:
        counts_.lookup += packet.samples();
        user_control_ += packet.heartbeats;
        break;
      case PacketKind::rtps_message:
        for (const model::Submessage& each : *packet.submessages) add(each, packet);
        break;
      case PacketKind::registration:
      case PacketKind::registration_heartbeat:
      case PacketKind::registration_acknack:
      case PacketKind::relayed:
      case PacketKind::relayed_acknack:
        break;  // the law is not about servers
    }
  }
  [[nodiscard]] const model::Counts& counts() const { return counts_; }
  [[nodiscard]] std::uint64_t user_control() const { return user_control_; }

 private:
  /// Of what is not about the two streams only the number counts. DATA is new to a participant, or
  /// to the group, once.
  void add(const model::Submessage& submessage, const Packet& packet) {
    using Kind = model::Submessage::Kind;
    if (submessage.kind == Kind::spdp) {
      ++(packet.to_group ? counts_.spdp_multicast : counts_.spdp_unicast);
    } else if (submessage.writer > model::cyclone::writer::subscriptions) {
      ++user_control_;
    } else if (submessage.kind == Kind::heartbeat) {
      ++counts_.heartbeat;
    } else if (submessage.kind == Kind::gap) {
      ++counts_.gap;
    } else if (submessage.kind == Kind::acknack) {
      ++counts_.acknack;
    } else {
      const Sample sample{packet.to_group, packet.pair, submessage.writer, submessage.sample};
      ++(samples_.insert(sample).second ? counts_.initial_data : counts_.repair_data);
    }
  }
  void add_data(const Packet& packet) {
    counts_.heartbeat += packet.heartbeats;
    packet.descriptors.for_each([&](std::uint32_t d) {
      const bool again = generated_.test(packet.relation(), d);
      ++(again ? counts_.repair_data : counts_.initial_data);
    });
    generated_.add(packet.relation(), packet.descriptors);
  }

  model::Counts counts_;
  std::uint64_t user_control_ = 0;
  RelationWords generated_;
  using Sample = std::tuple<bool, std::uint32_t, std::uint32_t, std::uint32_t>;
  std::set<Sample> samples_;  // sent to a pair, or by a participant to the group
};

Broken counts(const Scenario& scenario, const Simulate& simulate) {
  MessageCounter counter;
  const model::RunResult result = simulate(scenario, &counter);
  const auto happened = counter.counts().entries();
  for (std::size_t k = 0; k < happened.size(); ++k) {
    const model::Counts::Entry reported = result.counts.entries()[k];
    if (Broken wrong = unequal(reported.name, happened[k].value, reported.value)) return wrong;
  }
  if (Broken wrong = unequal("lookup", counter.counts().lookup, result.counts.lookup)) return wrong;
  return unequal("user_control", counter.user_control(), result.user_control);
}

/// Counts descriptors at their reception, and notes when none is missing any more.
class DeliveryCounter final : public model::Probe {
 public:
  explicit DeliveryCounter(const Scenario& scenario) : scenario_{scenario} {}

  void run_started(const model::Topology& topology) override {
    topology_ = &topology;
    received_.reset(topology);
    missing_ = topology.required_deliveries();
    if (missing_ == 0) complete_ = now_;
  }
  void event_started(const model::Event& event) override {
    now_ = event.time;
    ++events_;
  }
  void received(const Packet& packet, std::uint32_t) override {
    received_.arriving(packet);
    if (packet.kind != PacketKind::data || !crosses(packet)) return;
    const std::uint32_t receiver = topology_->pair(packet.pair).destination;
    if (now_ < scenario_.deployment.participants[receiver].start) return;
    packet.descriptors.for_each([&](std::uint32_t d) {
      if (received_.words().test(packet.relation(), d)) ++repeated_;
    });
  }
  void transition(const model::Transition& fired) override {
    const Packet* data = received_.taken(fired.machine, fired.event);
    if (data == nullptr) return;
    if (crosses(*data)) {
      data->descriptors.for_each([&](std::uint32_t d) {
        if (received_.words().test(data->relation(), d)) return;
        ++fresh_;
        if (--missing_ == 0) complete_ = now_;
      });
    }
    received_.take(*data);
  }

  [[nodiscard]] Broken against(const model::RunResult& result) const {
    if (Broken wrong = unequal("useful deliveries", fresh_, result.useful_deliveries)) return wrong;
    if (Broken wrong = unequal("duplicate deliveries", repeated_, result.duplicate_deliveries)) {
      return wrong;
    }
    if (Broken wrong = unequal("events", events_, result.events)) return wrong;
    if (scenario_.deployment.types) return against_waiting(result);
    if (Broken wrong = unequal("missing descriptors", missing_, result.missing_count)) return wrong;
    if (complete_ != result.discovery_time) {
      return fmt::format("The last missing descriptor arrives {}, but T_disc is {}.",
                         complete_ ? "at " + time_text(*complete_) : "never",
                         result.discovery_time ? time_text(*result.discovery_time) : "unknown");
    }
    return against_end(result);
  }

 private:
  /// What has arrived may still be missing, as it waits for its type.
  [[nodiscard]] Broken against_waiting(const model::RunResult& result) const {
    if (missing_ > result.missing_count) {
      return fmt::format("{} descriptors have not arrived, but {} are missing.", missing_,
                         result.missing_count);
    }
    const bool is_late = complete_ && result.discovery_time >= complete_;
    if (result.discovery_time && !is_late) {
      return fmt::format("T_disc is {}, and the last missing descriptor arrives {}.",
                         time_text(*result.discovery_time),
                         complete_ ? "at " + time_text(*complete_) : "never");
    }
    return against_end(result);
  }
  [[nodiscard]] Broken against_end(const model::RunResult& result) const {
    if (events_ == 0 || now_ == result.end_time) return std::nullopt;
    return fmt::format("The last event is at {}, but the run ends at {}.", time_text(now_),
                       time_text(result.end_time));
  }
  [[nodiscard]] bool crosses(const Packet& packet) const {
    return topology_->pair(packet.pair).cross_host;
  }

  const Scenario& scenario_;
  const model::Topology* topology_ = nullptr;
  ReceivedDescriptors received_;
  Nanoseconds now_;
  std::optional<Nanoseconds> complete_;
  std::uint64_t missing_ = 0;
  std::uint64_t fresh_ = 0;
  std::uint64_t repeated_ = 0;
  std::uint64_t events_ = 0;
};

Broken deliveries(const Scenario& scenario, const Simulate& simulate) {
  DeliveryCounter counter{scenario};
  const model::RunResult result = simulate(scenario, &counter);
  return counter.against(result);
}

/// Adds up airtimes by channel and class.
class AirtimeCounter final : public model::Probe {
 public:
  struct Service {
    Nanoseconds from;
    Nanoseconds until;
    std::uint32_t channel = 0;
    model::TrafficClass traffic{};
  };

  void event_started(const model::Event& event) override { now_ = event.time; }
  void service_started(std::uint32_t channel, std::uint32_t, const Packet& packet, std::uint32_t,
                       Nanoseconds until) override {
    services_.push_back({now_, until, channel, traffic_class(packet)});
  }
  [[nodiscard]] const std::vector<Service>& services() const { return services_; }

 private:
  Nanoseconds now_;
  std::vector<Service> services_;
};

Broken channel_use(const Scenario& scenario, const Simulate& simulate) {
  AirtimeCounter counter;
  const model::RunResult result = simulate(scenario, &counter);
  std::vector<model::ChannelUse> sums(result.channels.size());
  for (const AirtimeCounter::Service& service : counter.services()) {
    if (service.channel >= sums.size()) return "A channel that is not in the result was busy.";
    sums[service.channel].busy[static_cast<std::size_t>(service.traffic)] +=
        std::min(service.until, result.end_time) - service.from;
  }
  for (std::size_t c = 0; c < sums.size(); ++c) {
    const model::ChannelUse& reported = result.channels[c];
    if (sums[c].busy != reported.busy) {
      return fmt::format("Channel {} served for {}, but {} is reported.", c,
                         time_text(sums[c].total_busy()), time_text(reported.total_busy()));
    }
    if (reported.total_busy() > result.end_time) {
      return fmt::format("Channel {} was busy for {} in a run of {}.", c,
                         time_text(reported.total_busy()), time_text(result.end_time));
    }
  }
  return std::nullopt;
}

/// Adds up the delays of received packets by class.
class DelayCounter final : public model::Probe {
 public:
  void event_started(const model::Event& event) override { now_ = event.time; }
  void arrived(const Packet& packet, bool lost) override {
    if (lost) return;
    model::Latency& latency = sums_[static_cast<std::size_t>(traffic_class(packet))];
    ++latency.packets;
    latency.service_sum += now_ - packet.emitted;  // the backlog included
    latency.longest = std::max(latency.longest, now_ - packet.emitted);
  }
  void backlog_changed(std::uint32_t participant, std::uint64_t packets, std::int64_t) override {
    model::BacklogPeak& peak = peaks_[participant];
    if (packets > peak.packets) peak.packets = packets;
    peak.packets_at_end = packets;
  }

  [[nodiscard]] Broken against(const model::RunResult& result) const {
    for (std::size_t k = 0; k < sums_.size(); ++k) {
      const model::Latency& reported = result.latency[k];
      const char* name = name_of(static_cast<model::TrafficClass>(k));
      if (Broken wrong = unequal(name, sums_[k].packets, reported.packets)) return wrong;
      if (sums_[k].service_sum == reported.backlog_sum + reported.service_sum &&
          sums_[k].longest == reported.longest) {
        continue;
      }
      return fmt::format("{}: packets were under way for {}, but {} is reported.", name,
                         time_text(sums_[k].service_sum),
                         time_text(reported.backlog_sum + reported.service_sum));
    }
    for (const auto& [participant, peak] : peaks_) {
      const model::BacklogPeak& reported = result.backlog[participant];
      if (Broken wrong = unequal("highest backlog", peak.packets, reported.packets)) return wrong;
      if (Broken wrong =
              unequal("backlog at the end", peak.packets_at_end, reported.packets_at_end)) {
        return wrong;
      }
    }
    return std::nullopt;
  }

 private:
  Nanoseconds now_;
  std::array<model::Latency, model::traffic_class_count> sums_{};
  std::map<std::uint32_t, model::BacklogPeak> peaks_;
};

/// With a constant delay and separate receptions packets have no arrival.
bool has_arrivals(const Scenario& scenario) {
  return is_shared(scenario) || !traits_of(scenario).receives_separately;
}

Broken delays(const Scenario& scenario, const Simulate& simulate) {
  DelayCounter counter;
  const model::RunResult result = simulate(scenario, &counter);
  return counter.against(result);
}

constexpr Law accounting_list[] = {
    {"law.counts", "Each count is the number of messages, or descriptors in DATA, emitted.",
     is_of_three_writers, counts},
    {"law.deliveries",
     "Useful and duplicate deliveries, missing descriptors, T_disc and the end are what the "
     "receptions add up to.",
     is_of_two_writers, deliveries},
    {"law.channel-use",
     "The busy time of a channel is the sum of its airtimes, by class, and at most the run.",
     is_shared, channel_use},
    {"law.delays", "Delays of received packets and highest backlogs are those observed.",
     has_arrivals, delays},
};

}  // namespace

std::span<const Law> accounting_laws() { return accounting_list; }

}  // namespace stormproof::props
