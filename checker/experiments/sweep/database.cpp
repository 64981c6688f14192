// Write-ahead logging: a commit appends to a file beside the database, so a program that is killed
// in the middle of one leaves what was committed before. Prepared statements and transactions over
// many rows keep a row at a few microseconds.
#include "checker/experiments/sweep/database.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

namespace stormproof::sweep {

namespace {

/// How long to wait for somebody else who is writing to the file.
constexpr int busy_milliseconds = 10'000;

void bind_text(sqlite3_stmt* statement, int column, const std::string& text) {
  sqlite3_bind_text64(statement, column, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
}

std::string column_text(sqlite3_stmt* statement, int column) {
  const void* bytes = sqlite3_column_blob(statement, column);
  if (bytes == nullptr) return {};
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement, column));
  return {static_cast<const char*>(bytes), size};
}

}  // namespace

void Database::Closer::operator()(sqlite3* connection) const { sqlite3_close(connection); }
void Database::Closer::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

std::string Database::error() const {
  return fmt::format("{}: {}", path_, sqlite3_errmsg(connection_.get()));
}

bool Database::execute(const std::string& sql) {
  return sqlite3_exec(connection_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
}

bool Database::prepare(const std::string& sql, Statement& statement) {
  sqlite3_stmt* prepared = nullptr;
  const int code = sqlite3_prepare_v3(connection_.get(), sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT,
                                      &prepared, nullptr);
  statement.reset(prepared);
  return code == SQLITE_OK;
}

std::optional<std::int64_t> Database::integer(const std::string& sql) {
  Statement statement;
  if (!prepare(sql, statement) || sqlite3_step(statement.get()) != SQLITE_ROW) return std::nullopt;
  return sqlite3_column_int64(statement.get(), 0);
}

std::string Database::outcome_columns() {
  return fmt::format("\"end\", {}, error, wall_seconds, cpu_seconds",
                     fmt::join(number_names, ", "));
}

bool Database::make_schema() {
  std::string numbers;
  for (const char* name : number_names) numbers += fmt::format("  {} INTEGER,\n", name);
  return execute(fmt::format(
      "BEGIN IMMEDIATE;\n"
      "CREATE TABLE IF NOT EXISTS runs (\n  digest TEXT NOT NULL,\n  version TEXT NOT NULL,\n"
      "  keys TEXT NOT NULL,\n  \"end\" TEXT NOT NULL,\n{}  error TEXT,\n  wall_seconds REAL,\n"
      "  cpu_seconds REAL,\n  PRIMARY KEY (digest, version)\n);\n"
      "PRAGMA application_id = {};\nPRAGMA user_version = {};\nCOMMIT;",
      numbers, application_id, schema_version));
}

std::optional<std::string> Database::accept() {
  const auto id = integer("PRAGMA application_id");
  const auto version = integer("PRAGMA user_version");
  const auto tables = integer("SELECT count(*) FROM sqlite_master");
  if (!id || !version || !tables) return error();
  if (*id == 0 && *version == 0 && *tables == 0) {
    if (!make_schema()) return error();
  } else if (*id != application_id) {
    return fmt::format(
        "{}: is a database of something else; expected one that sweep has made, or "
        "a new file",
        path_);
  } else if (*version != schema_version) {
    return fmt::format("{}: has schema {}; expected {}, which this program writes", path_, *version,
                       schema_version);
  }
  if (!execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; "
               "PRAGMA wal_autocheckpoint = 10000;"))
    return error();
  std::string marks = "?, ?, ?, ?";
  for (std::size_t k = 0; k < number_names.size() + 3; ++k) marks += ", ?";
  const std::string outcome = outcome_columns();
  const bool prepared =
      prepare(fmt::format("INSERT OR REPLACE INTO runs (digest, version, keys, {}) VALUES ({})",
                          outcome, marks),
              add_) &&
      prepare(fmt::format("SELECT {} FROM runs WHERE digest = ? AND version = ?", outcome), find_);
  return prepared ? std::nullopt : std::optional{error()};
}

