// timer.suppression-honoured: no descriptor leaves S for U earlier than τ_S after its own repair
// left the source (the source completion of the packet that carries it). Fast DDS: earlier than τ_S
// after its own serialization, which is when the DATA is emitted.
//
// Neither implementation keeps it in general: the end of a suppression concerns the relation, not a
// packet. A repair batch that spans packets (paper), or a descriptor that is serialized while the
// suppression of an earlier one runs (Fast DDS), is open to requests again too early.
#include <algorithm>
#include <optional>

#include "model/engine/profiles.hpp"
#include "model/implementations.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"
#include "props/monitors/relation_words.hpp"

namespace stormproof::props {

namespace {

class Suppression : public Observer {
 public:
  static constexpr std::array hears_machines{model::Report::descriptor_transition};
  static constexpr auto selection_of_kinds = model::trace::Selection{}.only(
      {model::Report::emitted, model::Report::looped_back, model::Report::source_completed},
      {model::PacketKind::data});

  explicit Suppression(const model::Scenario& scenario)
      : Observer{"timer.suppression-honoured"},
        waits_{model::traits_of(scenario.dds).waits_for_source},
        profiles_{scenario} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    left_.reset(topology, never);
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (packet.kind != model::PacketKind::data) return;
    if (!waits_) note(packet, now().count());
    if (packet.from_repair) note(packet, never);
  }
  void looped_back(const model::Packet& packet, std::uint32_t) override {
    if (packet.kind == model::PacketKind::data) note(packet, now().count());
  }
  void source_completed(const model::Packet& packet) override {
    if (waits_ && packet.from_repair) note(packet, now().count());
  }
  void transition(const model::Transition& fired) override {
    if (fired.descriptors == 0 || fired.before != "S" || fired.after != "U") return;
    for (std::uint64_t bits = fired.descriptors; bits != 0; bits &= bits - 1) {
      judge(fired.machine.subject,
            64 * fired.first_word + static_cast<std::uint32_t>(std::countr_zero(bits)));
    }
  }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    if (!shortest_) return {"No suppression ended."};
    return {"The shortest suppression of a descriptor was " +
            time_text(model::Nanoseconds{*shortest_}) + "; τ_S is " +
            (profiles_.are_mixed() ? "each writer's own" : time_text(duration_of(0))) + "."};
  }

 private:
  static constexpr std::int64_t never = -1;

  void note(const model::Packet& packet, std::int64_t time) {
    packet.descriptors.for_each([&](std::uint32_t d) { left_.at(packet.relation(), d) = time; });
  }
  void judge(std::uint32_t relation, std::uint32_t d) {
    const std::int64_t left = left_.at(relation, d);
    const char* const deed = waits_ ? "left the source" : "was serialized";
    if (left == never) {
      object_now("The suppression of " + descriptor_text(topology(), relation, d) + " ends at " +
                 time_text(now()) + ", before its repair " + deed + ".");
      return;
    }
    const std::int64_t lasted = now().count() - left;
    shortest_ = std::min(shortest_.value_or(lasted), lasted);
    const model::Nanoseconds duration = duration_of(topology().pair(relation / 2).source);
    if (lasted >= duration.count()) return;
    object_now("The suppression of " + descriptor_text(topology(), relation, d) + " ends at " +
               time_text(now()) + ", " + time_text(model::Nanoseconds{lasted}) +
               " after its own repair " + deed + " at " + time_text(model::Nanoseconds{left}) +
               "; τ_S is " + time_text(duration) + ".");
  }

  [[nodiscard]] model::Nanoseconds duration_of(std::uint32_t writer) const {
    return profiles_.of(writer).sedp.nack_suppression_duration;
  }

  bool waits_;
  model::Profiles profiles_;
  RelationValues<std::int64_t> left_;
  std::optional<std::int64_t> shortest_;
};

}  // namespace

MonitorPtr watch_suppression(const model::Scenario& scenario) {
  return attentive<Suppression>(scenario);
}

}  // namespace stormproof::props
