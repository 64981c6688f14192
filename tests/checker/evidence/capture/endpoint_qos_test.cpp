// What endpoints offer and request, from their bytes, and by which policies they refuse each other.
#include "checker/evidence/capture/endpoint_qos.hpp"

#include <gtest/gtest.h>

#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture {
namespace endpoint_qos_test {

using testing::Writer;

EndpointQos read(ParameterId id, const Writer& value) {
  EndpointQos qos;
  read_qos({id, value.buffer(), 0}, value.order(), qos);
  return qos;
}
Writer little() { return Writer{ByteOrder::little}; }

TEST(EndpointQos, IsReadInBothByteOrders) {
  EXPECT_EQ(read(ParameterId::reliability, little().u32(2).u32(0).u32(0)).is_reliable, true);
  EXPECT_EQ(read(ParameterId::reliability, Writer{}.u32(1).u32(0).u32(0)).is_reliable, false);
  EXPECT_EQ(read(ParameterId::durability, little().u32(1)).durability, 1U);
  EXPECT_EQ(read(ParameterId::deadline, Writer{}.u32(2).u32(0x80000000)).deadline_ns,
            2'500'000'000);
  EXPECT_EQ(read(ParameterId::deadline, little().u32(0x7fffffff).u32(0xffffffff)).deadline_ns,
            EndpointQos::infinite);
  const EndpointQos alive = read(ParameterId::liveliness, little().u32(2).u32(1).u32(0));
  EXPECT_EQ(alive.liveliness, 2U);
  EXPECT_EQ(alive.liveliness_ns, 1'000'000'000);
  EXPECT_TRUE(read(ParameterId::ownership, little().u32(1)).is_exclusive);
  EXPECT_EQ(read(ParameterId::destination_order, little().u32(1)).order, 1U);
  Writer names = little();
  names.u32(2).u32(2).text("a").u8(0).u16(0).u32(3).text("b*").u8(0).u8(0);
  EXPECT_EQ(read(ParameterId::partition, names).partitions, (std::vector<std::string>{"a", "b*"}));
}

TEST(EndpointQos, DamagedOnesAreTheDefault) {
  EXPECT_EQ(read(ParameterId::deadline, little().u16(1)).deadline_ns, EndpointQos::infinite);
  EXPECT_TRUE(read(ParameterId::partition, little().u32(0xffffffff).u32(9)).partitions.empty());
}

TEST(EndpointQos, DefaultsAgree) { EXPECT_TRUE(disagreements({}, {}).empty()); }

TEST(EndpointQos, EachPolicyIsNamedAndOneSidedOnesHaveADirection) {
  const auto only = [](const EndpointQos& offered, const EndpointQos& requested) {
    const auto found = disagreements(offered, requested);
    return found.size() == 1 ? found.front() : fmt::format("{} disagreements", found.size());
  };
  EndpointQos best;
  best.is_reliable = false;
  EndpointQos reliable;
  reliable.is_reliable = true;
  EXPECT_EQ(only(best, reliable), "reliability: offered best effort, requested reliable");
  EXPECT_TRUE(disagreements(reliable, best).empty());
  EndpointQos kept;
  kept.durability = 1;
  EXPECT_EQ(only({}, kept), "durability: offered volatile, requested transient local");
  EXPECT_TRUE(disagreements(kept, {}).empty());
  EndpointQos quick;
  quick.deadline_ns = 100'000'000;
  EXPECT_EQ(only({}, quick), "deadline: offered infinite, requested 0.1 s");
  EXPECT_TRUE(disagreements(quick, {}).empty());
  EndpointQos manual;
  manual.liveliness = 2;
  EXPECT_EQ(only({}, manual), "liveliness: offered automatic, requested manual by topic");
  EndpointQos lease;
  lease.liveliness_ns = 1'000'000'000;
  EXPECT_EQ(only({}, lease), "liveliness lease: offered infinite, requested 1 s");
  EndpointQos exclusive;
  exclusive.is_exclusive = true;
  EXPECT_EQ(only(exclusive, {}), "ownership: offered exclusive, requested shared");
  EXPECT_EQ(only({}, exclusive), "ownership: offered shared, requested exclusive");
  EndpointQos ordered;
  ordered.order = 1;
  EXPECT_EQ(only({}, ordered), "destination order: offered by reception, requested by source");
}

TEST(EndpointQos, PartitionsAgreeByNameOrPattern) {
  const auto agree = [](std::vector<std::string> some, std::vector<std::string> others) {
    EndpointQos one;
    one.partitions = std::move(some);
    EndpointQos other;
    other.partitions = std::move(others);
    return disagreements(one, other).empty();
  };
  EXPECT_TRUE(agree({"a", "b"}, {"b"}));
  EXPECT_TRUE(agree({"robot*"}, {"robot1"}));
  EXPECT_TRUE(agree({"robot1"}, {"robot*"}));
  EXPECT_TRUE(agree({}, {"*"}));
  EXPECT_FALSE(agree({"a"}, {"b"}));
  EXPECT_FALSE(agree({}, {"a"}));
}

}  // namespace endpoint_qos_test
}  // namespace stormproof::capture
