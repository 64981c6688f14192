// Cyclone DDS whose participants have a life, against the table of test vectors: when discovery was
// complete for the last time, and what had been sent by then.
#include <gtest/gtest.h>

#include "model/life.hpp"
#include "model/simulator.hpp"
#include "tests/vectors/cyclone_life_vectors.hpp"

namespace stormproof {
namespace cyclone_life_test {

std::optional<std::int64_t> ns(const std::optional<model::Nanoseconds>& time) {
  if (!time) return {};
  return time->count();
}

vectors::LifeExpected outcome(const model::RunResult& result) {
  const model::SentUntil& sent = result.until_discovery.value();
  const auto number = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
  vectors::LifeExpected actual{ns(result.discovery_time),
                               ns(result.recovery_time),
                               number(sent.forgotten),
                               number(sent.counts.initial_data),
                               number(sent.counts.repair_data),
                               number(sent.counts.heartbeat),
                               number(sent.counts.acknack),
                               number(sent.counts.gap),
                               number(sent.counts.spdp_multicast),
                               number(sent.counts.spdp_unicast),
                               number(sent.user_control)};
  if (result.discovery_time) actual.since_last_failure = number(sent.since_last_failure);
  return actual;
}

void PrintTo(const vectors::LifeExpected& e, std::ostream* out) {
  *out << "t " << e.t_disc_ns.value_or(-1) << " recovery " << e.recovery_ns.value_or(-1)
       << " forgotten " << e.forgotten << " initial " << e.initial_data << " repair "
       << e.repair_data << " heartbeat " << e.heartbeat << " acknack " << e.acknack << " gap "
       << e.gap << " spdp " << e.spdp_multicast << " + " << e.spdp_unicast << " user_control "
       << e.user_control << " since " << e.since_last_failure.value_or(-1);
}

class CycloneLife : public testing::TestWithParam<vectors::LifeVector> {};

TEST_P(CycloneLife, AgreesExactly) {
  const vectors::LifeExpected actual = outcome(model::simulate(GetParam().scenario));
  EXPECT_TRUE(actual == GetParam().expected)
      << "is       " << testing::PrintToString(actual) << "\nexpected "
      << testing::PrintToString(GetParam().expected);
}

const auto name = [](const auto& tested) { return tested.param.name; };
INSTANTIATE_TEST_SUITE_P(Vectors, CycloneLife, testing::ValuesIn(vectors::cyclone_life_vectors()),
                         name);

}  // namespace cyclone_life_test
}  // namespace stormproof
