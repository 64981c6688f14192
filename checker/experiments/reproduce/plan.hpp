// Which runs the reproduction of the paper's evaluation consists of: the published grid of
// configurations, under each DDS profile, on Wi-Fi, wired and as a normalised loopback, with both
// HEARTBEAT policies and the three orders of service that the paper compares.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "checker/experiments/reproduce/published.hpp"
#include "model/scenario.hpp"

namespace stormproof::reproduce {

/// One DDS profile with one way to start.
struct Variant {
  std::string id;
  std::string title;
  model::DdsProfile dds;
  model::WirelessProfile wireless;  ///< its Wi-Fi
  bool staggered = false;  ///< starts are drawn from ranges; several runs for each configuration
  std::size_t runs = 1;    ///< for each configuration
};

enum class Network : std::uint8_t { wireless, wired, loopback };
[[nodiscard]] const char* name_of(Network network);

struct Configuration {
  std::uint32_t participants_per_host = 1;      ///< N_P
  std::uint32_t endpoints_per_participant = 0;  ///< N_E

  auto operator<=>(const Configuration&) const = default;
};

/// The configuration whose messages the paper counts class by class.
inline constexpr Configuration counted{5, 20};

/// One row of the evaluation.
struct Case {
  std::size_t variant = 0;
  Network network{};
  model::HeartbeatPolicy policy{};
  model::ServiceOrder order{};
  Configuration configuration;

  auto operator<=>(const Case&) const = default;
};

/// The paper's FIFO-Uplink, FIFO-Downlink and Datagram-Uplink; the first is the one of all results.
inline constexpr std::array<model::ServiceOrder, 3> orders{model::ServiceOrder::fifo_uplink,
                                                           model::ServiceOrder::fifo_downlink,
                                                           model::ServiceOrder::datagram_uplink};

struct Plan {
  std::uint32_t hosts = 2;
  std::vector<Configuration> configurations;
  Configuration high_load_from;  ///< both numbers at least these
  std::vector<Variant> variants;
  model::WirelessProfile wired;
  std::vector<Case> cases;

  [[nodiscard]] bool high_load(const Configuration& one) const {
    return one.participants_per_host >= high_load_from.participants_per_host &&
           one.endpoints_per_participant >= high_load_from.endpoints_per_participant;
  }
  /// Run `k` of a case; `k` is the seed of a drawn schedule.
  [[nodiscard]] model::Scenario scenario(const Case& one, std::uint64_t k) const;
  /// Participants of the loopback run whose peers are as many as those of a participant of the
  /// configuration: l_P = (N_H − 1)·N_P + 1.
  [[nodiscard]] std::uint32_t loopback_participants(const Configuration& one) const;
};

struct PlanOptions {
  /// Ids of variants to run; empty: all.
  std::vector<std::string> variants;
  std::size_t samples = 5;  ///< runs of a staggered variant; the paper has 15
};

/// All ids that `PlanOptions::variants` may have.
[[nodiscard]] std::vector<std::string> variant_ids();

/// The plan for the grid of the published figures; profiles come from `specs`.
[[nodiscard]] model::config::Result<Plan> make_plan(const Published& published,
                                                    const PlanOptions& options,
                                                    const model::config::SpecPath& specs);

}  // namespace stormproof::reproduce
