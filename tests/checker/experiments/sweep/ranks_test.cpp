// The same sweep under mpirun: the same rows from several ranks, and a rank that is killed in the
// middle ends the run, which then goes on with nothing lost and nothing repeated.
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>

#include <unistd.h>

#include "program_run.hpp"
#include "tests/files.hpp"

namespace stormproof::sweep {
namespace ranks_test {

namespace fs = std::filesystem;

class Ranks : public SweepProgram {
 protected:
  void SetUp() override {
    SweepProgram::SetUp();
    // Open MPI refuses to start as root, as in a container, unless it is told so twice.
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    // Open MPI leaks in modules that are unloaded when leaks are looked for, so no suppression can
    // name them. What the program itself does is looked at in the tests without mpirun.
    const char* options = getenv("ASAN_OPTIONS");
    const std::string more = options == nullptr ? "" : std::string{options} + ":";
    setenv("ASAN_OPTIONS", (more + "detect_leaks=0").c_str(), 1);
  }

  [[nodiscard]] Arguments on_ranks(const char* database) const {
    Arguments command{STORMPROOF_MPIRUN, "-n", "3", "--oversubscribe"};
    for (const std::string& word : sweep(database)) command.push_back(word);
    command.insert(command.end(), {"--csv", path("runs.csv")});
    return command;
  }
};

/// The process of rank 1 that writes to `database`.
std::optional<pid_t> second_rank(const std::string& database) {
  for (const auto& entry : fs::directory_iterator{"/proc"}) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const bool is_ours =
        files::content(entry.path() / "cmdline").find(database) != std::string::npos;
    if (!is_ours) continue;
    const std::string environment = files::content(entry.path() / "environ");
    if (environment.find(std::string{"\0OMPI_COMM_WORLD_RANK=1\0", 24}) != std::string::npos) {
      return std::stoi(name);
    }
  }
  return std::nullopt;
}

TEST_F(Ranks, HaveTheRowsOfASingleProcess) {
  ASSERT_EQ(wait_for(start(sweep("single.db"), folder_)), 0);
  ASSERT_EQ(wait_for(start(on_ranks("ranks.db"), folder_)), 0) << content("err");
  EXPECT_NE(content("out").find("100 of 100 complete discovery"), std::string::npos);
  const Rows rows = rows_of(path("ranks.db"), false);
  EXPECT_EQ(rows.size(), jobs);
  EXPECT_EQ(rows, rows_of(path("single.db"), false));
}

TEST_F(Ranks, AKilledRankLosesAndRepeatsNothing) {
  Rows known;
  for (int attempt = 0; attempt < 10 && (known.empty() || known.size() == jobs); ++attempt) {
    fs::remove(path("runs.db"));
    const pid_t process = start(on_ranks("runs.db"), folder_);
    while (!has_ended(process) && rows_of(path("runs.db"), true).empty()) usleep(1'000);
    if (const auto rank = second_rank(path("runs.db"))) {
      kill(*rank, SIGKILL);
      EXPECT_NE(wait_for(process), 0);
    } else {
      EXPECT_EQ(wait_for(process), 0);  // it was done before
    }
    known = rows_of(path("runs.db"), true);
  }
  ASSERT_GT(known.size(), 0U);
  ASSERT_LT(known.size(), jobs);

  ASSERT_EQ(wait_for(start(on_ranks("runs.db"), folder_)), 0) << content("err");
  EXPECT_NE(content("out").find(std::to_string(known.size()) + " of 100 already done"),
            std::string::npos);
  EXPECT_TRUE(contains(rows_of(path("runs.db"), true), known));
  const std::string csv = content("runs.csv");
  Arguments single = sweep("single.db");
  single.insert(single.end(), {"--csv", path("single.csv")});
  ASSERT_EQ(wait_for(start(single, folder_)), 0);
  EXPECT_EQ(rows_of(path("runs.db"), false), rows_of(path("single.db"), false));
  EXPECT_EQ(csv, content("single.csv"));
}

TEST_F(Ranks, BadInputIsSaidOnce) {
  std::ofstream{path("grid.yaml")} << "base: smallest\ngrid: {dds: [papr]}\n";
  EXPECT_NE(wait_for(start(on_ranks("runs.db"), folder_)), 0);
  const std::string said = content("err");
  const std::size_t first = said.find("no dds file named 'papr'");
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_EQ(said.find("no dds file named 'papr'", first + 1), std::string::npos);
}

}  // namespace ranks_test
}  // namespace stormproof::sweep
