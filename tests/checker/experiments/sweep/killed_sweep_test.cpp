// A sweep that is killed at any moment goes on where it stopped: nothing that was finished is lost,
// and nothing is run twice.
#include <csignal>
#include <fstream>

#include <unistd.h>

#include "program_run.hpp"

namespace stormproof::sweep {
namespace killed_sweep_test {

Arguments with(Arguments command, const Arguments& more) {
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

class KilledSweep : public SweepProgram {};

TEST_F(KilledSweep, ResumesWithNothingLostAndNothingRepeated) {
  ASSERT_EQ(wait_for(start(with(sweep("whole.db"), {"--csv", path("whole.csv")}), folder_)), 0);
  const Rows whole = rows_of(path("whole.db"), false);
  ASSERT_EQ(whole.size(), jobs);

  const Arguments resumed = with(sweep("killed.db"), {"--jobs", "1", "--csv", path("killed.csv")});
  Rows known;
  int kills = 0;
  int exit_code = -SIGKILL;
  while (exit_code == -SIGKILL) {
    const pid_t process = start(resumed, folder_);
    Rows now = known;
    while (!has_ended(process) && now.size() == known.size()) {
      usleep(1'000);
      now = rows_of(path("killed.db"), true);
    }
    kill(process, SIGKILL);
    exit_code = wait_for(process);
    now = rows_of(path("killed.db"), true);
    EXPECT_TRUE(contains(now, known));
    kills += exit_code == -SIGKILL && now.size() < jobs ? 1 : 0;
    known = std::move(now);
  }
  EXPECT_EQ(exit_code, 0);
  EXPECT_GT(kills, 0);
  EXPECT_EQ(rows_of(path("killed.db"), false), whole);
  EXPECT_EQ(content("killed.csv"), content("whole.csv"));

  // Once more, with all of it done.
  std::filesystem::remove(path("killed.csv"));
  EXPECT_EQ(wait_for(start(resumed, folder_)), 0);
  EXPECT_NE(content("out").find("100 of 100 already done"), std::string::npos);
  EXPECT_EQ(rows_of(path("killed.db"), true), known);
  EXPECT_EQ(content("killed.csv"), content("whole.csv"));
}

TEST_F(KilledSweep, CtrlCReportsWhatIsKnown) {
  // The second job would take very long.
  std::ofstream{path("grid.yaml")}
      << "scenarios:\n  - smallest\n  - {base: high-load-6x30, time_limit: 1000000s, run_until: "
         "time_limit, deployment.participants_per_host: 100}\n";
  const Arguments command = with(
      sweep("runs.db"), {"--jobs", "1", "--csv", path("runs.csv"), "--json", path("runs.json")});
  const pid_t process = start(command, folder_);
  while (rows_of(path("runs.db"), false).empty() && !has_ended(process)) usleep(1'000);
  kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 3);
  EXPECT_EQ(rows_of(path("runs.db"), false).size(), 1U);
  const std::string csv = content("runs.csv");
  EXPECT_NE(csv.find("\nsmallest,completed,"), std::string::npos);
  EXPECT_NE(csv.find("=100,interrupted,,"), std::string::npos);
  EXPECT_NE(content("runs.json").find("\"completed\": 1,"), std::string::npos);
  EXPECT_NE(content("out").find("1 left: the sweep was interrupted"), std::string::npos);
}

TEST_F(KilledSweep, AnotherGridAddsToTheSameFile) {
  std::ofstream{path("one.yaml")} << "base: smallest\ngrid:\n"
                                     "  deployment.endpoints_per_participant: [2, 4]\n";
  std::ofstream{path("two.yaml")} << "base: smallest\nscenarios: [{}, {wireless: wired}]\n"
                                     "grid: {deployment.endpoints_per_participant: [4, 6], "
                                     "time_limit: [200s, 1ms], deployment.hosts: [2, 1]}\n";
  const auto run = [&](const char* grid) {
    return wait_for(start(
        {STORMPROOF_PROGRAM, "sweep", path(grid), "-o", path("runs.db"), "--csv", path("runs.csv")},
        folder_));
  };
  EXPECT_EQ(run("one.yaml"), 0);
  const Rows one = rows_of(path("runs.db"), true);
  EXPECT_EQ(one.size(), 2U);
  EXPECT_EQ(run("two.yaml"), 3);  // 1 ms is too short for the air, one host too few
  EXPECT_NE(content("out").find("1 of 16 already done"), std::string::npos);
  EXPECT_NE(
      content("out").find("6 of 16 complete discovery, 2 incomplete when they ended, 8 cannot"),
      std::string::npos);
  EXPECT_TRUE(contains(rows_of(path("runs.db"), true), one));
  const std::string csv = content("runs.csv");
  EXPECT_NE(csv.find("\nwireless=wired,4,1ms,2,completed,200000,"), std::string::npos);
  EXPECT_NE(csv.find(",4,1ms,2,time_limit,,"), std::string::npos);
  EXPECT_NE(csv.find("participants on at least two hosts"), std::string::npos);
  EXPECT_EQ(run("two.yaml"), 3);
  EXPECT_NE(content("out").find("16 of 16 already done"), std::string::npos);
}

TEST_F(KilledSweep, BadInputLeavesNothingBehind) {
  std::ofstream{path("grid.yaml")} << "base: smallest\ngrid: {dds: [papr]}\n";
  EXPECT_EQ(wait_for(start(with(sweep("runs.db"), {"--csv", path("runs.csv")}), folder_)), 2);
  EXPECT_NE(content("err").find("grid.yaml:2:14: no dds file named 'papr'"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path("runs.db")));
  for (const auto& entry : std::filesystem::directory_iterator{folder_}) {
    EXPECT_NE(entry.path().extension(), ".partial");
  }
  SweepProgram::SetUp();
  EXPECT_EQ(wait_for(start(with(sweep("runs.db"), {"--csv", path("runs.db")}), folder_)), 2);
}

}  // namespace killed_sweep_test
}  // namespace stormproof::sweep
