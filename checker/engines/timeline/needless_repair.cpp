// The schedules.
#include "checker/engines/timeline/needless_repair.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "model/implementations.hpp"
#include "props/monitors/delay_meter.hpp"

namespace stormproof::timeline {
namespace {

using model::Nanoseconds;
using model::PacketKind;

constexpr Nanoseconds tick{1};

/// DATA takes `data`, HEARTBEATs `heartbeat`, the first ACKNACK a nanosecond. Later ACKNACKs take
/// `data` too: a clean one that arrives within τ_N would take the request back.
Director late_data(Nanoseconds data, Nanoseconds heartbeat) {
  return [=](const DirectedPacket& packet) -> Passing {
    if (packet.kind == PacketKind::data) return {data, Nanoseconds{0}, false};
    if (packet.kind == PacketKind::heartbeat) return {heartbeat, Nanoseconds{0}, false};
    return {packet.ordinal == 0 ? tick : data, Nanoseconds{0}, false};
  };
}

/// Everything takes `delay`.
Director constant(Nanoseconds delay) {
  return [delay](const DirectedPacket&) -> Passing { return {delay, Nanoseconds{0}, false}; };
}

std::function<std::string(const Prediction&)> expect_data(std::uint64_t count) {
  return [count](const Prediction& p) -> std::string {
    if (p.data == count) return {};
    return fmt::format("{} DATA are expected, not {}", count, p.data);
  };
}

BoundaryPoint point(std::string name, const model::DdsProfile& dds, Director director,
                    std::uint64_t data) {
  BoundaryPoint p;
  p.name = std::move(name);
  p.setting.dds = dds;
  p.setting.run_until = model::RunUntil::time_limit;
  const model::SedpProfile& sedp = dds.sedp;
  p.setting.time_limit = sedp.heartbeat_period * 2 + sedp.heartbeat_response_delay * 2 +
                         sedp.initial_acknack_delay * 4 + sedp.nack_response_delay;
  p.director = std::move(director);
  p.expected = expect_data(data);
  return p;
}

Setting counterexample_setting(const model::Scenario& scenario) {
  Setting setting;
  setting.dds = scenario.dds;
  setting.run_until = model::RunUntil::time_limit;
  const model::SedpProfile& sedp = scenario.dds.sedp;
  setting.time_limit = sedp.heartbeat_period * 2 + sedp.initial_acknack_delay * 2 +
                       sedp.heartbeat_response_delay + sedp.nack_response_delay;
  return setting;
}

/// Fast DDS: publication 0 starts the timer, publication 1 is created just before it expires, and
/// the HEARTBEAT announces it before its DATA arrives. Of the 17 default endpoints, publications 0
/// and 1 are the first and the third.
void add_stateful(const model::SedpProfile& sedp, Nanoseconds delta, Setting& setting,
                  std::vector<Director>& candidates) {
  const Nanoseconds late = sedp.heartbeat_response_delay + tick * 4;
  const Nanoseconds answer = std::max(tick, sedp.nack_suppression_duration);
  if (late > delta || answer > delta || sedp.heartbeat_period <= tick * 4) return;
  const Nanoseconds distance{(sedp.heartbeat_period.count() - 1) / 2};
  setting.descriptors = 0;
  setting.endpoints_done = distance * 17;
  candidates.push_back([=](const DirectedPacket& packet) -> Passing {
    if (packet.kind == PacketKind::acknack) return {answer, Nanoseconds{0}, false};
    const bool second = packet.kind == PacketKind::data && packet.ordinal == 1;
    return {second ? late : tick, Nanoseconds{0}, false};
  });
}

void add_paper(const model::SedpProfile& sedp, Nanoseconds delta,
               std::vector<Director>& candidates) {
  const Nanoseconds late = sedp.heartbeat_response_delay + tick;
  if (late + tick <= delta) candidates.push_back(late_data(late + tick, tick));
  if (late <= delta) candidates.push_back(late_data(late, Nanoseconds{0}));
  const Nanoseconds unasked = sedp.initial_acknack_delay + tick;
  if (asks_by_itself(sedp) && unasked <= delta) candidates.push_back(late_data(unasked, unasked));
}

/// Pulled DATA: two ACKNACKs ask for it, the second one after the suppression that the first one
/// leads to. They answer the HEARTBEAT of the opening and the next one (the reply to an initial
/// ACKNACK, or the first periodic one), or the initial ACKNACK is itself the first.
void add_pulled(const model::SedpProfile& sedp, Nanoseconds delta,
                std::vector<Director>& candidates) {
  const Nanoseconds initial = sedp.initial_acknack_delay;
  const Nanoseconds later = sedp.nack_response_delay + sedp.nack_suppression_duration + tick * 2;
  const Nanoseconds data = sedp.nack_suppression_duration + tick * 3;
  struct Delays {
    Nanoseconds opening, next, data;
  };
  for (const Delays& d : {Delays{initial + tick, later, data},
                          Delays{initial + later, tick, data + sedp.heartbeat_response_delay},
                          Delays{sedp.heartbeat_period, later, data}}) {
    if (std::max({d.opening, d.next, d.data}) > delta) continue;
    candidates.push_back([d](const DirectedPacket& packet) -> Passing {
      if (packet.kind == PacketKind::data) return {d.data, Nanoseconds{0}, false};
      if (packet.kind != PacketKind::heartbeat) return {tick, Nanoseconds{0}, false};
      return {packet.ordinal == 0 ? d.opening : d.next, Nanoseconds{0}, false};
    });
  }
}

}  // namespace

bool asks_by_itself(const model::SedpProfile& sedp) {
  return sedp.initial_acknack == model::InitialAckNackReply::bitmap &&
         sedp.initial_acknack_delay > Nanoseconds{0};
}

std::optional<props::Counterexample> needless_repair(const model::Scenario& scenario,
                                                     std::string_view property, Nanoseconds delta) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  Setting setting = counterexample_setting(scenario);
  std::vector<Director> candidates;
  if (props::takes_equal_times(scenario.wireless)) {
    candidates.push_back(constant(delta));
  } else if (model::traits_of(scenario.dds).writer == model::Writer::stateful) {
    add_stateful(sedp, delta, setting, candidates);
  } else if (sedp.initial_data == model::InitialData::pull) {
    add_pulled(sedp, delta, candidates);
  } else {
    add_paper(sedp, delta, candidates);
  }
  for (const Director& director : candidates) {
    const auto run = direct(setting, director);
    if (!run) continue;
    if (auto found = confirmed_counterexample(property, run->scenario)) return found;
  }
  return std::nullopt;
}

