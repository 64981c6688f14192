// The numbering is that of model/probe.hpp.
#include "checker/page/machine_owners.hpp"

#include <fmt/format.h>

#include "model/cyclone/endpoints.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/implementations.hpp"

namespace stormproof::page {

using Kind = model::MachineRef::Kind;

namespace {

const char* name_at(std::uint32_t stream) {
  return stream % 2 == 0 ? "publications" : "subscriptions";
}
constexpr std::uint32_t nobody = UINT32_MAX;

}  // namespace

void MachineOwners::run_started(const model::Topology& topology) {
  topology_ = &topology;
  const model::ImplementationTraits& traits = model::traits_of(scenario_.dds);
  if (traits.has_event_thread) stride_ = model::cyclone::writers_per_participant(topology);
  if (traits.has_control_relations) {
    control_ = std::make_unique<model::fastdds::ControlRelations>(topology, scenario_);
  }
}

std::pair<std::uint32_t, std::uint32_t> MachineOwners::ends_of(
    const model::MachineRef& machine) const {
  const std::uint32_t n = machine.subject;
  const auto of_pair = [this](std::uint32_t pair) {
    const model::Pair& ends = topology_->pair(pair);
    return std::pair{ends.source, ends.destination};
  };
  switch (machine.kind) {
    case Kind::relation:
      return of_pair(n / 2);
    case Kind::pair:
      return of_pair(n);
    case Kind::endpoint_relation:
      return of_pair(n / stride_);
    case Kind::control_relation:
      return of_pair(control_->pair_of(n));
    case Kind::writer:
      return {n / 2, n / 2};
    case Kind::control_writer:
      return {n / model::fastdds::control_writers, n / model::fastdds::control_writers};
    case Kind::endpoint_writer:
      return {n / stride_, n / stride_};
    case Kind::participant:
      return {n, n};
    case Kind::channel:
      break;
  }
  return {nobody, nobody};
}

bool MachineOwners::owns(std::uint32_t participant, const model::MachineRef& machine) const {
  const auto [from, to] = ends_of(machine);
  return participant == from || participant == to;
}

std::string MachineOwners::words_of(const model::MachineRef& machine) const {
  const auto [from, to] = ends_of(machine);
  switch (machine.kind) {
    case Kind::relation:
      return fmt::format("relation {}→{}, {}", from, to, name_at(machine.subject));
    case Kind::pair:
      return fmt::format("pair {}→{}", from, to);
    case Kind::endpoint_relation:
      return fmt::format("relation {}→{}, {}", from, to,
                         model::cyclone::name_of_writer(machine.subject % stride_));
    case Kind::control_relation:
      return fmt::format("control relation {}→{}", from, to);
    case Kind::writer:
      return fmt::format("writer of {}, {}", from, name_at(machine.subject));
    case Kind::control_writer:
      return fmt::format(
          "writer of {}, {}", from,
          model::fastdds::control_writer_names[machine.subject % model::fastdds::control_writers]);
    case Kind::endpoint_writer:
      return fmt::format("writer of {}, {}", from,
                         model::cyclone::name_of_writer(machine.subject % stride_));
    case Kind::participant:
      return fmt::format("participant {}", from);
    case Kind::channel:
      break;
  }
  return fmt::format("channel {}", machine.subject);
}

}  // namespace stormproof::page
