// Rows and the verdict of --within, from figures made by hand.
#include <gtest/gtest.h>

#include "checker/evidence/validate/validate.hpp"
#include "checker/experiments/statistics/completion.hpp"

namespace stormproof::validate::testing {
namespace comparison_test {

using statistics::unreached;

const std::vector<double> hundred_to_hundred_twenty{100, 105, 110, 115, 120};

TEST(Row, RatioAndRange) {
  const Row one = row(Figure::total, 55.0, hundred_to_hundred_twenty, true);
  EXPECT_DOUBLE_EQ(*one.median, 110);
  EXPECT_DOUBLE_EQ(*one.ratio, 2);
  EXPECT_DOUBLE_EQ(*one.low, 101);
  EXPECT_DOUBLE_EQ(*one.high, 119);
}

TEST(Row, SaysWhereTheObservationLies) {
  const auto position = [](double observed) {
    return row(Figure::total, observed, hundred_to_hundred_twenty, true).position;
  };
  EXPECT_EQ(position(110), Position::inside);
  EXPECT_EQ(position(101), Position::inside);
  EXPECT_EQ(position(100.5), Position::below);
  EXPECT_EQ(position(119.5), Position::above);
}

TEST(Row, OneRunHasNoRange) {
  EXPECT_EQ(row(Figure::total, 100.0, {100}, false).position, Position::unknown);
  EXPECT_DOUBLE_EQ(*row(Figure::total, 100.0, {100}, false).ratio, 1);
}

TEST(Row, IncompleteRunsLieAboveAllOthers) {
  const Row some = row(Figure::total, 500.0, {100, 105, 110, unreached, unreached}, true);
  EXPECT_DOUBLE_EQ(*some.median, 110);
  EXPECT_FALSE(some.high);
  EXPECT_EQ(some.position, Position::inside);
  const Row most =
      row(Figure::total, 50.0, {100, unreached, unreached, unreached, unreached}, true);
  EXPECT_FALSE(most.median);
  EXPECT_FALSE(most.ratio);
}

TEST(Row, WhatIsNotObservedHasNoRatio) {
  EXPECT_FALSE(row(Figure::repair_data, 0.0, {5}, true).ratio);
  EXPECT_FALSE(row(Figure::user_control, {}, {5}, true).ratio);
  EXPECT_FALSE(row(Figure::total, 5.0, {}, true).median);
}

std::vector<Row> rows(std::optional<double> completion, std::optional<double> total) {
  std::vector<Row> result(figure_count);
  result[index_of(Figure::completion)].ratio = completion;
  result[index_of(Figure::total)].ratio = total;
  return result;
}

TEST(Agreement, WithinAndBeyondTheFactor) {
  EXPECT_EQ(agreement(rows(1.4, 0.7), true, 1.5), Agreement::within);
  EXPECT_EQ(agreement(rows(1.6, 1.0), true, 1.5), Agreement::beyond);
  EXPECT_EQ(agreement(rows(0.6, 1.0), true, 1.5), Agreement::beyond);
  EXPECT_EQ(agreement(rows(1.0, 1.6), true, 1.5), Agreement::beyond);
  EXPECT_EQ(agreement(rows(1.0, 0.6), true, 1.5), Agreement::beyond);
}

TEST(Agreement, UndecidedWithoutFigures) {
  EXPECT_EQ(agreement(rows(1.0, 1.0), false, 1.5), Agreement::undecided);
  EXPECT_EQ(agreement(rows({}, 1.0), true, 1.5), Agreement::undecided);
  EXPECT_EQ(agreement(rows(9.0, 1.0), true, {}), Agreement::not_asked);
}

}  // namespace comparison_test
}  // namespace stormproof::validate::testing