std::vector<BoundaryPoint> threshold_points(const model::DdsProfile& dds) {
  std::vector<BoundaryPoint> points;
  model::DdsProfile encoded = encoded_profile(dds);
  encoded.sedp.initial_data = model::InitialData::push;
  const model::SedpProfile& sedp = encoded.sedp;
  const Nanoseconds answered = tick + sedp.heartbeat_response_delay;
  const bool asks = asks_by_itself(sedp);
  const Nanoseconds generated = answered + tick + sedp.nack_response_delay;
  // Where no clean ACKNACK can come in between.
  if ((!asks || sedp.initial_acknack_delay > answered) && generated < sedp.heartbeat_period) {
    points.push_back(
        point("DATA arrives as the ACKNACK is made", encoded, late_data(answered, tick), 1));
    points.push_back(
        point("DATA arrives a nanosecond later", encoded, late_data(answered + tick, tick), 2));
  }
  const Nanoseconds initial = sedp.initial_acknack_delay;
  if (asks && sedp.nack_response_delay < initial && initial * 2 < sedp.heartbeat_period) {
    points.push_back(point("DATA arrives as the initial ACKNACK is made", encoded,
                           late_data(initial, initial + tick), 1));
    points.push_back(point("DATA arrives a nanosecond after the initial ACKNACK", encoded,
                           late_data(initial + tick, initial + tick), 2));
    points.push_back(point("the HEARTBEAT arrives as the initial ACKNACK is due", encoded,
                           late_data(initial, initial), 1));
    const Nanoseconds most = initial + std::max(Nanoseconds{0}, sedp.nack_response_delay -
                                                                    sedp.heartbeat_response_delay);
    points.push_back(
        point("a clean ACKNACK arrives as the repair is due", encoded, constant(most), 1));
    points.push_back(
        point("a clean ACKNACK arrives a nanosecond later", encoded, constant(most + tick), 2));
  }
  return points;
}

std::vector<BoundaryPoint> single_copy_points(const model::DdsProfile& dds) {
  model::DdsProfile encoded = encoded_profile(dds);
  model::SedpProfile& sedp = encoded.sedp;
  sedp.initial_data = model::InitialData::push;
  const Nanoseconds lower = sedp.nack_response_delay + sedp.nack_suppression_duration;
  const Nanoseconds delta{sedp.nack_suppression_duration.count() / 2 + 10};
  const Nanoseconds upper = delta * 2 + sedp.nack_response_delay;
  sedp.heartbeat_period = std::max(sedp.heartbeat_period, upper + tick);
  if (sedp.initial_acknack_delay <= delta) sedp.initial_acknack_delay = Nanoseconds{0};
  const Director director = [delta](const DirectedPacket& packet) -> Passing {
    return {delta, Nanoseconds{0}, packet.kind == PacketKind::data && packet.ordinal == 0};
  };
  std::vector<BoundaryPoint> points;
  for (const Nanoseconds gap : {lower, lower + tick, upper - tick, upper}) {
    const bool needless = lower < gap && gap < upper;
    BoundaryPoint p = point(fmt::format("HEARTBEATs {} ns apart", gap.count()), encoded, director,
                            needless ? 3 : 2);
    p.setting.phase = gap;
    points.push_back(std::move(p));
  }
  return points;
}

}  // namespace stormproof::timeline
