// An explorer that misreads the rules finds paths that no run takes: the finding is disputed, and a
// search that is cut short establishes nothing.
#include <array>

#include <gtest/gtest.h>

#include "checker/engines/explorer/explorer.hpp"
#include "fsm/machines.hpp"
#include "tests/checker/engines/explorer/tiny.hpp"

namespace stormproof::explorer {
namespace disagreement_test {

using props::Finding;
using props::VerdictKind;

model::Scenario pair_of_participants() {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = model::Nanoseconds{100'000};
  return scenario;
}

/// Writers take what an ACKNACK lists as acknowledged.
model::Mutation acknowledges_what_is_listed() {
  for (const fsm::MachineInfo& machine : fsm::machines()) {
    if (machine.name != "DescriptorRepair") continue;
    for (std::size_t k = 0; k < machine.rows.size(); ++k) {
      const fsm::RowInfo& row = machine.rows[k];
      if (machine.states[row.source] != "U" || machine.states[row.target] != "A") continue;
      model::Mutation mutation;
      mutation.tables.push_back(
          {std::string{machine.name}, k, fsm::TableMutation::Kind::ignore_guard, 0, 0});
      return mutation;
    }
  }
  return {};
}

Finding find(const Request& request, std::string_view property) {
  const std::array ids{property};
  return explore(ids, request).at(0).second;
}

TEST(Disagreement, OfExplorerAndSimulatorIsADispute) {
  const model::Scenario scenario = pair_of_participants();
  Request request{scenario, nullptr, {}};
  EXPECT_EQ(find(request, "safety.ack-implies-received").kind, VerdictKind::bounded);
  request.misread = acknowledges_what_is_listed();
  ASSERT_FALSE(request.misread.tables.empty());
  const Finding finding = find(request, "safety.ack-implies-received");
  EXPECT_EQ(finding.kind, VerdictKind::disputed) << finding.how;
  EXPECT_FALSE(finding.counterexample);
}

TEST(CutShort, ASearchEstablishesNothingBeyondTheScopesThatItExhausted) {
  const model::Scenario scenario = pair_of_participants();
  const Request none{scenario, nullptr, {}, 1, 0};  // no states at all
  const Finding finding = find(none, "live.no-stall");
  EXPECT_EQ(finding.kind, VerdictKind::inconclusive);
  EXPECT_NE(finding.how.find("no scope was exhausted"), std::string::npos) << finding.how;
}

}  // namespace disagreement_test
}  // namespace stormproof::explorer
