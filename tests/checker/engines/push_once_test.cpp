// The third composition (tests/model/push_once) is proved, explored and given to SPIN, with its
// rules and nothing else.
#include "tests/model/push_once/push_once.hpp"

#include <gtest/gtest.h>

#include "checker/engines/explorer/relation_world.hpp"
#include "checker/engines/explorer/search.hpp"
#include "checker/engines/promela/promela.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/engines/tables/descriptor_system.hpp"
#include "fsm/program/record.hpp"
#include "model/engine/implementation_maker.hpp"
#include "tests/checker/engines/explorer/enumeration.hpp"
#include "tests/checker/engines/explorer/tiny.hpp"
#include "tests/checker/engines/promela/run_in_test.hpp"
#include "tests/model/push_once/push_once_host.hpp"

namespace stormproof {
namespace push_once_test {

namespace push_once = fsm::composition::push_once;

/// Whether it is proved that `bad` cannot be reached, for any number of descriptors and readers.
props::VerdictKind decide(const char* name, bool negated_x) {
  smt::Claims claims{{.second_solver = false}};
  const model::Scenario scenario;
  const checker::CheckRequest request{
      .scenario = scenario, .claims = claims, .mutant = nullptr, .on_progress = {}};
  tables::Proof proof{"safety.ack-implies-received", request};
  const auto program = fsm::program::recorded<push_once::PushOnce>();
  const tables::DescriptorSystem system{program, scenario.dds, model::Mutation{}};
  const tables::Expr bad = negated_x ? system[name] && !system["X"] : system[name];
  return proof.finish(tables::prove_unreachable(proof, system.with_bad(bad), name)).kind;
}

TEST(PushOnceProofs, HoldForAnyNumberOfDescriptorsAndReaders) {
  using enum props::VerdictKind;
  EXPECT_EQ(decide("C=A", true), proved);   // what is acknowledged has been received
  EXPECT_EQ(decide("C=R", false), proved);  // nothing is ever requested
  EXPECT_EQ(decide("C=A", false), violated);
  EXPECT_EQ(decide("pending AckNackGeneration", false), violated);
}

/// Explored by its rules alone: what they leave to a host happens as its contract says.
class World : public explorer::RelationWorld {
 public:
  World(const model::Scenario& running, const model::Scenario& specification,
        const explorer::Scope& scope, const model::Mutation& mutation)
      : RelationWorld{rules_of_push_once(), running, specification, scope, mutation} {}

 private:
  static const fsm::program::Program& rules_of_push_once() {
    static const auto program = fsm::program::recorded<push_once::PushOnce>();
    return program;
  }
};

bool stalls(unsigned losses) {
  explorer::Scope scope;
  scope.descriptors = 2;
  scope.losses = losses;
  scope.least_delay = model::Nanoseconds{1};
  scope.largest_delay = model::Nanoseconds{3};
  const model::Scenario scenario = explorer::tiny_scenario();
  World world{scenario, scenario, scope, {}};
  explorer::SearchOptions options;
  options.claims = explorer::bit(explorer::Claim::no_stall);
  const explorer::SearchResult result = explorer::Search<World>{world, options}.run();
  EXPECT_TRUE(result.exhausted() || losses > 0);
  return result.objections[static_cast<std::size_t>(explorer::Claim::no_stall)].has_value();
}

TEST(PushOnceExplorer, DoesWhatTheSimulatorDoes) {
  const auto maker = model::maker_of<model::PushOnceHost>(model::SameHostPairs::left_out);
  explorer::Scope scope;
  scope.descriptors = 2;
  scope.losses = 1;
  scope.least_delay = model::Nanoseconds{1};
  scope.largest_delay = model::Nanoseconds{3};
  const model::Scenario scenario = explorer::tiny_scenario();
  EXPECT_GT(explorer::expect_equal_outcomes<World>(scenario, scope, &maker), 20U);
}

TEST(PushOnceExplorer, StallsExactlyIfSomethingIsLost) {
  EXPECT_FALSE(stalls(0));
  EXPECT_TRUE(stalls(1));
}

class PushOncePromela : public promela::SpinTest {};

/// What is lost is not sent again: everything stands still with something unacknowledged.
TEST_F(PushOncePromela, IsSafeAndStandsStill) {
  const std::string model =
      promela::promela_of(fsm::program::recorded<push_once::PushOnce>(), 2, {});
  expect_error(model, "progress: pan:1: acceptance cycle");
  expect_error(model.substr(0, model.find("ltl progress")),
               "no deadlock: pan:1: invalid end state");
}

}  // namespace push_once_test
}  // namespace stormproof
