// What DATA(p) of each vendor shows of its version, and that nonsense shows none.
#include "checker/evidence/capture/library_version.hpp"

#include <array>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace stormproof::capture {
namespace library_version_test {

constexpr VendorId connext = 0x0101;
constexpr VendorId cyclonedds = 0x0110;

std::string version(VendorId vendor, std::uint16_t id, const std::vector<std::uint8_t>& value) {
  return library_version(vendor, {{id, Bytes{value}}}, ByteOrder::little);
}

/// Cyclone's parameter: five words of flags, and a string with its length.
std::vector<std::uint8_t> info(std::string_view text) {
  std::vector<std::uint8_t> value(20, 0);
  value.push_back(static_cast<std::uint8_t>(text.size() + 1));
  value.insert(value.end(), 3, 0);
  value.insert(value.end(), text.begin(), text.end());
  value.push_back(0);
  return value;
}

TEST(LibraryVersion, OfFastDds) {
  EXPECT_EQ(library_version(fastdds_vendor, {}, ByteOrder::little), "2.x before 2.12");
  EXPECT_EQ(version(fastdds_vendor, 0x8007, {0, 0, 0, 0}), "2.x from 2.12 on");
  EXPECT_EQ(version(fastdds_vendor, 0x8000, {3, 2, 5, 0}), "3.2.5");
  EXPECT_EQ(version(fastdds_vendor, 0x8000, {3, 2}), "") << "two octets are no version";
}

TEST(LibraryVersion, OfCycloneDds) {
  EXPECT_EQ(version(cyclonedds, 0x8007, info("robot/0.10.2/Linux/Linux")), "0.10.2");
  EXPECT_EQ(version(cyclonedds, 0x8007, info("robot/\x1b[31m/Linux")), "");
  EXPECT_EQ(version(cyclonedds, 0x8007, info("robot")), "");
  EXPECT_EQ(version(cyclonedds, 0x8007, {1, 2, 3}), "");
  EXPECT_EQ(library_version(cyclonedds, {}, ByteOrder::little), "");
}

TEST(LibraryVersion, OfOthers) {
  EXPECT_EQ(version(connext, 0x8000, {7, 3, 0, 0}), "7.3.0");
  EXPECT_EQ(version(0x0103, 0x8000, {7, 3, 0, 0}), "") << "its numbers mean what its vendor says";
}

}  // namespace library_version_test
}  // namespace stormproof::capture
