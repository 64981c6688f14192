// The model of Fast DDS's writer: descriptors that exist when the reader is matched are pulled,
// those that are created afterwards are pushed, HEARTBEATs say how many there are, ACKNACKs have a
// base, and initial ACKNACKs make the writer forget what it took as acknowledged
// (specs/guide/fastdds.md).
#include "fsm/change_for_reader.hpp"

#include "checker/engines/promela/promela.hpp"
#include "checker/engines/promela/relation_text.hpp"
#include "checker/engines/promela/table_macros.hpp"

namespace stormproof::promela {
namespace {

using ChangeMachine = fsm::ChangeForReader;

Requests change_requests(const TableMacros<ChangeMachine>::Output& output) {
  return {{"requested", output.requested}, {"generated", output.enqueue}};
}

/// How many descriptors exist at the match is chosen by the state in which `created` stops in init.
constexpr std::string_view change_start_and_reader = R"(
#define ANNOUNCED created
#define TAKE(d) received = received | (1 << (d)); announced = (announced > (d) -> announced : (d) + 1)

byte created;          /* descriptors that exist */
byte announced;        /* descriptors that the reader knows to exist */
bool heartbeat_seen;
bool matched;
bool initial_acknack;  /* in flight */

init {{
  do
  :: created < DESCRIPTORS -> created++
  :: break
  od;
  true;
  d_step {{
{}    matched = true
  }}
}}

active proctype HeartbeatReception() {{
end:
  do
  :: d_step {{
       heartbeat != 0 && !acknack_due ->
       heartbeat_seen = true;
       announced = (announced > heartbeat - 1 -> announced : heartbeat - 1);
       heartbeat = 0; acknack_due = true
     }}
  od
}}
)";
constexpr std::string_view match =
    R"(    if
    :: {0} < created -> ReaderMatched({0}, 0)
    :: else
    fi;
)";

constexpr std::string_view acknack_generation = R"(
/* Base and bitmap are a snapshot of this instant. */
active proctype AckNackGeneration() {{
  byte base;
end:
  do
  :: d_step {{
       acknack_due && nfull(acknack) -> acknack_due = false;
       base = 0;
{}       acknack!base, ~received & ((1 << announced) - 1);
       base = 0
     }}
  :: d_step {{ matched && !heartbeat_seen && !initial_acknack -> initial_acknack = true }}
  od
}}
)";
constexpr std::string_view count_prefix =
    "       base = (base == {0} && (received >> {0} & 1) -> {0} + 1 : base);\n";

constexpr std::string_view change_acknack_reception = R"(
/* Inputs of AckNackReceived: listed, below_base. */
active proctype AckNackReception() {{
  byte base, asked;
end:
  do
  :: d_step {{
       acknack?base, asked;
{}       base = 0; asked = 0
     }}
  od
}}
)";
constexpr std::string_view change_receive_acknack =
    R"(       AckNackReceived({0}, (asked >> {0} & 1) + (base > {0} -> 2 : 0));
       repair_due = repair_due || requested[{0}]; requested[{0}] = false;
)";

constexpr std::string_view initial_acknack_reception = R"(
active proctype InitialAckNackReception() {{
end:
  do
  :: d_step {{
       initial_acknack -> initial_acknack = false;
{}     }}
  od
}}
)";

constexpr std::string_view creation = R"(
active proctype Creation() {{
end:
  do
{}  od
}}
)";
constexpr std::string_view create =
    R"(  :: d_step {{
       matched && created == {0} -> created = {0} + 1;
       Created({0}, 0);
       SEND_IF_QUEUED({0})
     }}
)";

constexpr std::string_view nack_response = R"(
active proctype NackResponse() {{
end:
  do
  :: d_step {{
       repair_due -> repair_due = false;
{}     }}
  od
}}
)";
constexpr std::string_view enqueue =
    R"(       NackResponseDue({0}, 0);
       backlog = backlog | (generated[{0}] << {0}); generated[{0}] = false;
)";

constexpr std::string_view async_run = R"(
active proctype AsyncRun() {{
end:
  do
{}  od
}}
)";
constexpr std::string_view serialize =
    R"(  :: d_step {{ backlog >> {0} & 1 -> backlog = backlog & ~(1 << {0}); SEND_IF_QUEUED({0}) }}
)";

constexpr std::string_view sending = R"(
/* Only a descriptor in Q is serialized into a message; its suppression begins. */
inline SEND_IF_QUEUED(d) {
  if
  :: state[d] == Q -> Serialized(d, 0); suppression_due = true; air = air | (1 << d)
  :: else
  fi
}
)";

constexpr std::string_view change_suppression_end = R"(
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

std::string promela_of_change_for_reader(unsigned descriptors,
                                         std::span<const fsm::TableMutation> mutations) {
  const TableMacros<ChangeMachine> table{mutations, change_requests};
  const auto process = [&](std::string_view text, std::string_view for_each) {
    return fmt::format(fmt::runtime(text), each_descriptor(descriptors, for_each));
  };
  return preamble("ChangeForReader", descriptors) + table.text() + variables(descriptors) +
         std::string{sending} + process(change_start_and_reader, match) +
         process(acknack_generation, count_prefix) +
         process(change_acknack_reception, change_receive_acknack) +
         process(initial_acknack_reception, "       InitialAckNackReceived({0}, 0);\n") +
         process(creation, create) + process(nack_response, enqueue) +
         process(async_run, serialize) +
         process(change_suppression_end, "       SuppressionEnded({0}, 0);\n") +
         processes(descriptors) + claims(descriptors);
}

}  // namespace stormproof::promela
