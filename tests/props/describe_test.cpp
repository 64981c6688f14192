// Times in the reasons of violations are exact.
#include "props/monitors/describe.hpp"

#include <gtest/gtest.h>

namespace stormproof::props {
namespace describe_test {

std::string text(std::int64_t ns) { return time_text(model::Nanoseconds{ns}); }

TEST(TimeText, IsExactInTheLargestUnit) {
  EXPECT_EQ(text(0), "0 ns");
  EXPECT_EQ(text(999), "999 ns");
  EXPECT_EQ(text(1'000), "1 µs");
  EXPECT_EQ(text(10'500), "10.5 µs");
  EXPECT_EQ(text(16'136'228), "16.136228 ms");
  EXPECT_EQ(text(2'000'000'000), "2 s");
  EXPECT_EQ(text(1'000'000'001), "1.000000001 s");
  EXPECT_EQ(text(-1'500), "-1.5 µs");
}

TEST(WriterText, NamesParticipantAndStream) {
  EXPECT_EQ(writer_text(6), "participant 3's pub writer");
  EXPECT_EQ(writer_text(7), "participant 3's sub writer");
}

}  // namespace describe_test
}  // namespace stormproof::props
