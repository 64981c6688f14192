// How reports of a comparison write values, changes and shares: the same words everywhere.
#pragma once

#include <optional>
#include <string>

#include "checker/experiments/diff/diff.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::diff {

/// "6.263 s", "32,364", "14.3×"; "never" if infinite (a run that does not complete).
[[nodiscard]] std::string value_text(Measure measure, double value);
/// The same; "–" if there is none.
[[nodiscard]] std::string value_text(Measure measure, const std::optional<double>& value);

/// Of a median: "never" if a completion has none, as most runs do not complete.
[[nodiscard]] std::string median_text(Measure measure, const std::optional<double>& median);
/// The same; "> 8.1 s" if runs were cut then.
[[nodiscard]] std::string median_text(const MeasuredChange& change,
                                      const std::optional<double>& median);

/// +0.254 → "+25 %", −0.5 → "−50 %"; from 10-fold on "×12"; "+∞" and "−∞" as such.
[[nodiscard]] std::string change_text(double relative);

/// "+104 % (+60 … +160 %)", "+9 packets (+3 … +12)" where the median before is 0; "–" if there is
/// no shift.
[[nodiscard]] std::string change_text(const MeasuredChange& change);

/// Whether it matters: "yes", "no" or "not known".
[[nodiscard]] const char* matters_text(const KnobChange& change);

/// 0.05 → "5 %", 0.9973 → "99.73 %".
[[nodiscard]] std::string share_text(double share);

using report::plural;

}  // namespace stormproof::diff
