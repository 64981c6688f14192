// The properties of a discovery without a storm, all for runs in which no packet is lost:
// storm.single-copy: no descriptor reaches a receiver that has it already; what a reader side drops
//   because it is not open does not count, a complete reader that has no use for it does;
// storm.free-threshold, storm.cannot-start: no descriptor is generated a second time for a
//   receiver. Under push the first generation is the initial DATA; under pull, and with Fast DDS,
//   it may answer an ACKNACK.
// From the first loss on, none claims anything. Only cross-host relations count.
#include <fmt/core.h>

#include "props/monitors/data_observer.hpp"
#include "props/monitors/delay_observer.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/relation_words.hpp"

namespace stormproof::props {

namespace {

/// Knows what has been lost so far, and how long packets take.
class LossAware : public DelayObserver {
 public:
  using DelayObserver::DelayObserver;

  void finish(model::Nanoseconds end) override { largest_ = delays().largest(end); }

 protected:
  [[nodiscard]] bool lossless() const { return delays().lost() == 0; }
  [[nodiscard]] std::vector<std::string> delay_remarks() const {
    std::vector<std::string> lines;
    lines.push_back(fmt::format("Largest per-packet delay {}, of initial DATA {}.",
                                time_text(largest_), time_text(delays().largest_initial_data())));
    if (!lossless()) {
      lines.push_back(fmt::format("{} packets were lost; the claim ends with the first of them.",
                                  delays().lost()));
    }
    return lines;
  }

 private:
  model::Nanoseconds largest_;
};

class SingleCopies : public DataObserver<LossAware> {
 public:
  static constexpr auto selection_of_kinds =
      model::trace::Selection{}.only({model::Report::received}, {model::PacketKind::data});

  explicit SingleCopies(const model::Scenario& scenario)
      : DataObserver{"storm.single-copy", scenario} {}

  void received(const model::Packet& packet, std::uint32_t receiver) override {
    DataObserver::received(packet, receiver);
    if (packet.kind != model::PacketKind::data || !lossless()) return;
    const model::Pair& ends = topology().pair(packet.pair);
    if (ends.cross_host && now() >= topology().start(ends.destination)) look_for_copies(packet);
  }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    auto lines = delay_remarks();
    lines.push_back(fmt::format("{} descriptors arrived again without a loss.", copies_));
    return lines;
  }

 private:
  void look_for_copies(const model::Packet& data) {
    const std::uint32_t relation = data.relation();
    const std::uint32_t d = x().words().first_of(relation, data.descriptors, true);
    if (d == UINT32_MAX) return;
    data.descriptors.for_each([&](std::uint32_t one) {
      if (x().words().test(relation, one)) ++copies_;
    });
    object_now([&] {
      return "At " + time_text(now()) + " " + descriptor_text(topology(), relation, d) +
             " is received again, though nothing was lost; this copy was emitted at " +
             time_text(data.emitted) + ".";
    });
  }

  std::uint64_t copies_ = 0;
};

class NeedlessRepairs : public LossAware {
 public:
  static constexpr auto selection_of_kinds =
      model::trace::Selection{}.only({model::Report::emitted}, {model::PacketKind::data});

  NeedlessRepairs(std::string_view property, const model::Scenario& scenario)
      : LossAware{property, scenario} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    generated_.reset(topology);
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    LossAware::emitted(packet, source, destinations);
    if (packet.kind != model::PacketKind::data) return;
    const std::uint32_t relation = packet.relation();
    const std::uint32_t d = generated_.first_of(relation, packet.descriptors, true);
    if (d != UINT32_MAX && lossless()) {
      object_now([&] {
        return "At " + time_text(now()) + " " + descriptor_text(topology(), relation, d) +
               " is generated again, though nothing was lost.";
      });
    }
    generated_.add(relation, packet.descriptors);
  }
  [[nodiscard]] std::vector<std::string> remarks() const override { return delay_remarks(); }

 private:
  RelationWords generated_;
};

}  // namespace

MonitorPtr watch_single_copies(const model::Scenario& scenario) {
  return attentive<SingleCopies>(scenario);
}

MonitorPtr watch_needless_repairs(const model::Scenario& scenario, std::string_view property) {
  return attentive<NeedlessRepairs>(property, scenario);
}

}  // namespace stormproof::props
