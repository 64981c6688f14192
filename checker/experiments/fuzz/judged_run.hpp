// One run of a variant under the monitors of properties and limits.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "checker/engines/exact/health.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"
#include "props/verdict.hpp"

namespace stormproof::fuzz {

/// Asked now and then; false interrupts a run.
using GoesOn = std::function<bool()>;

/// A property or limit that a run breaks.
struct Breach {
  std::string_view id;
  std::uint64_t event = 0;
  model::Nanoseconds time;
  std::string reason;
};

/// What is kept of a run.
struct JudgedRun {
  std::uint64_t number = 0;    ///< of the variant
  std::uint32_t rejected = 0;  ///< draws before it that gave no valid scenario
  std::optional<model::Nanoseconds> discovery_time;
  std::uint64_t messages = 0;
  double amplification = 0;
  std::uint64_t backlog = 0;  ///< highest of any participant, in packets
  std::uint64_t packets = 0;  ///< emitted
  std::uint64_t lost = 0;     ///< of them
  std::uint64_t events = 0;
  exact::RunHealth health{};                ///< storm, slow link, fine
  std::vector<Breach> breaches;             ///< in the order of the ids
  std::vector<std::string_view> undecided;  ///< ids of which the run says nothing: it was too
                                            ///< short, or nobody watched

  [[nodiscard]] const Breach* breach(std::string_view id) const;
  [[nodiscard]] bool decides(std::string_view id) const;
};

/// Tells which packets a run loses, of so many.
using Losses = std::function<std::vector<std::uint64_t>(std::uint64_t packets)>;

/// Runs `scenario` and judges it by `ids`, each of which has a monitor. Packets beyond the first
/// `expected` are emitted under losses of their own: if a run emits more than it was told the
/// losses of, it is repeated with those of twice as many. live.quiescence has a run of its own, far
/// beyond discovery. On return the scenario has the losses. Nothing if `goes_on` interrupted it.
[[nodiscard]] std::optional<JudgedRun> run_and_judge(model::Scenario& scenario,
                                                     std::span<const std::string_view> ids,
                                                     const Losses& losses, std::uint64_t expected,
                                                     const GoesOn& goes_on);

/// How `scenario` breaks the property or limit `id` within `most_events` events, if it does.
/// `events` is increased by what that took.
[[nodiscard]] std::optional<props::Counterexample> find_breach(const model::Scenario& scenario,
                                                               std::string_view id,
                                                               std::uint64_t most_events,
                                                               std::uint64_t& events,
                                                               const GoesOn& goes_on);

}  // namespace stormproof::fuzz
