// limit.completion, limit.messages, limit.amplification, limit.backlog, limit.time: what the author
// of a scenario demands of discovery. The monitors count as reports do: a DATA packet is a message
// for each of its descriptors, a HEARTBEAT that rides in it is one more, a record of several copies
// is as many messages, and control-only relations are in no class (model/counts.hpp). They look at
// a run until discovery is complete.
#include "props/limits.hpp"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "model/cyclone/endpoints.hpp"
#include "model/engine/submessage.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/reference.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::props {

namespace {

const std::array limits_as_properties{
    Property{.id = "limit.completion",
             .statement =
                 "Discovery is complete at the time that the scenario's limits.completion gives.",
             .formal = "T_disc ≤ limits.completion",
             .engines = {Engine::exact_run},
             .source = "limits of the scenario",
             .about = Vocabulary::everything},
    Property{.id = "limit.messages",
             .statement = "Until discovery is complete, at most limits.messages messages of the "
                          "six classes are generated.",
             .formal = "total messages ≤ limits.messages",
             .engines = {Engine::exact_run},
             .source = "limits of the scenario",
             .about = Vocabulary::everything},
    Property{.id = "limit.amplification",
             .statement = "Until discovery is complete, at most limits.amplification times the "
                          "messages of the failure-free reference are generated.",
             .formal = "total messages ≤ limits.amplification · failure-free total",
             .engines = {Engine::exact_run},
             .source = "limits of the scenario",
             .about = Vocabulary::everything},
    Property{.id = "limit.backlog",
             .statement = "Until discovery is complete, at most limits.backlog packets of one "
                          "participant wait for its source queue.",
             .formal = "∀ participant, t ≤ T_disc: backlog(t) ≤ limits.backlog",
             .engines = {Engine::exact_run},
             .source = "limits of the scenario",
             .about = Vocabulary::everything},
    Property{.id = "limit.time",
             .statement = "Discovery is complete when the scenario's time_limit has passed.",
             .formal = "T_disc ≤ time_limit",
             .engines = {Engine::exact_run},
             .source = "time_limit of the scenario",
             .about = Vocabulary::everything},
};

std::uint64_t messages_of(const model::Packet& packet) {
  std::uint64_t messages = 0;
  switch (packet.kind) {
    case model::PacketKind::user_heartbeat:
    case model::PacketKind::user_acknack:
    case model::PacketKind::lookup:
      return 0;
    case model::PacketKind::data:
      packet.descriptors.for_each([&](std::uint32_t) { ++messages; });
      return messages + packet.heartbeats;
    case model::PacketKind::heartbeat:
      return packet.copies * std::max<std::uint64_t>(1, packet.heartbeats);
    case model::PacketKind::spdp_multicast:
    case model::PacketKind::spdp_unicast:
    case model::PacketKind::acknack:
      return packet.copies;
    case model::PacketKind::registration:
    case model::PacketKind::registration_heartbeat:
    case model::PacketKind::registration_acknack:
    case model::PacketKind::relayed_acknack:
      return packet.copies;
    case model::PacketKind::relayed:
      if (packet.relayed->has_data) ++messages;
      return messages + (packet.relayed->has_heartbeat ? 1 : 0);
    case model::PacketKind::rtps_message:
      for (const model::Submessage& m : *packet.submessages) {
        if (m.writer <= model::cyclone::writer::subscriptions) ++messages;
      }
      break;
  }
  return messages;
}

/// ⌊value · ratio⌋, without an intermediate product that could overflow.
std::uint64_t scaled(std::uint64_t value, const model::Ratio& ratio) {
  const auto numerator = static_cast<std::uint64_t>(ratio.numerator);
  const auto denominator = static_cast<std::uint64_t>(ratio.denominator);
  return value / denominator * numerator + value % denominator * numerator / denominator;
}

/// Notes when discovery is complete, for all limits of the run.
class CompletionNote final : public model::Probe {
 public:
  void join(model::Company& company) override { clock_ = company.clock; }
  [[nodiscard]] bool gathers_as(const CompletionNote&) const { return true; }
  [[nodiscard]] model::Reports reports() const override {
    model::Reports reports;
    reports.set(model::Report::event_finished);
    return reports;
  }
  void run_started(const model::Topology& topology) override {
    if (topology.required_deliveries() == 0) completed_ = model::Nanoseconds{0};
  }
  void event_finished(const model::Depths& depths) override { note(depths, clock_->now); }
  void note(const model::Depths& depths, model::Nanoseconds now) {
    if (depths.missing == 0 && !completed_) completed_ = now;
  }

  [[nodiscard]] const std::optional<model::Nanoseconds>& completed() const { return completed_; }

 private:
  std::shared_ptr<const model::RunClock> clock_;
  std::optional<model::Nanoseconds> completed_;
};

class LimitMonitor : public Observer {
 public:
  using Feeder = LimitMonitor;
  using Observer::Observer;

  void join(model::Company& company) override {
    Observer::join(company);
    note_ = company.gatherer_like(note_);
  }
  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    if (is_alone()) note_->run_started(topology);
  }
  void event_finished(const model::Depths& depths) override {
    if (is_alone()) note_->note(depths, now());
  }
  [[nodiscard]] virtual LimitReading reading() const = 0;

 protected:
  [[nodiscard]] const std::optional<model::Nanoseconds>& completed() const {
    return note_->completed();
  }

 private:
  std::shared_ptr<CompletionNote> note_ = std::make_shared<CompletionNote>();
};

