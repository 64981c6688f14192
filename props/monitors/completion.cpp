// live.completion: under per-packet delay ≤ Δ and at most k lost packets, every descriptor is
// received within a bound. This monitor measures the Δ and k of the run and, for each relation, the
// time from the opening of its writer side to its last descriptor. A relation opens with a
// HEARTBEAT to its reader, so the first packet on it tells when. Only cross-host relations count.
//
// It objects if that time exceeds the bound that it was given; and, at the end, if a descriptor
// came later, or is later than, completion_bound() after the start of both ends. That bound is not
// tight: it is for runs that never come to an end although packets arrive.
//   * From the start of both, each hears of the other within (k + 1)·max(τ_P, startup period) + Δ;
//     with static peers within twice that, as one may have to hear of the other first.
//   * Then the relation is open. While the reader lacks a descriptor the writer has it not in A, so
//     a HEARTBEAT leaves within P (τ_H; adaptive: max(τ_H, T_max) + 1 ns) and an ACKNACK comes back
//     within 2Δ + τ_A. In U the descriptor is then repaired: τ_N + Δ. In R it was already asked
//     for: the same. In Q or S its DATA is on its way, or it is in U again within Δ + τ_S.
//   * So each round of P + 3Δ + τ_A + τ_N + τ_S delivers it, takes it back to U, or loses a packet:
//     at most 2(k + 1) rounds.
#include "props/monitors/completion.hpp"

#include <optional>

#include <fmt/core.h>

#include "model/implementations.hpp"
#include "props/monitors/data_observer.hpp"
#include "props/monitors/delay_observer.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"

namespace stormproof::props {

model::Nanoseconds completion_bound(const model::DdsProfile& dds, model::Nanoseconds delay,
                                    std::uint64_t losses) {
  const model::SedpProfile& sedp = dds.sedp;
  model::Nanoseconds announced = std::max(dds.spdp.period, dds.spdp.startup_period);
  // Who is at no port that is asked is answered once it has announced itself.
  if (dds.discovery == model::Discovery::static_peers) announced = announced * 2 + delay;
  model::Nanoseconds asked = sedp.heartbeat_period;
  if (sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive) {
    asked = std::max(asked, sedp.adaptive.max_period) + model::Nanoseconds{1};
  }
  const model::Nanoseconds round = asked + delay * 3 + sedp.heartbeat_response_delay +
                                   sedp.nack_response_delay + sedp.nack_suppression_duration;
  const auto attempts = static_cast<std::int64_t>(losses) + 1;
  return announced * attempts + delay + round * (2 * attempts);
}

namespace {

class Completion : public DataObserver<DelayObserver> {
 public:
  static constexpr auto selection_of_kinds = model::trace::Selection{}.only(
      {model::Report::emitted}, {model::PacketKind::data, model::PacketKind::heartbeat});

  Completion(const model::Scenario& scenario, std::optional<model::Nanoseconds> bound)
      : DataObserver{"live.completion", scenario}, dds_{scenario.dds}, bound_{bound} {
    for (const model::Participant& participant : scenario.deployment.participants) {
      const bool created_later = model::traits_of(dds_).creates_endpoints_over_time;
      ready_.push_back(created_later ? participant.endpoints_done : participant.start);
    }
  }

  void run_started(const model::Topology& topology) override {
    DataObserver::run_started(topology);
    relations_.assign(topology.relation_count(), {});
    closed_ = 0;
    for (std::uint32_t r = 0; r < topology.relation_count(); ++r) {
      const model::Pair& ends = topology.pair(r / 2);
      relations_[r].cross_host = ends.cross_host;
      if (ends.cross_host) ++closed_;
      relations_[r].ready = std::max(ready_[ends.source], ready_[ends.destination]);
    }
    missing_ = topology.required_deliveries();
  }
  void emitted(const model::Packet& packet, std::uint32_t sender,
               std::span<const std::uint32_t> destinations) override {
    DelayObserver::emitted(packet, sender, destinations);
    const bool by_writer =
        packet.kind == model::PacketKind::data || packet.kind == model::PacketKind::heartbeat;
    if (!by_writer || done_ || closed_ == 0) return;
    if (packet.copies == 1) {
      note_opening(packet.relation());
      return;
    }
    for (const std::uint32_t destination : destinations) {
      const std::uint32_t source = topology().pair(packet.pair).source;
      note_opening(2 * topology().pair_between(source, destination) + packet.relation() % 2);
    }
  }
  void finish(model::Nanoseconds end) override {
    largest_delay_ = delays().largest(end);
    general_bound_ = completion_bound(dds_, largest_delay_, delays().lost());
    if (bound_) judge_open_ends(end);
    judge_general_bound(end);
  }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    std::vector<std::string> lines{
        fmt::format("Largest per-packet delay {}, {} packets lost.", time_text(largest_delay_),
                    delays().lost()),
        fmt::format("A relation took at most {} from its opening to its last descriptor.",
                    time_text(longest_))};
    lines.push_back(fmt::format("No relation may take longer than {} from the start of both ends.",
                                time_text(general_bound_)));
    if (!done_) lines.push_back(fmt::format("{} descriptors were not delivered.", missing_));
    return lines;
  }

