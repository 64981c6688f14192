// One vocabulary: the classes of the model stand among the measures under their own names.
#include "checker/experiments/statistics/measure.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "model/counts.hpp"

namespace stormproof::statistics {
namespace measure_test {

TEST(Measures, HaveDistinctNamesAndWords) {
  std::set<std::string> names, words;
  for (std::size_t k = 0; k < measure_count; ++k) {
    names.insert(name_of(static_cast<Measure>(k)));
    words.insert(words_of(static_cast<Measure>(k)));
  }
  EXPECT_EQ(names.size(), measure_count);
  EXPECT_EQ(words.size(), measure_count);
  EXPECT_STREQ(name_of(Measure::completion), "completion");
  EXPECT_STREQ(name_of(Measure::messages), "messages");
  EXPECT_STREQ(words_of(Measure::messages), "messages");
  EXPECT_STREQ(name_of(Measure::backlog), "backlog");
  EXPECT_STREQ(words_of(Measure::backlog), "highest backlog");
}

TEST(Measures, ContainTheMessageClasses) {
  for (const model::MessageClass one : model::message_classes) {
    EXPECT_STREQ(name_of(measure_of(one)), model::name_of(one));
    EXPECT_STREQ(words_of(measure_of(one)), model::words_of(one));
  }
}

TEST(MessageClasses, AreTheCountsOfTheModel) {
  model::Counts counts{1, 2, 3, 4, 5, 6};
  for (const model::MessageClass one : model::message_classes) {
    EXPECT_EQ(counts[one], model::index_of(one) + 1);
    const auto [name, value] = counts.entries()[model::index_of(one)];
    EXPECT_STREQ(name, model::name_of(one));
    EXPECT_EQ(value, counts[one]);
  }
  counts[model::MessageClass::heartbeat] = 30;
  EXPECT_EQ(counts.heartbeat, 30U);
  EXPECT_EQ(counts.spdp(), 11U);
  EXPECT_EQ(counts.total(), 48U);
}

}  // namespace measure_test
}  // namespace stormproof::statistics
