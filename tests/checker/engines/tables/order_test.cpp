// The order of events: a strict total order, receptions first, and the pairs for which it matters.
#include "model/engine/event_queue.hpp"
#include "model/event_order.hpp"
#include "tests/checker/engines/tables/table_check.hpp"

namespace stormproof::tables {
namespace order_test {

using checker::OrderRule;
using Kind = fsm::TableMutation::Kind;
using model::EventKind;
using model::EventMutation;
using model::Nanoseconds;

checker::Mutant with_order(OrderRule rule) {
  checker::Mutant mutant;
  mutant.order = rule;
  return mutant;
}

checker::Mutant with_class(EventKind kind, model::EventClass event_class) {
  checker::Mutant mutant;
  mutant.rules.events.push_back({kind, EventMutation::Change::reclass, Nanoseconds{}, event_class});
  return mutant;
}

TEST(EventOrder, TheQueuePacksClassAndInsertionAsTheProofSays) {
  model::EventQueue queue;
  for (const EventKind kind :
       {EventKind::dispatch, EventKind::heartbeat_expiry, EventKind::reception}) {
    (void)queue.schedule(Nanoseconds{5}, kind, 0);
  }
  for (const EventKind kind :
       {EventKind::reception, EventKind::heartbeat_expiry, EventKind::dispatch}) {
    const model::Event event = queue.pop();
    EXPECT_EQ(event.kind, kind);
    const auto event_class = static_cast<std::uint64_t>(model::class_of(kind));
    EXPECT_EQ(event.order, model::packed_order(event_class, event.insertion()));
  }
}

TEST(OrderTotal, IsProvedAndShowsTheCycleOfTheProse) {
  const Finding finding = decide("order.total", paper());
  EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
  EXPECT_TRUE(mentions(finding, "not transitive"));
  EXPECT_TRUE(mentions(finding, "reception (insertion"));
  for (const char* const law : {"irreflexive", "asymmetric", "transitive", "total"}) {
    EXPECT_TRUE(mentions(finding, std::string{law} + ": holds"));
  }
}

TEST(OrderTotal, ThePairwiseProseIsNotTransitive) {
  expect_violated("order.total", paper(), with_order(OrderRule::pairwise_prose),
                  "transitive fails");
}

TEST(OrderTotal, WithoutInsertionNumbersItIsNotTotal) {
  expect_violated("order.total", paper(), with_order(OrderRule::without_insertion), "total fails");
}

TEST(OrderReceptionFirst, IsProvedForBothImplementations) {
  expect_proved("order.reception-first", paper());
  expect_proved("order.reception-first", fastdds());
}

TEST(OrderReceptionFirst, WithoutClassesADecisionCanComeFirst) {
  expect_violated("order.reception-first", paper(), with_order(OrderRule::without_class),
                  "is processed before");
}

TEST(OrderReceptionFirst, AKindInTheWrongClassIsFound) {
  expect_violated("order.reception-first", paper(),
                  with_class(EventKind::delayed_reception, model::EventClass::protocol),
                  "before delayed_reception");
  expect_violated("order.reception-first", paper(),
                  with_class(EventKind::dispatch, model::EventClass::protocol), "dispatch");
  expect_violated("order.reception-first", paper(),
                  with_class(EventKind::acknack_generation, model::EventClass::service),
                  "acknack_generation");
}

TEST(OrderReceptionFirst, AServiceThatTakesNoTimeLeavesItOpen) {
  model::Scenario scenario;
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  const Finding finding = decide("order.reception-first", scenario);
  EXPECT_EQ(finding.kind, VerdictKind::inconclusive);
  EXPECT_TRUE(mentions(finding, "one_way is 0 ns"));
  scenario.wireless.one_way = Nanoseconds{1};
  expect_proved("order.reception-first", scenario);
  scenario.wireless.packet_delays = {{7, Nanoseconds{0}, Nanoseconds{0}}};
  const Finding one_packet = decide("order.reception-first", scenario);
  EXPECT_EQ(one_packet.kind, VerdictKind::inconclusive);
  EXPECT_TRUE(mentions(one_packet, "one_way of packet 7 is 0 ns"));
  model::Scenario same_host = fastdds();
  same_host.deployment.loopback_delay = Nanoseconds{0};
  EXPECT_EQ(decide("order.reception-first", same_host).kind, VerdictKind::inconclusive);
}

TEST(OrderCommutation, TheMatricesAreTheExpectedOnes) {
  expect_proved("order.commutation", paper());
  expect_proved("order.commutation", fastdds());
  const Finding finding = decide("order.commutation", paper());
  EXPECT_TRUE(mentions(finding, "ACKNACK generation, DATA received: the order matters"));
  EXPECT_TRUE(mentions(finding, "witness: from "));
}

TEST(OrderCommutation, AMistakeInATableChangesTheMatrix) {
  // A suppression that does not end commutes with an ACKNACK.
  const std::size_t ends = row_of("DescriptorRepair", "S", "SuppressionEnded", "U");
  expect_violated("order.commutation", paper(), with_row("DescriptorRepair", ends, Kind::drop_row),
                  "the order does not matter, but expected is: the order matters");
  const std::size_t response = row_of("ChangeForReader", "R", "NackResponseDue", "Q");
  expect_violated("order.commutation", fastdds(),
                  with_row("ChangeForReader", response, Kind::drop_row), "nack response");
  // Requests that are taken while suppressed.
  const std::size_t request = row_of("DescriptorRepair", "U", "AckNackReceived", "R");
  expect_violated("order.commutation", paper(),
                  with_row("DescriptorRepair", request, Kind::copy_row,
                           state_of("DescriptorRepair", "Q"), state_of("DescriptorRepair", "R")),
                  "source completion");
}

}  // namespace order_test
}  // namespace stormproof::tables
