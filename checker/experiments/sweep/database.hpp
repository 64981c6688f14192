// The results of sweeps in SQLite: one row for each job that is done. It exists so that a sweep can
// be killed at any moment and go on later, and so that results of many grids can be asked questions
// in SQL. specs/guide/sweeping.md describes the columns.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "checker/experiments/grids/digest.hpp"
#include "checker/experiments/sweep/file_lock.hpp"
#include "checker/experiments/sweep/outcome.hpp"
#include "model/config/tree/result.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace stormproof::sweep {

using grids::Digest;
using grids::hex;

/// `PRAGMA application_id` and `user_version` of the files.
inline constexpr int application_id = 0x53544d50;
inline constexpr int schema_version = 2;

class Database {
 public:
  /// Opens the file, which is made if it does not exist or is empty. Errors: it cannot be opened,
  /// it is not a database of sweeps, it has a newer schema, another sweep works on it.
  [[nodiscard]] static model::config::Result<Database> open(const std::string& path,
                                                            std::string program_version);

  /// The outcome that this version of the program has had with these inputs.
  [[nodiscard]] std::optional<Outcome> find(const Digest& digest);

  /// Adds a row, or replaces that of the same inputs and version. It is in the file for good with
  /// the next `commit`. `keys` are the swept keys and the job's values of them, as a JSON object.
  [[nodiscard]] bool add(const Digest& digest, const std::string& keys, const Outcome& outcome);
  [[nodiscard]] bool commit();
  /// Commits, and merges what SQLite keeps beside the file into it.
  [[nodiscard]] bool finish();

  /// Takes over the rows of another database of sweeps, such as that of a shard; rows that are
  /// there already stay. What is wrong with the other file, or nothing.
  [[nodiscard]] std::optional<model::config::InputError> take_over(const std::string& path);

  /// What went wrong with the last operation that returned false.
  [[nodiscard]] std::string error() const;

 private:
  struct Closer {
    void operator()(sqlite3* connection) const;
    void operator()(sqlite3_stmt* statement) const;
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Closer>;

  Database() = default;
  /// Of rows: all columns but the key and `keys`.
  [[nodiscard]] static std::string outcome_columns();
  [[nodiscard]] bool execute(const std::string& sql);
  [[nodiscard]] std::optional<std::int64_t> integer(const std::string& sql);
  [[nodiscard]] bool prepare(const std::string& sql, Statement& statement);
  /// What is wrong with the file, or nothing.
  [[nodiscard]] std::optional<std::string> accept();
  [[nodiscard]] bool make_schema();

  std::string path_;
  std::string version_;
  FileLock lock_;  ///< closed after the connection
  std::unique_ptr<sqlite3, Closer> connection_;
  Statement find_;
  Statement add_;
  bool in_transaction_ = false;
};

}  // namespace stormproof::sweep
