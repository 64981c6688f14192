// The table of packets under way against std::map, over pages that come and go.
#include "props/monitors/number_map.hpp"

#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace stormproof::props {
namespace number_map_test {

RC_GTEST_PROP(NumberMap, RemembersWhatAMapRemembers, ()) {
  NumberMap<int> table;
  std::map<std::uint64_t, int> reference;
  const auto steps = *rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(0, 5), rc::gen::inRange(0, 4'000)));
  int value = 0;
  for (const auto& [step, raw] : steps) {
    const auto number = static_cast<std::uint64_t>(raw);
    if (step < 3) {
      int* const place = table.add(number);
      RC_ASSERT((place != nullptr) == reference.emplace(number, value).second);
      if (place != nullptr) *place = value;
      ++value;
    } else {
      table.remove(number);
      reference.erase(number);
    }
    const int* const found = table.find(number);
    RC_ASSERT((found != nullptr) == (reference.count(number) > 0));
  }
  for (std::uint64_t number = 0; number < 4'000; ++number) {
    const int* const found = table.find(number);
    const auto expected = reference.find(number);
    RC_ASSERT((found != nullptr) == (expected != reference.end()));
    if (found != nullptr) RC_ASSERT(*found == expected->second);
  }
}

}  // namespace number_map_test
}  // namespace stormproof::props
