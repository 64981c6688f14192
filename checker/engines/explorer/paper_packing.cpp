// What the paper's rules (fsm/composition/paper.hpp) leave to a host: DATA packets are filled up to
// the grouping limit, and each descriptor is charged against the piggyback budget; a budget that is
// used up sends a HEARTBEAT in the packet, or after it to every open relation if there are several
// (model/paper/data.cpp). Where the scope says that the budget is not used up, it is not counted.
#include <bit>
#include <utility>

#include "checker/engines/explorer/packing.hpp"
#include "checker/engines/explorer/rule_runner.hpp"
#include "model/descriptor_sizes.hpp"

namespace stormproof::explorer {
namespace {

namespace owner = fsm::composition::owner;

class PaperPacking final : public Packing {
 public:
  PaperPacking(const model::Scenario& running, const Scope& scope)
      : Packing{running, scope},
        counts_bytes_{scope.counts_bytes && sedp().piggyback != model::Piggyback::off},
        sizes_{without_defaults(running.dds.descriptors)} {}

  Specialised::Action action(std::string_view step) override {
    if (step == "RefillBudget") {
      if (!counts_bytes_) return [](RuleRunner&, const Specialised::Call&) {};
      return [this](RuleRunner& w, const auto&) { refill(w.state(), w.writer()); };
    }
    if (step != "Generate") return {};
    return [this](RuleRunner& w, const Specialised::Call& call) {
      generate(w, static_cast<Members>(call.arguments[0]), call.arguments[1] != 0);
    };
  }
  void keep(Layout& layout) override {
    if (!counts_bytes_) return;
    budget_ = layout.keep(sizeof(std::int64_t), owner::writer);
    sent_bytes_ = layout.keep(sizeof(std::int64_t), owner::participant);
  }
  void start(WorldState& state) override {
    for (unsigned s = 0; s < scope().writers && counts_bytes_; ++s) refill(state, s);
  }

 private:
  void generate(RuleRunner& w, Members set, bool repair) {
    w.note_generated(w.relation(), set, repair);
    const Slot empty{What::data, repair ? Slot::from_repair : std::uint8_t{0}, 0, 0,
                     static_cast<std::uint8_t>(w.relation())};
    const std::int64_t shared = sedp().shared_header_bytes.count();
    Slot packet = empty;
    std::int64_t payload_bytes = 0;
    for (unsigned left = set; left != 0; left &= left - 1) {
      const auto d = static_cast<unsigned>(std::countr_zero(left));
      const std::int64_t bytes = sizes_.bytes(model::streams[w.writer()], d);
      if (packet.set != 0 && packet_is_full(sedp(), payload_bytes, bytes - shared)) {
        w.send(std::exchange(packet, empty));
        payload_bytes = 0;
      }
      const std::int64_t added = packet.set == 0 ? bytes : bytes - shared;
      packet.set |= member(d);
      payload_bytes += added;
      if (!counts_bytes_) continue;
      const std::vector<unsigned> open = w.readers();
      const bool rides = open.size() <= 1;
      if (!is_used_up(w, added, rides)) continue;
      if (rides) {
        packet.flags |= Slot::carries_heartbeat;
        payload_bytes += sedp().piggyback_heartbeat_bytes.count();
        continue;
      }
      w.send(std::exchange(packet, empty));
      payload_bytes = 0;
      for (const unsigned to : open) {
        w.send({What::heartbeat, 0, 0, 0, static_cast<std::uint8_t>(to)});
      }
    }
    if (packet.set != 0) w.send(packet);
  }
  /// User descriptors only: default ones differ in nothing but their size.
  static model::DescriptorProfile without_defaults(model::DescriptorProfile profile) {
    profile.default_publications = 0;
    profile.default_subscriptions = 0;
    return profile;
  }
  void refill(WorldState& state, unsigned writer) const {
    state.set(budget_, sedp().piggyback_threshold_bytes.count(), writer);
  }
  /// Charges the bytes, and those of the HEARTBEAT that follows from that; whether it does.
  [[nodiscard]] bool is_used_up(RuleRunner& w, std::int64_t added, bool rides) const {
    WorldState& state = w.state();
    const bool cumulative = sedp().piggyback == model::Piggyback::cumulative;
    const std::int64_t sent = state.get<std::int64_t>(sent_bytes_) + added;
    if (cumulative) state.set(sent_bytes_, sent);
    const auto before = state.get<std::int64_t>(budget_, w.writer());
    const std::int64_t budget = before - (cumulative ? sent : added);
    state.set(budget_, budget, w.writer());
    if (budget >= 0) return false;
    refill(state, w.writer());
    if (cumulative) {
      const model::Bytes heartbeat =
          rides ? sedp().piggyback_heartbeat_bytes : sedp().heartbeat_bytes;
      state.set(sent_bytes_, sent + heartbeat.count());
    }
    return true;
  }

  const bool counts_bytes_;
  const model::DescriptorSizes sizes_;
  Kept budget_{};
  Kept sent_bytes_{};  ///< the cumulative charge
};

}  // namespace

std::unique_ptr<Packing> paper_packing(const model::Scenario& running, const Scope& scope) {
  return std::make_unique<PaperPacking>(running, scope);
}

}  // namespace stormproof::explorer
