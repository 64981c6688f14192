// The model of the paper's writer: initial DATA of all descriptors, then HEARTBEAT, ACKNACK and
// repair until everything is acknowledged (specs/guide/model.md, "The reader", "The writer").
#include "fsm/descriptor_repair.hpp"

#include "checker/engines/promela/promela.hpp"
#include "checker/engines/promela/relation_text.hpp"
#include "checker/engines/promela/table_macros.hpp"

namespace stormproof::promela {
namespace {

using RepairMachine = fsm::DescriptorRepair;

Requests requests(const TableMacros<RepairMachine>::Output& output) {
  return {{"requested", output.requested}, {"generated", output.generate}};
}

constexpr std::string_view start_and_reader = R"(
#define ANNOUNCED DESCRIPTORS
#define TAKE(d) received = received | (1 << (d))

bool prefix;  /* acknowledge: prefix */

init {
  d_step {
    air = ALL;  /* initial DATA */
    if
    :: prefix = false
    :: prefix = true
    fi
  }
}

active proctype HeartbeatReception() {
end:
  do
  :: d_step { heartbeat != 0 && !acknack_due -> heartbeat = 0; acknack_due = true }
  od
}

/* The bitmap is a snapshot: what is missing now. */
active proctype AckNackGeneration() {
end:
  do
  :: d_step { acknack_due && nfull(acknack) -> acknack_due = false; acknack!0, ALL & ~received }
  od
}
)";

constexpr std::string_view acknack_reception = R"(
/* Inputs of AckNackReceived: listed, below_first_missing, prefix_only. */
active proctype AckNackReception() {{
  byte missing;
end:
  do
  :: d_step {{
       acknack?_, missing;
{}       missing = 0
     }}
  od
}}
)";
constexpr std::string_view receive_acknack =
    R"(       AckNackReceived({0}, (missing >> {0} & 1)
         + ((missing & ((2 << {0}) - 1)) == 0 -> 2 : 0) + (prefix -> 4 : 0));
       repair_due = repair_due || requested[{0}]; requested[{0}] = false;
)";

constexpr std::string_view repair_generation = R"(
active proctype RepairGeneration() {{
end:
  do
  :: d_step {{
       repair_due -> repair_due = false;
{}     }}
  od
}}
)";
constexpr std::string_view generate_repair =
    R"(       RepairDue({0}, 0);
       backlog = backlog | (generated[{0}] << {0}); generated[{0}] = false;
)";

constexpr std::string_view source_completion = R"(
active proctype SourceCompletion() {{
end:
  do
{}  od
}}
)";
constexpr std::string_view leave_source =
    R"(  :: d_step {{
       backlog >> {0} & 1 -> backlog = backlog & ~(1 << {0});
       RepairSent({0}, 0);
       suppression_due = true; air = air | (1 << {0})
     }}
)";

constexpr std::string_view suppression_end = R"(
active proctype SuppressionEnd() {{
end:
  do
  :: d_step {{
       suppression_due -> suppression_due = false;
{}     }}
  od
}}
)";

}  // namespace

std::string promela_of_descriptor_repair(unsigned descriptors,
                                         std::span<const fsm::TableMutation> mutations) {
  const TableMacros<RepairMachine> table{mutations, requests};
  const auto process = [&](std::string_view text, std::string_view for_each) {
    return fmt::format(fmt::runtime(text), each_descriptor(descriptors, for_each));
  };
  return preamble("DescriptorRepair", descriptors) + table.text() + variables(descriptors) +
         std::string{start_and_reader} + process(acknack_reception, receive_acknack) +
         process(repair_generation, generate_repair) + process(source_completion, leave_source) +
         process(suppression_end, "       SuppressionEnded({0}, 0);\n") + processes(descriptors) +
         claims(descriptors);
}

}  // namespace stormproof::promela
