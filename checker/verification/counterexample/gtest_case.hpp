// A counterexample as a GoogleTest case: it fails as long as the defect is there, and stays as a
// regression test once the defect is gone.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "props/verdict.hpp"

namespace stormproof::counterexample {

/// C++ source of one test case, without includes. `found_by` says how it was found ("the explorer,
/// all schedules of 3 participants"); empty: by `stormproof check`.
[[nodiscard]] std::string gtest_case(const props::Counterexample& counterexample,
                                     std::string_view found_by = {});

/// C++ source of a file with these cases and the includes that they need. Link it with
/// stormproof_counterexample and GTest::gtest_main.
[[nodiscard]] std::string gtest_file(std::span<const props::Counterexample> counterexamples,
                                     std::string_view found_by = {});

}  // namespace stormproof::counterexample