 private:
  struct Relation {
    std::optional<model::Nanoseconds> opened;
    model::Nanoseconds ready;  ///< both ends have started, all descriptors exist
    bool cross_host = true;
  };
  struct Latest {
    model::Nanoseconds took;
    model::Nanoseconds time;
    std::uint64_t event = 0;
    std::string what;
  };

  void note_opening(std::uint32_t relation) {
    if (relations_[relation].opened) return;
    relations_[relation].opened = now();
    if (relations_[relation].cross_host) --closed_;
  }

  void took(const model::Packet& data, std::uint32_t fresh) override {
    const std::uint32_t r = data.relation();
    if (fresh == 0 || !topology().pair(r / 2).cross_host) return;
    missing_ -= fresh;
    done_ = missing_ == 0;
    if (lacking(r) > 0) return;
    note_latest(r);
    if (!relations_[r].opened) return;
    const model::Nanoseconds took = now() - *relations_[r].opened;
    longest_ = std::max(longest_, took);
    if (!bound_ || took <= *bound_) return;
    object_now(fmt::format(
        "The last descriptor of {} arrives at {}, {} after its opening; the "
        "bound is {}.",
        relation_text(topology(), r), time_text(now()), time_text(took), time_text(*bound_)));
  }

  void note_latest(std::uint32_t relation) {
    const model::Nanoseconds took = now() - relations_[relation].ready;
    if (took <= latest_.took) return;
    latest_ = {took, now(), event(), relation_text(topology(), relation)};
  }
  void judge_open_ends(model::Nanoseconds end) {
    for (std::uint32_t r = 0; r < relations_.size(); ++r) {
      const Relation& relation = relations_[r];
      if (!relation.cross_host || !relation.opened || lacking(r) == 0) continue;
      if (end <= *relation.opened + *bound_) continue;
      object(
          event(), end,
          fmt::format("At {} a relation that opened at {} still lacks {} descriptors; the bound "
                      "is {}.",
                      time_text(end), time_text(*relation.opened), lacking(r), time_text(*bound_)));
    }
  }
  void judge_general_bound(model::Nanoseconds end) {
    if (latest_.took > general_bound_) {
      object(latest_.event, latest_.time,
             fmt::format("The last descriptor of {} arrives {} after the start of both ends; with "
                         "packets that take at most {} and {} losses it must be there after {}.",
                         latest_.what, time_text(latest_.took), time_text(largest_delay_),
                         delays().lost(), time_text(general_bound_)));
    }
    for (std::uint32_t r = 0; r < relations_.size(); ++r) {
      const Relation& relation = relations_[r];
      if (!relation.cross_host || lacking(r) == 0) continue;
      if (end <= relation.ready + general_bound_) continue;
      object(event(), end,
             fmt::format("At {} a relation whose ends are there since {} still lacks {} "
                         "descriptors; with packets that take at most {} and {} losses they must "
                         "be there after {}.",
                         time_text(end), time_text(relation.ready), lacking(r),
                         time_text(largest_delay_), delays().lost(), time_text(general_bound_)));
    }
  }

  model::DdsProfile dds_;
  std::vector<model::Nanoseconds> ready_;  // by participant
  std::optional<model::Nanoseconds> bound_;
  std::vector<Relation> relations_;
  std::uint64_t missing_ = 0;
  std::uint32_t closed_ = 0;  // cross-host relations that no packet has opened
  bool done_ = false;
  model::Nanoseconds longest_;
  model::Nanoseconds largest_delay_;
  model::Nanoseconds general_bound_;
  Latest latest_;
};

}  // namespace

MonitorPtr watch_completion(const model::Scenario& scenario,
                            std::optional<model::Nanoseconds> bound) {
  return attentive<Completion>(scenario, bound);
}

}  // namespace stormproof::props
