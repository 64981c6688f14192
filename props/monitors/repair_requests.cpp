// safety.repair-only-if-asked: DATA that is made as a repair carries only descriptors that some
// ACKNACK listed since they were last generated. What counts is what the writer's participant has
// received after its start; an initial ACKNACK asks for something only if the profile says so.
// Fast DDS: what a creation pushes is initial, everything that the async run sends must be asked
// for, and an ACKNACK asks for its bitmap from its base on. A sender that stalls sends later than
// it has serialized: what is asked for in between is asked for anew.
#include <array>

#include "model/implementations.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"
#include "props/monitors/relation_words.hpp"

namespace stormproof::props {

namespace {

class RepairRequests : public Observer {
 public:
  static constexpr auto selection_of_kinds =
      model::trace::Selection{}
          .only({model::Report::emitted, model::Report::looped_back}, {model::PacketKind::data})
          .only({model::Report::received}, {model::PacketKind::acknack});

  explicit RepairRequests(const model::Scenario& scenario)
      : Observer{"safety.repair-only-if-asked"},
        pushes_at_creation_{model::traits_of(scenario.dds).creates_endpoints_over_time},
        initial_asks_{model::rules_of(scenario.dds).initial_acknack ==
                      model::InitialAckNackReply::bitmap} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    asked_.reset(topology);
  }
  void received(const model::Packet& packet, std::uint32_t) override {
    if (packet.kind != model::PacketKind::acknack) return;
    if (packet.initial_acknack && !initial_asks_) return;
    if (now() < topology().start(topology().pair(packet.pair).source)) return;
    asked_.add(packet.relation(), packet.descriptors);
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    generated(packet);
  }
  void looped_back(const model::Packet& packet, std::uint32_t) override { generated(packet); }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {std::to_string(repairs_) + " descriptors were generated on request."};
  }

 private:
  void generated(const model::Packet& packet) {
    if (packet.kind != model::PacketKind::data) return;
    const bool creates = kind() == model::EventKind::endpoint_creation;
    const bool repair = pushes_at_creation_ ? !creates : packet.from_repair;
    if (repair) {
      repairs_ += packet.descriptors.count();
      const std::uint32_t d = not_asked(packet);
      if (d != UINT32_MAX) {
        object_now("At " + time_text(now()) + " the writer repairs " +
                   descriptor_text(topology(), packet.relation(), d) +
                   ", which no ACKNACK has listed since it was last generated.");
      }
    }
    forget(packet);
  }

  bool pushes_at_creation_;
  bool initial_asks_;
  std::uint64_t repairs_ = 0;

 protected:
  /// A descriptor of the DATA that nobody has asked for; UINT32_MAX if there is none.
  [[nodiscard]] virtual std::uint32_t not_asked(const model::Packet& data) const {
    return asked_.first_of(data.relation(), data.descriptors, false);
  }
  virtual void forget(const model::Packet& data) {
    asked_.remove(data.relation(), data.descriptors);
  }

  RelationWords asked_;
};

/// Of senders that stall.
class StalledRepairRequests : public RepairRequests {
 public:
  static constexpr std::array hears_machines{model::Report::descriptor_transition};

  using RepairRequests::RepairRequests;

  void run_started(const model::Topology& topology) override {
    RepairRequests::run_started(topology);
    serialized_.reset(topology);
  }
  void transition(const model::Transition& fired) override {
    RepairRequests::transition(fired);
    if (fired.event != "Serialized") return;
    std::uint64_t& asked = asked_.word(fired.machine.subject, fired.first_word);
    serialized_.word(fired.machine.subject, fired.first_word) |= asked & fired.descriptors;
    asked &= ~fired.descriptors;
  }

 protected:
  [[nodiscard]] std::uint32_t not_asked(const model::Packet& data) const override {
    return serialized_.first_of(data.relation(), data.descriptors, false);
  }
  void forget(const model::Packet& data) override {
    serialized_.remove(data.relation(), data.descriptors);
  }

 private:
  RelationWords serialized_;  ///< on request, and not sent yet
};

}  // namespace

MonitorPtr watch_repair_requests(const model::Scenario& scenario) {
  if (has_samples(scenario)) return watch_repeated_samples();
  if (scenario.wireless.sender == model::Sender::stalls) {
    return attentive<StalledRepairRequests>(scenario);
  }
  return attentive<RepairRequests>(scenario);
}

}  // namespace stormproof::props
