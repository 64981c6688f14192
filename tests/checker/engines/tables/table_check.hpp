// One property, one scenario, perhaps one mistake: what every test of the tables engine asks.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "checker/engines/smt/claims.hpp"
#include "checker/engines/tables/tables.hpp"
#include "fsm/machines.hpp"

namespace stormproof::tables {

using props::Finding;
using props::VerdictKind;

inline Finding decide(std::string_view property, const model::Scenario& scenario,
                      const checker::Mutant* mutant = nullptr,
                      smt::Options options = {.second_solver = false}) {
  smt::Claims claims{std::move(options)};
  const checker::CheckRequest request{
      .scenario = scenario, .claims = claims, .mutant = mutant, .on_progress = {}};
  const auto findings = check({&property, 1}, request);
  return findings.size() == 1 ? findings.front().second : Finding{};
}

inline model::Scenario paper() { return {}; }
inline model::Scenario fastdds() {
  model::Scenario scenario;
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  return scenario;
}

inline model::Scenario with_server() {
  model::Scenario scenario = fastdds();
  scenario.dds.discovery = model::Discovery::server;
  return scenario;
}

inline model::Scenario cyclone() {
  model::Scenario scenario;
  scenario.dds.implementation = model::ImplementationKind::cyclone;
  return scenario;
}

inline bool mentions(const Finding& finding, std::string_view text) {
  return std::any_of(finding.details.begin(), finding.details.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

/// The position of a row in its table.
inline std::size_t row_of(std::string_view machine, std::string_view source, std::string_view event,
                          std::string_view target) {
  for (const fsm::MachineInfo& info : fsm::machines()) {
    if (info.name != machine) continue;
    for (std::size_t k = 0; k < info.rows.size(); ++k) {
      const fsm::RowInfo& row = info.rows[k];
      if (info.states[row.source] == source && info.events[row.event] == event &&
          info.states[row.target] == target) {
        return k;
      }
    }
  }
  ADD_FAILURE() << "no such row: " << machine << " " << source << " " << event << " " << target;
  return 0;
}

inline std::uint8_t state_of(std::string_view machine, std::string_view state) {
  for (const fsm::MachineInfo& info : fsm::machines()) {
    if (info.name != machine) continue;
    const auto found = std::find(info.states.begin(), info.states.end(), state);
    return static_cast<std::uint8_t>(found - info.states.begin());
  }
  return 0;
}

/// A mutant with one mistake in one table.
inline checker::Mutant with_row(std::string machine, std::size_t row, fsm::TableMutation::Kind kind,
                                std::uint8_t source = 0, std::uint8_t target = 0) {
  checker::Mutant mutant;
  mutant.rules.tables.push_back({std::move(machine), row, kind, source, target});
  return mutant;
}

inline void expect_proved(std::string_view property, const model::Scenario& scenario) {
  const Finding finding = decide(property, scenario);
  EXPECT_EQ(finding.kind, VerdictKind::proved)
      << property << ": " << finding.how
      << (finding.details.empty() ? "" : "\n" + finding.details.back());
}
inline void expect_violated(std::string_view property, const model::Scenario& scenario,
                            const checker::Mutant& mutant, std::string_view words) {
  const Finding finding = decide(property, scenario, &mutant);
  EXPECT_EQ(finding.kind, VerdictKind::violated) << property << ": " << finding.how;
  EXPECT_TRUE(mentions(finding, words)) << property << ": nothing says " << words;
}

}  // namespace stormproof::tables
