// Mermaid diagrams of machines.
#include <algorithm>

#include <gtest/gtest.h>

#include "checker/presentation/diagrams/draw_machine.hpp"
#include "checker/presentation/diagrams/mermaid_text.hpp"
#include "fsm/machines.hpp"

namespace stormproof::draw {
namespace mermaid_test {

fsm::MachineInfo machine_named(std::string_view name) {
  const auto machines = fsm::machines();
  return *std::ranges::find(machines, name, &fsm::MachineInfo::name);
}

TEST(Mermaid, DrawsTheTable) {
  EXPECT_EQ(draw_machine(machine_named("DescriptorRepair"), Format::mermaid),
            R"(stateDiagram-v2
  %% DescriptorRepair
  [*] --> U
  U : U unacknowledged
  R : R requested
  Q : Q queued for repair
  S : S sent and suppressed
  A : A acknowledged
  U --> R : AckNackReceived [Listed] / Request
  R --> Q : RepairDue / Generate
  Q --> S : RepairSent
  S --> U : SuppressionEnded / Return
  U --> A : AckNackReceived [Confirmed]
  R --> A : AckNackReceived [Confirmed]
  Q --> A : AckNackReceived [Confirmed]
  S --> A : AckNackReceived [Confirmed]
)");
}

TEST(Mermaid, AChangedTableChangesTheDrawing) {
  fsm::MachineInfo machine = machine_named("SingleShot");
  const std::string before = draw_machine(machine, Format::mermaid);
  machine.rows[0].target = machine.rows[0].source;
  const std::string after = draw_machine(machine, Format::mermaid);
  EXPECT_NE(before.find("Idle --> Pending : Requested / Schedule"), std::string::npos);
  EXPECT_NE(after.find("Idle --> Idle : Requested / Schedule"), std::string::npos);
}

TEST(Mermaid, TextsCannotBecomeSyntax) {
  EXPECT_EQ(mermaid_text("a; b #1 <c>\n100 %"), "a#59; b #35;1 #lt;c#gt; 100 #37;");
}

}  // namespace mermaid_test
}  // namespace stormproof::draw
