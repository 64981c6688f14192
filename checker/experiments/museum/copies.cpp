// storm.copy-per-loss: what is sent again was lost. The storms of the catalogue are those of runs
// without a loss; an exhibit may need one.
#include <map>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "checker/experiments/museum/claims.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::museum {

namespace {

class Copies final : public props::Observer {
 public:
  Copies() : Observer{"storm.copy-per-loss"} {}

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
  void transition(const model::Transition& fired) override {
    if (fired.event != "Renewed" || fired.machine.kind != model::MachineRef::Kind::relation) return;
    std::erase_if(copies_,
                  [&](const auto& copy) { return copy.first.first == fired.machine.subject; });
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

}  // namespace

std::unique_ptr<props::Monitor> watch_copies() { return std::make_unique<Copies>(); }

}  // namespace stormproof::museum
