// What a search returns has changed every knob a little, most of them for nothing, and some further
// than it helps. A user wants two lines of XML, not nine, and no send buffer of 60 MB where 10 MB
// do: this sets knobs back one after the other, and then moves those that remain part of the way
// back, as long as the result is not clearly worse than what the search found.
#pragma once

#include "checker/experiments/statistics/paired.hpp"
#include "checker/experiments/tune/outcome.hpp"

namespace stormproof::tune {

using statistics::Shift;

/// The costs of two settings compared seed by seed: shifts of ln(candidate / reference), because
/// settings change costs by factors.
struct Difference {
  Shift completion;
  Shift messages;
};

/// Both must have been run under the same seeds.
[[nodiscard]] Difference difference(const std::vector<Outcome>& candidate,
                                    const std::vector<Outcome>& reference,
                                    double confidence = statistics::confidence_level);

/// Whether the candidate costs more: beyond chance, and by more than the share `least`.
[[nodiscard]] bool is_clearly_more(const Shift& shift, double least);
/// Whether it costs less: beyond chance, and so much less that the reference costs more than the
/// share `least` more.
[[nodiscard]] bool is_clearly_less(const Shift& shift, double least);

/// A step that costs clearly more than the setting as it came is given up after a part of its runs:
/// after as few as can say so with this confidence, or after twice as many, and so on. That is so
/// much that all looks together hardly add to the chance that the last one errs (the rule of
/// Haybittle and Peto); 1 looks once, after all runs.
inline constexpr double early_confidence = 0.999;

/// Each of `points` with as few and as small changes as do not make it clearly worse, in completion
/// or messages, than it was, or break anything. `seeds` should be new to the points, otherwise
/// chance that the search took for merit counts again. Nothing if interrupted.
[[nodiscard]] std::optional<std::vector<Point>> reduced(std::vector<Point> points,
                                                        const Problem& problem, Archive& archive,
                                                        Seeds seeds, double least,
                                                        double early = early_confidence);

}  // namespace stormproof::tune
