// Every published figure with what the model says about it: the core of the report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/experiments/reproduce/published.hpp"
#include "checker/experiments/reproduce/run.hpp"

namespace stormproof::reproduce {

/// How far the model's value is from the published one.
enum class Agreement : std::uint8_t {
  close,      ///< every number within a tenth of the published one
  apart,      ///< not so
  no_value,   ///< the model has no value: not run, interrupted, or not complete within the limit
  not_asked,  ///< an input, or a figure that a model cannot produce
};
[[nodiscard]] const char* name_of(Agreement agreement);

/// What counts as close: within this share of the published number.
inline constexpr double close_share = 0.1;

/// The value of one variant beside a published figure.
struct ModelValue {
  std::vector<double> values;                 ///< as many as are published, or none
  std::vector<std::optional<double>> ratios;  ///< model / published; none if that is 0
  Agreement agreement = Agreement::no_value;
  std::vector<std::size_t> reasons;  ///< positions in Published::reasons, if it is apart
};

struct Figure {
  PublishedFigure published;
  Kind kind{};
  std::string quantity;              ///< what the model's value is
  std::vector<ModelValue> models;    ///< by variant
  std::vector<std::size_t> reasons;  ///< of all variants, ascending, or why there is no value
};

/// One for each published figure, in their order.
[[nodiscard]] std::vector<Figure> compare(const Published& published, const Results& results);

}  // namespace stormproof::reproduce
