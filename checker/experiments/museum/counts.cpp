// The claims that count: events of an instant, copies, announcements of a recognition, HEARTBEATs
// that DATA and ACKNACKs cause.
#include <map>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "checker/experiments/museum/claims.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::museum {

namespace {

class Progress final : public ClaimMonitor {
 public:
  Progress() : ClaimMonitor{"timer.progress"} {}

  void event_started(const model::Event& event) override {
    count_ = event.time == now() ? count_ + 1 : 1;
    Observer::event_started(event);
    if (count_ <= most) return;
    object_now(
        fmt::format("{} events happen at {}, and each schedules the next one for the same "
                    "instant.",
                    count_, props::time_text(now())));
  }

 private:
  static constexpr std::uint64_t most = 10'000;
  std::uint64_t count_ = 0;
};

class Copies final : public ClaimMonitor {
 public:
  Copies() : ClaimMonitor{"storm.copy-per-loss"} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    names_.emplace(topology);
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (packet.kind != model::PacketKind::data) return;
    packet.descriptors.for_each([&](std::uint32_t d) {
      Copy& copy = copies_[{packet.relation(), d}];
      ++copy.generated;
      copy.event = event();
      copy.time = now();
    });
  }
  /// A side that was forgotten is served anew.
  void transition(const model::MachineRef& machine, std::string_view event, std::string_view,
                  std::string_view, std::uint32_t, std::uint64_t) override {
    if (event != "Renewed" || machine.kind != model::MachineRef::Kind::relation) return;
    std::erase_if(copies_, [&](const auto& copy) { return copy.first.first == machine.subject; });
  }
  void arrived(const model::Packet& packet, bool lost) override {
    if (packet.kind != model::PacketKind::data || !lost) return;
    packet.descriptors.for_each([&](std::uint32_t d) { ++copies_[{packet.relation(), d}].lost; });
  }
  void finish(model::Nanoseconds) override {
    for (const auto& [what, copy] : copies_) {
      if (copy.generated <= 1 + copy.lost) continue;
      object(
          copy.event, copy.time,
          fmt::format("This is the {}. time that {} is sent; {} of them are lost.", copy.generated,
                      props::descriptor_text(*names_, what.first, what.second), copy.lost));
      return;
    }
  }

 private:
  struct Copy {
    std::uint64_t generated = 0;
    std::uint64_t lost = 0;
    std::uint64_t event = 0;
    model::Nanoseconds time;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Copy> copies_;  // by relation and descriptor
  std::optional<model::Topology> names_;                            // also after the run
};

class Joins final : public ClaimMonitor {
 public:
  Joins() : ClaimMonitor{"storm.join-cost"} {}

  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    recognised_ = sent_ = 0;
  }
  void transition(const model::MachineRef&, std::string_view event, std::string_view,
                  std::string_view, std::uint32_t, std::uint64_t) override {
    if (event == "AnnouncementReceived") ++recognised_;  // one for each stream
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    const bool announces = packet.kind == model::PacketKind::spdp_multicast ||
                           packet.kind == model::PacketKind::spdp_unicast;
    if (announces) sent_ += packet.copies;
  }
  void event_finished(const model::Depths&) override {
    if (recognised_ == 0 || 2 * sent_ <= recognised_) return;
    object_now(fmt::format("{} announcements are sent because {} participant{} recognised.", sent_,
                           recognised_ / 2, recognised_ == 2 ? " is" : "s are"));
  }

 private:
  std::uint64_t recognised_ = 0;
  std::uint64_t sent_ = 0;
};

class Piggybacks final : public ClaimMonitor {
 public:
  explicit Piggybacks(const model::Scenario& scenario)
      : ClaimMonitor{"storm.piggyback-rate"},
        threshold_{static_cast<std::uint64_t>(scenario.dds.sedp.piggyback_threshold_bytes.count())},
        writers_{2 * std::uint64_t{scenario.deployment.size()}} {}

  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (packet.kind != model::PacketKind::data) return;
    bytes_ += packet.payload_bytes;
    rounds_ += packet.heartbeats;
    const std::uint64_t most = (threshold_ == 0 ? bytes_ : bytes_ / threshold_) + writers_;
    if (rounds_ <= most) return;
    object_now(
        fmt::format("{} HEARTBEATs ride in {} bytes of DATA; in proportion to the threshold "
                    "of {} bytes and {} writers there are at most {}.",
                    rounds_, bytes_, threshold_, writers_, most));
  }

 private:
  const std::uint64_t threshold_;
  const std::uint64_t writers_;
  std::uint64_t bytes_ = 0;
  std::uint64_t rounds_ = 0;
};

class Feedback final : public ClaimMonitor {
 public:
  Feedback() : ClaimMonitor{"storm.feedback-gain"} {}

  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    is_acknack_ = changes_ = false;
    heartbeats_ = 0;
  }
  void received(const model::Packet& packet, std::uint32_t) override {
    is_acknack_ = packet.kind == model::PacketKind::acknack && !packet.initial_acknack;
  }
  void transition(const model::MachineRef&, std::string_view event, std::string_view before,
                  std::string_view after, std::uint32_t, std::uint64_t) override {
    changes_ = changes_ || (event == "AckNackReceived" && before != after);
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (packet.kind == model::PacketKind::heartbeat) heartbeats_ += packet.copies;
  }
  void event_finished(const model::Depths&) override {
    if (!is_acknack_ || heartbeats_ <= (changes_ ? 1U : 0U)) return;
    object_now(changes_ ? "One ACKNACK causes more than one HEARTBEAT."
                        : "An ACKNACK that changes nothing is answered by a HEARTBEAT at once, "
                          "which asks for the next ACKNACK.");
  }

 private:
  bool is_acknack_ = false;
  bool changes_ = false;
  std::uint64_t heartbeats_ = 0;
};

}  // namespace

std::unique_ptr<ClaimMonitor> watch_progress() { return std::make_unique<Progress>(); }
std::unique_ptr<ClaimMonitor> watch_copies() { return std::make_unique<Copies>(); }
std::unique_ptr<ClaimMonitor> watch_joins() { return std::make_unique<Joins>(); }
std::unique_ptr<ClaimMonitor> watch_piggybacks(const model::Scenario& scenario) {
  return std::make_unique<Piggybacks>(scenario);
}
std::unique_ptr<ClaimMonitor> watch_feedback() { return std::make_unique<Feedback>(); }

}  // namespace stormproof::museum