class CompletionLimit : public LimitMonitor {
 public:
  CompletionLimit(std::string_view id, model::Nanoseconds limit)
      : LimitMonitor{id}, limit_{limit} {}

  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    if (!completed() && now() > limit_ && !violation()) {
      object_now(fmt::format("At {} discovery is not complete; the limit is {}.", time_text(now()),
                             time_text(limit_)));
    }
  }
  void finish(model::Nanoseconds end) override {
    if (completed() || end < limit_) return;
    object(event(), now(),
           fmt::format("Discovery is not complete when the run ends at {}; the limit is {}.",
                       time_text(end), time_text(limit_)));
  }
  [[nodiscard]] LimitReading reading() const override {
    LimitReading reading{property(), static_cast<double>(limit_.count()), {}, !!violation()};
    if (completed()) reading.reached = static_cast<double>(completed()->count());
    return reading;
  }

 private:
  model::Nanoseconds limit_;
};

/// Of messages, absolute or relative to the failure-free reference.
class MessageLimit : public LimitMonitor {
 public:
  explicit MessageLimit(std::uint64_t limit)
      : LimitMonitor{"limit.messages"},
        most_{limit},
        limit_text_{fmt::format("{}", limit)},
        limit_{static_cast<double>(limit)} {}
  MessageLimit(const model::Ratio& limit, std::uint64_t reference)
      : LimitMonitor{"limit.amplification"},
        reference_{reference},
        most_{scaled(reference, limit)},
        limit_text_{fmt::format("{}, {} times the {} of the failure-free reference", most_,
                                limit.value(), reference)},
        limit_{limit.value()} {}

  /// The first one too many is what it tells of.
  [[nodiscard]] bool wants_single_packets() const override { return true; }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (completed()) return;
    messages_ += messages_of(packet);
    if (messages_ <= most_ || violation()) return;
    object_now(fmt::format("At {} {} messages have been generated; the limit is {}.",
                           time_text(now()), messages_, limit_text_));
  }
  [[nodiscard]] LimitReading reading() const override {
    const double reached = static_cast<double>(messages_) / static_cast<double>(reference_);
    return {property(), limit_, reached, !!violation()};
  }

 private:
  std::uint64_t reference_ = 1;
  std::uint64_t most_;
  std::string limit_text_;
  double limit_;
  std::uint64_t messages_ = 0;
};

class BacklogLimit : public LimitMonitor {
 public:
  explicit BacklogLimit(std::uint64_t limit) : LimitMonitor{"limit.backlog"}, limit_{limit} {}

  [[nodiscard]] bool wants_single_packets() const override { return true; }
  void backlog_changed(std::uint32_t participant, std::uint64_t packets, std::int64_t) override {
    if (completed() || packets <= highest_) return;
    highest_ = packets;
    if (packets <= limit_ || violation()) return;
    object_now(fmt::format(
        "At {} {} packets of participant {} wait for its source queue; the limit is {}.",
        time_text(now()), packets, participant, limit_));
  }
  [[nodiscard]] LimitReading reading() const override {
    return {property(), static_cast<double>(limit_), static_cast<double>(highest_), !!violation()};
  }

 private:
  std::uint64_t limit_;
  std::uint64_t highest_ = 0;
};

std::unique_ptr<LimitMonitor> make_limit_monitor(std::string_view id,
                                                 const model::Scenario& scenario) {
  if (id == "limit.time") return attentive<CompletionLimit>(id, scenario.time_limit);
  if (!scenario.limits) return nullptr;
  const model::Limits& limits = *scenario.limits;
  if (id == "limit.completion" && limits.completion) {
    return attentive<CompletionLimit>(id, *limits.completion);
  }
  if (id == "limit.messages" && limits.messages) {
    return attentive<MessageLimit>(*limits.messages);
  }
  if (id == "limit.amplification" && limits.amplification) {
    return attentive<MessageLimit>(*limits.amplification,
                                   model::failure_free_reference(scenario).total());
  }
  if (id == "limit.backlog" && limits.backlog) {
    return attentive<BacklogLimit>(*limits.backlog);
  }
  return nullptr;
}

}  // namespace

std::span<const Property> limit_properties() { return limits_as_properties; }

std::vector<std::string_view> set_limits(const std::optional<model::Limits>& limits) {
  std::vector<std::string_view> ids;
  if (!limits) return ids;
  const bool set[] = {limits->completion.has_value(), limits->messages.has_value(),
                      limits->amplification.has_value(), limits->backlog.has_value()};
  for (std::size_t k = 0; k < std::size(set); ++k) {
    if (set[k]) ids.push_back(limits_as_properties[k].id);
  }
  return ids;
}

std::vector<std::string_view> limits_of(const model::Scenario& scenario) {
  std::vector<std::string_view> ids = set_limits(scenario.limits);
  ids.push_back(limits_as_properties.back().id);
  return ids;
}

MonitorPtr watch_limit(std::string_view id, const model::Scenario& scenario) {
  return make_limit_monitor(id, scenario);
}

class LimitWatch::Monitors {
 public:
  std::vector<std::unique_ptr<LimitMonitor>> list;
};

LimitWatch::LimitWatch(const model::Scenario& scenario) : monitors_{std::make_unique<Monitors>()} {
  for (const std::string_view id : set_limits(scenario.limits)) {
    monitors_->list.push_back(make_limit_monitor(id, scenario));
  }
}

LimitWatch::~LimitWatch() = default;

std::vector<model::Probe*> LimitWatch::probes() {
  std::vector<model::Probe*> probes;
  for (const auto& monitor : monitors_->list) probes.push_back(monitor.get());
  return probes;
}

std::vector<LimitReading> LimitWatch::finish(model::Nanoseconds end) {
  std::vector<LimitReading> readings;
  for (const auto& monitor : monitors_->list) {
    monitor->finish(end);
    readings.push_back(monitor->reading());
  }
  return readings;
}

}  // namespace stormproof::props
