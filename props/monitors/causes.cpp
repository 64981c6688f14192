// What one event may cause: storm.join-cost, announcements for somebody who is recognised;
// storm.piggyback-rate, HEARTBEATs for DATA; storm.feedback-gain, HEARTBEATs for an ACKNACK.
#include <algorithm>
#include <span>

#include <fmt/core.h>

#include "props/monitors/describe.hpp"
#include "props/monitors/event_ends.hpp"
#include "props/monitors/monitors.hpp"

namespace stormproof::props {

namespace {

class Joins : public EndObserver {
 public:
  static constexpr std::array hears_machines{model::Report::reader_transition};
  static constexpr auto selection_of_kinds = model::trace::Selection{}.only(
      {model::Report::emitted},
      {model::PacketKind::spdp_multicast, model::PacketKind::spdp_unicast});

  Joins() : EndObserver{"storm.join-cost"} {}

  void transition(const model::Transition& fired) override {
    // One reader of each stream opens.
    if (fired.before == fired.after || fired.event != "AnnouncementReceived") return;
    ++opened_;
    await_end();
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    const bool announces = packet.kind == model::PacketKind::spdp_multicast ||
                           packet.kind == model::PacketKind::spdp_unicast;
    if (!announces) return;
    sent_ += packet.copies;
    await_end();
  }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("At most {} announcements were sent because of one recognition.", most_)};
  }

 private:
  void judge_event(const model::Depths&) override {
    const std::uint64_t opened = std::exchange(opened_, 0);
    const std::uint64_t sent = std::exchange(sent_, 0);
    if (opened == 0) return;
    most_ = std::max(most_, sent);
    if (2 * sent <= opened) return;
    const std::uint64_t recognised = opened / 2;
    object_now(fmt::format("At {} {} announcements are sent because {} participant{} recognised.",
                           time_text(now()), sent, recognised, recognised == 1 ? " is" : "s are"));
  }

  std::uint64_t opened_ = 0;
  std::uint64_t sent_ = 0;
  std::uint64_t most_ = 0;
};

class Piggybacks : public Observer {
 public:
  static constexpr auto selection_of_kinds =
      model::trace::Selection{}.only({model::Report::emitted}, {model::PacketKind::data});

  explicit Piggybacks(const model::Scenario& scenario)
      : Observer{"storm.piggyback-rate"},
        threshold_{static_cast<std::uint64_t>(scenario.dds.sedp.piggyback_threshold_bytes.count())},
        writers_{2 * std::uint64_t{scenario.deployment.size()}} {}

  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (packet.kind != model::PacketKind::data) return;
    bytes_ += packet.payload_bytes;
    heartbeats_ += packet.heartbeats;
    if (heartbeats_ <= most()) return;
    object_now([&] {
      return fmt::format(
          "Up to {} {} HEARTBEATs ride in {} bytes of DATA; in proportion to the "
          "threshold of {} bytes and {} writers there are at most {}.",
          time_text(now()), heartbeats_, bytes_, threshold_, writers_, most());
    });
  }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("{} HEARTBEATs rode in {} bytes of DATA; at most {} are in proportion.",
                        heartbeats_, bytes_, most())};
  }

 private:
  [[nodiscard]] std::uint64_t most() const {
    return (threshold_ == 0 ? bytes_ : bytes_ / threshold_) + writers_;
  }

  const std::uint64_t threshold_;
  const std::uint64_t writers_;
  std::uint64_t bytes_ = 0;
  std::uint64_t heartbeats_ = 0;
};

class Feedback : public EndObserver {
 public:
  static constexpr std::array hears_machines{model::Report::descriptor_transition};
  static constexpr auto selection_of_kinds =
      model::trace::Selection{}.only({model::Report::emitted}, {model::PacketKind::heartbeat});

  Feedback() : EndObserver{"storm.feedback-gain"} {}

  void received(const model::Packet& packet, std::uint32_t) override {
    is_acknack_ = packet.kind == model::PacketKind::acknack && !packet.initial_acknack;
    if (is_acknack_) await_end();
  }
  void transition(const model::Transition& fired) override {
    if (is_acknack_)
      changes_ = changes_ || (fired.before != fired.after && fired.event == "AckNackReceived");
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (packet.kind != model::PacketKind::heartbeat) return;
    if (std::exchange(counted_in_, event()) != event()) heartbeats_ = 0;
    heartbeats_ += packet.copies;
  }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("The reception of an ACKNACK sent at most {} HEARTBEATs.", most_)};
  }

 private:
  void judge_event(const model::Depths&) override {
    const bool changes = std::exchange(changes_, false);
    const std::uint64_t heartbeats = counted_in_ == event() ? heartbeats_ : 0;
    if (!std::exchange(is_acknack_, false)) return;
    most_ = std::max(most_, heartbeats);
    if (heartbeats <= (changes ? 1U : 0U)) return;
    object_now(changes ? fmt::format("At {} one ACKNACK causes {} HEARTBEATs.", time_text(now()),
                                     heartbeats)
                       : fmt::format("At {} an ACKNACK that changes nothing is answered by a "
                                     "HEARTBEAT at once, which asks for the next ACKNACK.",
                                     time_text(now())));
  }

  bool is_acknack_ = false;
  bool changes_ = false;
  std::uint64_t heartbeats_ = 0;  // of this event
  std::uint64_t counted_in_ = 0;
  std::uint64_t most_ = 0;
};

}  // namespace

MonitorPtr watch_joins(const model::Scenario&) { return attentive<Joins>(); }
MonitorPtr watch_piggybacks(const model::Scenario& scenario) {
  return attentive<Piggybacks>(scenario);
}
MonitorPtr watch_feedback(const model::Scenario& scenario) {
  if (has_samples(scenario)) return watch_directed_heartbeats();
  return attentive<Feedback>();
}

}  // namespace stormproof::props
