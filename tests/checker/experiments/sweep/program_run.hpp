// Runs the program as a process of its own, so that it can be killed, and reads its database.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/types.h>

#include "tests/files.hpp"

namespace stormproof::sweep {

using Arguments = std::vector<std::string>;
/// The columns of a row, as text, without its digest.
using Row = std::vector<std::string>;
/// By digest.
using Rows = std::map<std::string, Row>;

/// Starts a process in `folder`; its output goes to files "out" and "err" there.
[[nodiscard]] pid_t start(const Arguments& command, const std::filesystem::path& folder);
/// Waits for its end; its exit code, or minus the signal that ended it.
[[nodiscard]] int wait_for(pid_t process);
[[nodiscard]] bool has_ended(pid_t process);

/// All rows of a database, none if there is no table yet. With `times`, also the times that were
/// measured: two rows that have them in common come from the same run.
[[nodiscard]] Rows rows_of(const std::filesystem::path& database, bool times);

/// Whether `all` has every row of `some`.
[[nodiscard]] testing::AssertionResult contains(const Rows& all, const Rows& some);

/// A folder of its own for each test, with the grid that these tests sweep.
class SweepProgram : public testing::Test {
 protected:
  void SetUp() override;

  /// The jobs of the grid; one takes some milliseconds.
  static constexpr std::size_t jobs = 100;

  [[nodiscard]] std::string path(const char* name) const { return folder_ / name; }
  [[nodiscard]] std::string content(const char* name) const;
  [[nodiscard]] Arguments sweep(const char* database) const;

  const files::Folder own_;
  const std::filesystem::path folder_ = own_.path();
};

}  // namespace stormproof::sweep
