// A sweep in shards, as on machines that share nothing: processes that know nothing of each other,
// one of which is killed. Whoever takes over their databases has every row, and runs what is
// missing.
#include <array>
#include <csignal>
#include <fstream>

#include <unistd.h>

#include "program_run.hpp"

namespace stormproof::sweep {
namespace shards_test {

class Shards : public SweepProgram {
 protected:
  static constexpr std::size_t count = 4;

  [[nodiscard]] static std::string name(std::size_t shard) {
    return "shard" + std::to_string(shard) + ".db";
  }
  [[nodiscard]] Arguments of_shard(std::size_t shard) const {
    Arguments command = sweep(name(shard).c_str());
    command.insert(command.end(),
                   {"--jobs", "1", "--shard", std::to_string(shard) + "/" + std::to_string(count)});
    return command;
  }
  [[nodiscard]] int run(Arguments command, const Arguments& more) const {
    command.insert(command.end(), more.begin(), more.end());
    return wait_for(start(command, folder_));
  }
};

TEST_F(Shards, LoseNothingWhenOneOfThemIsKilled) {
  ASSERT_EQ(run(sweep("whole.db"), {"--csv", path("whole.csv")}), 0);

  // The second one, after its first rows and before its last.
  constexpr std::size_t victim = 1;
  bool killed = false;
  std::array<pid_t, count> processes{};
  for (std::size_t k = 0; k < count; ++k) processes.at(k) = start(of_shard(k), folder_);
  while (!has_ended(processes[victim]) && rows_of(path(name(victim).c_str()), true).empty()) {
    usleep(1'000);
  }
  kill(processes[victim], SIGKILL);
  for (std::size_t k = 0; k < count; ++k) {
    const int exit_code = wait_for(processes.at(k));
    if (k == victim) {
      killed = exit_code == -SIGKILL;
    } else {
      EXPECT_EQ(exit_code, 0) << k;
    }
  }
  Rows known;
  Arguments taken;
  for (std::size_t k = 0; k < count; ++k) {
    known.merge(rows_of(path(name(k).c_str()), true));
    taken.push_back(path(name(k).c_str()));
  }
  EXPECT_GE(known.size(), jobs - jobs / count);
  EXPECT_TRUE(killed || known.size() == jobs);

  taken.insert(taken.end(), {"--csv", path("all.csv")});
  ASSERT_EQ(run(sweep("all.db"), taken), 0) << content("err");
  EXPECT_NE(content("out").find(std::to_string(known.size()) + " of 100 already done"),
            std::string::npos)
      << content("out");
  EXPECT_TRUE(contains(rows_of(path("all.db"), true), known));
  EXPECT_EQ(rows_of(path("all.db"), false), rows_of(path("whole.db"), false));
  EXPECT_EQ(content("all.csv"), content("whole.csv"));

  // The shard itself goes on where it stopped, too.
  const Rows before = rows_of(path(name(victim).c_str()), true);
  ASSERT_EQ(run(of_shard(victim), {}), 0);
  EXPECT_NE(content("out").find(std::to_string(before.size()) + " of 25 already done"),
            std::string::npos);
  EXPECT_TRUE(contains(rows_of(path(name(victim).c_str()), true), before));
}

TEST_F(Shards, AreRefusedIfTheyAreNone) {
  for (const char* shard : {"4/4", "1", "/", "-1/4", "1/0", "a/b"}) {
    EXPECT_EQ(run(sweep("runs.db"), {"--shard", shard}), 2) << shard;
    EXPECT_NE(content("err").find("expected K/N"), std::string::npos) << content("err");
  }
  EXPECT_EQ(run(sweep("runs.db"), {path("absent.db")}), 2);
  EXPECT_NE(content("err").find("absent.db: no such file"), std::string::npos) << content("err");
}

}  // namespace shards_test
}  // namespace stormproof::sweep
