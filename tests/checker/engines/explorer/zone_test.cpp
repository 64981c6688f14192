// Zones against brute force: the same operations on an explicit set of integer times. Every bound
// of a zone in canonical form is attained by some member of the set, and an operation that the zone
// calls impossible leaves the set empty.
#include "checker/engines/explorer/zone.hpp"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace stormproof::explorer {
namespace zone_test {

/// All solutions; column 0 is the present.
class Solutions {
 public:
  void add(std::int64_t low, std::int64_t high) {
    std::vector<std::vector<std::int64_t>> next;
    for (const auto& row : rows_) {
      for (std::int64_t delay = low; delay <= high; ++delay) {
        next.push_back(row);
        next.back().push_back(row[0] + delay);
      }
    }
    rows_ = std::move(next);
  }
  void constrain(unsigned a, unsigned b, std::int64_t c) {
    std::erase_if(rows_, [&](const auto& row) { return row[a] - row[b] > c; });
  }
  void advance(unsigned e, const Zone::Limits& limits) {
    const unsigned count = columns();
    for (unsigned f = 1; f < count; ++f) {
      if (f != e && limits[f] != Zone::free) constrain(e, f, limits[f]);
    }
    for (auto& row : rows_) {
      row[0] = row[e];
      row.erase(row.begin() + e);
    }
  }
  void remove(unsigned v) {
    for (auto& row : rows_) row.erase(row.begin() + v);
  }
  [[nodiscard]] bool empty() const { return rows_.empty(); }
  [[nodiscard]] unsigned columns() const { return static_cast<unsigned>(rows_[0].size()); }
  [[nodiscard]] std::int64_t bound(unsigned a, unsigned b) const {
    std::int64_t most = INT64_MIN;
    for (const auto& row : rows_) most = std::max(most, row[a] - row[b]);
    return most;
  }

 private:
  std::vector<std::vector<std::int64_t>> rows_{{0}};
};

void expect_equal(const Zone& zone, const Solutions& solutions) {
  ASSERT_EQ(zone.size(), solutions.columns());
  for (unsigned a = 0; a < zone.size(); ++a) {
    for (unsigned b = 0; b < zone.size(); ++b) {
      ASSERT_EQ(zone.bound(a, b), solutions.bound(a, b)) << a << " - " << b;
    }
  }
}

TEST(Zone, AgreesWithBruteForceOnRandomOperations) {
  std::mt19937 random{7};
  const auto draw = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  for (int round = 0; round < 400; ++round) {
    Zone zone;
    Solutions solutions;
    for (int step = 0; step < 8; ++step) {
      const auto other = [&] {
        return static_cast<unsigned>(draw(0, static_cast<int>(zone.size()) - 1));
      };
      switch (draw(0, 3)) {
        case 0:
          if (zone.size() < 5) {
            const int low = draw(0, 3);
            const int high = low + draw(0, 3);
            const unsigned added = zone.add(low, high);
            ASSERT_EQ(added, zone.size() - 1);
            solutions.add(low, high);
          }
          break;
        case 1: {
          const unsigned a = other();
          const unsigned b = other();
          const int c = draw(-3, 3);
          Solutions tried = solutions;
          tried.constrain(a, b, c);
          ASSERT_EQ(zone.constrain(a, b, c), !tried.empty());
          if (!tried.empty()) solutions = tried;
          break;
        }
        case 2: {
          if (zone.size() < 2) break;
          const auto e = static_cast<unsigned>(draw(1, static_cast<int>(zone.size()) - 1));
          Zone::Limits limits;
          for (std::int64_t& limit : limits) limit = draw(0, 2) == 0 ? Zone::free : draw(-1, 0);
          Solutions tried = solutions;
          tried.advance(e, limits);
          ASSERT_EQ(zone.can_be_next(e, limits), !tried.empty());
          if (tried.empty()) break;
          zone.advance(e, limits);
          solutions = tried;
          break;
        }
        default: {
          if (zone.size() < 3) break;
          const auto v = static_cast<unsigned>(draw(1, static_cast<int>(zone.size()) - 1));
          zone.remove(v);
          solutions.remove(v);
          break;
        }
      }
      expect_equal(zone, solutions);
    }
  }
}

TEST(Zone, AConstraintThatNothingSatisfiesIsRefused) {
  Zone zone;
  const unsigned a = zone.add(2, 4);
  const unsigned b = zone.add(5, 6);
  EXPECT_FALSE(zone.constrain(b, a, 0));
  EXPECT_EQ(zone.bound(b, a), 4);
  EXPECT_TRUE(zone.constrain(b, a, 1));
  EXPECT_EQ(zone.bound(a, 0), 4);
  EXPECT_EQ(zone.bound(0, a), -4);
  EXPECT_EQ(zone.bound(b, 0), 5);
}

TEST(Zone, ATieIsDecidedByItsLimit) {
  Zone zone;
  zone.add(3, 3);
  zone.add(3, 3);
  Zone::Limits limits{};
  EXPECT_TRUE(zone.can_be_next(1, limits));
  limits[2] = -1;  // the other one goes first at the same time
  EXPECT_FALSE(zone.can_be_next(1, limits));
}

}  // namespace zone_test
}  // namespace stormproof::explorer
