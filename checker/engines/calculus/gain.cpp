// What a repair is charged with, and the series.
#include "checker/engines/calculus/gain.hpp"

#include <algorithm>

#include "checker/engines/timeline/theorem.hpp"
#include "model/descriptor_sizes.hpp"
#include "model/engine/topology.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/implementations.hpp"

namespace stormproof::calculus {

namespace {

using model::Stream;

/// Bytes that a descriptor is charged with when only its own bytes are, at most, and all of them
/// once.
struct Charges {
  std::int64_t largest = 0;
  std::int64_t first_time = 0;
};

/// Of the paper's writer, which sends to each reader by itself.
Charges charges_of(model::Of<fsm::composition::paper::Paper>, const model::DdsProfile& dds,
                   Stream s, std::int64_t descriptors, std::int64_t readers) {
  const model::DescriptorSizes sizes{dds.descriptors};
  Charges charges;
  for (std::int64_t d = 0; d < descriptors; ++d) {
    const std::int64_t bytes = sizes.bytes(s, static_cast<std::uint32_t>(d));
    charges.largest = std::max(charges.largest, bytes);
    charges.first_time = plus(charges.first_time, times(bytes, readers));
  }
  return charges;
}

Charges charges_of(model::Of<fsm::composition::fastdds::FastDds>, const model::DdsProfile& dds,
                   Stream, std::int64_t descriptors, std::int64_t) {
  namespace fastdds = model::fastdds;
  const std::int64_t bytes = fastdds::message_header_bytes + fastdds::timestamp_bytes +
                             fastdds::largest_submessage_bytes(dds);
  return {bytes, times(bytes, descriptors)};
}

WriterGain gain_of_writer(const model::DdsProfile& dds, Stream s, std::int64_t descriptors,
                          std::int64_t readers) {
  const Charges charges = model::visit_engine_composition(
      dds, [&](auto composition) { return charges_of(composition, dds, s, descriptors, readers); });
  WriterGain gain;
  gain.descriptors = descriptors;
  gain.readers = readers;
  gain.budget = plus(dds.sedp.piggyback_threshold_bytes.count(), 1);
  switch (dds.sedp.piggyback) {
    case model::Piggyback::off:
      break;
    case model::Piggyback::linear:
      gain.bytes = charges.largest;
      gain.pushed = charges.first_time;
      break;
    case model::Piggyback::group:
    case model::Piggyback::cumulative:  // in the end every delivery uses up the budget
      gain.bytes = gain.budget;
      gain.pushed = times(times(gain.budget, descriptors), readers);
      break;
  }
  return gain;
}

}  // namespace

double WriterGain::value() const {
  return static_cast<double>(bytes) * static_cast<double>(readers) *
         static_cast<double>(descriptors) / static_cast<double>(budget);
}

std::optional<std::int64_t> WriterGain::repairs(std::int64_t heartbeats) const {
  if (!is_below_one()) return std::nullopt;
  const std::int64_t asked = plus(times(heartbeats, budget), times(readers, pushed));
  const std::int64_t most = times(descriptors, asked);
  return most == endless ? endless : most / (budget - loop());
}

std::int64_t Gain::asked(model::Nanoseconds until) const {
  const std::int64_t times_asked = plus(1, periodic.most(until.count(), 0));
  return plus(times_asked, attempts ? attempts->most(until.count(), 0) : 0);
}

std::optional<std::int64_t> Gain::repairs(model::Nanoseconds until) const {
  std::int64_t sum = 0;
  for (const WriterGain& writer : writers) {
    const auto repairs = writer.repairs(times(writer.readers, asked(until)));
    if (!repairs) return std::nullopt;
    sum = plus(sum, *repairs);
  }
  return sum;
}

std::optional<Gain> gain_of(const model::Scenario& scenario) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  if (sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive) return std::nullopt;
  if (model::rules_of(scenario.dds).heartbeat_timer == model::HeartbeatTimerKind::additive) {
    return std::nullopt;
  }
  Gain gain;
  gain.periodic = Recurrence::every(sedp.heartbeat_period);
  if (sedp.initial_acknack_delay > model::Nanoseconds{0}) {
    gain.attempts = Recurrence::attempts(sedp);
  }
  const model::Topology topology = topology_of(scenario);
  for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
    for (const Stream s : model::streams) {
      const WriterGain writer =
          gain_of_writer(scenario.dds, s, topology.descriptor_count(i, s), topology.peer_count(i));
      gain.writers.push_back(writer);
      if (writer.value() > gain.worst.value() || i == 0) gain.worst = writer;
    }
  }
  return gain;
}

void prove_gain(timeline::Theorem& theorem, const WriterGain& gain, std::int64_t heartbeats) {
  using timeline::Int;
  const auto most = gain.repairs(heartbeats);
  if (!most || *most == endless) return;
  const std::size_t mark = theorem.open();
  const Int repairs = theorem.at_least("repairs", 0);
  const Int exhaustions = theorem.at_least("exhaustions", 0);
  theorem.assume(exhaustions * gain.budget <= repairs * gain.bytes + gain.pushed);
  theorem.assume(repairs <= (exhaustions * gain.readers + heartbeats) * gain.descriptors);
  theorem.holds("repairs of a gain below 1 are a geometric series", repairs <= *most);
  theorem.close(mark);
}

}  // namespace stormproof::calculus
