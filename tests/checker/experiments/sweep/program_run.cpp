// Processes and rows.
#include "program_run.hpp"

#include <csignal>
#include <fstream>

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stormproof::sweep {

namespace fs = std::filesystem;

pid_t start(const Arguments& command, const fs::path& folder) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child != 0) return child;
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  dup2(open((folder / "out").c_str(), flags, 0600), STDOUT_FILENO);
  dup2(open((folder / "err").c_str(), flags, 0600), STDERR_FILENO);
  execv(arguments[0], arguments.data());
  _exit(127);
}

int wait_for(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

bool has_ended(pid_t process) {
  siginfo_t info{};
  waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT);
  return info.si_pid == process;
}

Rows rows_of(const fs::path& database, bool times) {
  Rows rows;
  sqlite3* connection = nullptr;
  sqlite3_stmt* statement = nullptr;
  if (!fs::exists(database)) return rows;
  sqlite3_open(database.c_str(), &connection);
  sqlite3_busy_timeout(connection, 10'000);
  sqlite3_prepare_v2(connection, "SELECT * FROM runs", -1, &statement, nullptr);
  while (statement != nullptr && sqlite3_step(statement) == SQLITE_ROW) {
    std::string digest;
    Row row;
    for (int column = 0; column < sqlite3_column_count(statement); ++column) {
      const std::string name = sqlite3_column_name(statement, column);
      const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement, column));
      const std::string text = bytes == nullptr ? "null" : bytes;
      if (name == "digest") {
        digest = text;
      } else if (times || !name.ends_with("_seconds")) {
        row.push_back(text);
      }
    }
    EXPECT_TRUE(rows.emplace(digest, row).second) << digest << " is there twice";
  }
  sqlite3_finalize(statement);
  sqlite3_close(connection);
  return rows;
}

testing::AssertionResult contains(const Rows& all, const Rows& some) {
  for (const auto& [digest, row] : some) {
    const auto found = all.find(digest);
    if (found == all.end()) return testing::AssertionFailure() << digest << " is lost";
    if (found->second != row) return testing::AssertionFailure() << digest << " was run again";
  }
  return testing::AssertionSuccess();
}

void SweepProgram::SetUp() {
  std::ofstream{folder_ / "grid.yaml"}
      << "base: wifi-5x20\ngrid:\n  deployment.endpoints_per_participant: {from: 16, to: 20}\n"
         "  wireless.order: [fifo, fifo_uplink, fifo_downlink, datagram_uplink]\n"
         "  dds.sedp.heartbeat_period: {from: 800ms, to: 1200ms, step: 100ms}\n";
}

std::string SweepProgram::content(const char* name) const { return files::content(folder_ / name); }

Arguments SweepProgram::sweep(const char* database) const {
  return {STORMPROOF_PROGRAM, "sweep", path("grid.yaml"), "-o", path(database)};
}

}  // namespace stormproof::sweep