model::config::Result<Database> Database::open(const std::string& path, std::string version) {
  Database database;
  database.path_ = path;
  database.version_ = std::move(version);
  // A name such as ":memory:" is a file like any other.
  const std::string file = path.starts_with(':') ? "./" + path : path;
  database.lock_ = FileLock{file};
  if (database.lock_.refused()) {
    return model::config::InputError{path,
                                     "another sweep works on this database; expected one at "
                                     "a time, or another file"};
  }
  sqlite3* connection = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &connection,
                                   SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  database.connection_.reset(connection);
  if (connection == nullptr) return model::config::InputError{path, "out of memory"};
  sqlite3_busy_timeout(connection, busy_milliseconds);
  std::optional<std::string> complaint;
  if (code == SQLITE_OK) {
    complaint = database.accept();
  } else {
    complaint = database.error();
  }
  if (!complaint) return database;
  const std::string place = path + ": ";
  if (complaint->starts_with(place)) complaint->erase(0, place.size());
  return model::config::InputError{path, *std::move(complaint)};
}

std::optional<Outcome> Database::find(const Digest& digest) {
  sqlite3_stmt* row = find_.get();
  sqlite3_reset(row);
  bind_text(row, 1, hex(digest));
  bind_text(row, 2, version_);
  if (sqlite3_step(row) != SQLITE_ROW) return std::nullopt;
  int column = 0;
  Outcome outcome;
  outcome.end = column_text(row, column++);
  for (auto& number : outcome.numbers) {
    if (sqlite3_column_type(row, column) != SQLITE_NULL) number = sqlite3_column_int64(row, column);
    ++column;
  }
  outcome.error = column_text(row, column++);
  outcome.wall_seconds = sqlite3_column_double(row, column++);
  outcome.cpu_seconds = sqlite3_column_double(row, column);
  sqlite3_reset(row);
  return outcome;
}

bool Database::add(const Digest& digest, const std::string& keys, const Outcome& outcome) {
  if (!in_transaction_ && !execute("BEGIN")) return false;
  in_transaction_ = true;
  sqlite3_stmt* row = add_.get();
  int column = 1;
  for (const std::string& text : {hex(digest), version_, keys, outcome.end}) {
    bind_text(row, column++, text);
  }
  for (const auto& number : outcome.numbers) {
    if (number) {
      sqlite3_bind_int64(row, column, *number);
    } else {
      sqlite3_bind_null(row, column);
    }
    ++column;
  }
  if (outcome.error.empty()) {
    sqlite3_bind_null(row, column++);
  } else {
    bind_text(row, column++, outcome.error);
  }
  sqlite3_bind_double(row, column++, outcome.wall_seconds);
  sqlite3_bind_double(row, column, outcome.cpu_seconds);
  const bool added = sqlite3_step(row) == SQLITE_DONE;
  return sqlite3_reset(row) == SQLITE_OK && added;
}

std::optional<model::config::InputError> Database::take_over(const std::string& path) {
  const auto wrong = [&](std::string text) {
    return std::optional{model::config::InputError{path, std::move(text)}};
  };
  // SQLite would make the file.
  if (!std::filesystem::is_regular_file(path)) return wrong("no such file");
  Statement attach;
  if (!prepare("ATTACH ? AS other", attach)) return wrong(error());
  bind_text(attach.get(), 1, path.starts_with(':') ? "./" + path : path);
  if (sqlite3_step(attach.get()) != SQLITE_DONE) return wrong(sqlite3_errmsg(connection_.get()));
  std::optional<model::config::InputError> failure;
  if (integer("PRAGMA other.application_id") != application_id ||
      integer("PRAGMA other.user_version") != schema_version) {
    failure = wrong("no database that this program's sweep has made; expected one");
  } else if (!execute(fmt::format("INSERT OR IGNORE INTO main.runs (digest, version, keys, {0}) "
                                  "SELECT digest, version, keys, {0} FROM other.runs",
                                  outcome_columns()))) {
    failure = wrong(sqlite3_errmsg(connection_.get()));
  }
  attach.reset();
  if (!execute("DETACH other") && !failure) failure = wrong(sqlite3_errmsg(connection_.get()));
  return failure;
}

bool Database::commit() {
  if (!in_transaction_) return true;
  if (!execute("COMMIT")) return false;
  in_transaction_ = false;
  return true;
}

bool Database::finish() { return commit() && execute("PRAGMA wal_checkpoint(TRUNCATE)"); }

}  // namespace stormproof::sweep
