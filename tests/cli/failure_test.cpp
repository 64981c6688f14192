// What goes wrong outside of the program never turns into success, an abort or a lost answer: full
// disks, closed pipes and descriptors, outputs that are inputs, folders that cannot be written.
#include <filesystem>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/files.hpp"

namespace failure_test {

namespace fs = std::filesystem;
namespace files = stormproof::files;

class Failure : public testing::Test {
 protected:
  void SetUp() override {
    fs::copy_file(STORMPROOF_SPECS_DIR "/scenarios/smallest.yaml", folder_ / "my.yaml");
  }

  /// The exit code of a shell's commands, in the folder unless they leave it; `redirection` comes
  /// after those into the files `out` and `err`.
  int shell(const std::string& commands, const std::string& redirection = "") const {
    const std::string line = "cd '" + folder_.string() + "' && { PATH='" +
                             fs::path{STORMPROOF_PROGRAM}.parent_path().string() + "':$PATH; T='" +
                             folder_.string() + "'; " + commands + "\n} >" + file("out") + " 2>" +
                             file("err") + " " + redirection + " </dev/null";
    return files::exit_code_of(line);
  }
  [[nodiscard]] std::string file(const char* name) const {
    return "'" + (folder_ / name).string() + "'";
  }
  [[nodiscard]] std::string content(const std::string& name) const {
    return files::content(folder_ / name);
  }
  [[nodiscard]] bool says(const char* name, const std::string& words) const {
    return content(name).find(words) != std::string::npos;
  }
  [[nodiscard]] bool has_partial_files() const {
    for (const auto& entry : fs::recursive_directory_iterator{folder_}) {
      if (entry.path().extension() == ".partial") return true;
    }
    return false;
  }

  const files::Folder own_;
  const fs::path folder_ = own_.path();
};

/// A violation that a quick check finds.
const std::string violated =
    "stormproof check my.yaml --property timer.single-heartbeat --set "
    "dds.sedp.heartbeat_timer=additive --single-solver ";

TEST_F(Failure, FullDiskBehindStandardOutput) {
  for (const char* verb : {"simulate my.yaml", "draw", "--help", "properties --format json",
                           "check my.yaml --property order.total --single-solver"}) {
    EXPECT_EQ(shell(std::string{"stormproof "} + verb, ">/dev/full"), 2) << verb;
    EXPECT_TRUE(says("err", "standard output: could not be written")) << verb << content("err");
  }
}

TEST_F(Failure, FullDiskBehindAFile) {
  EXPECT_EQ(shell("stormproof simulate my.yaml --report html=/dev/full --report json=good.json"),
            2);
  EXPECT_TRUE(says("out", "completes")) << content("out");
  EXPECT_TRUE(says("err", "--report /dev/full: could not be written")) << content("err");
  EXPECT_TRUE(says("good.json", "\"schema\""));
  EXPECT_EQ(shell("stormproof draw HeartbeatTimer -o /dev/full"), 2);
  EXPECT_EQ(shell("stormproof simulate my.yaml --format json --report html=/dev/full"), 2);
  EXPECT_TRUE(says("out", "\"exit_code\": 2")) << content("out");
}

TEST_F(Failure, AFileSizeLimit) {
  EXPECT_EQ(shell("ulimit -f 64; stormproof simulate wired-5x20 --trace t.jsonl"), 2);
  EXPECT_TRUE(says("err", "--trace t.jsonl: could not be written completely")) << content("err");
  EXPECT_FALSE(fs::exists(folder_ / "t.jsonl"));
  EXPECT_FALSE(has_partial_files());
}

TEST_F(Failure, NobodyAtStandardError) {
  for (const char* redirection : {"2>&-", "2>/dev/full"}) {
    EXPECT_EQ(shell("stormproof simulate nonex", redirection), 2) << redirection;
    EXPECT_EQ(shell("stormproof simulate my.yaml --progress --trace t.jsonl", redirection), 0);
    EXPECT_TRUE(says("out", "completes"));
    EXPECT_TRUE(content("t.jsonl").starts_with("{"));
  }
}

TEST_F(Failure, NobodyAtStandardOutput) {
  EXPECT_EQ(shell("stormproof simulate my.yaml --trace t.jsonl", ">&-"), 2);
  EXPECT_TRUE(says("err", "standard output")) << content("err");
  EXPECT_TRUE(content("t.jsonl").starts_with("{"));
  EXPECT_FALSE(says("t.jsonl", "completes"));
  EXPECT_EQ(shell("stormproof draw -o machines.md", ">&-"), 0);  // nothing was to be printed
}

TEST_F(Failure, APipeWithoutAReader) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const std::string trace = (folder_ / "t.jsonl").string();
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    (void)freopen((folder_ / "err").c_str(), "w", stderr);
    execl(STORMPROOF_PROGRAM, "stormproof", "simulate", "smallest", "--trace", trace.c_str(),
          nullptr);
    _exit(127);
  }
  close(ends[1]);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_TRUE(content("err").empty()) << content("err");  // the reader left on purpose
  EXPECT_FALSE(content("t.jsonl").empty());
}

TEST_F(Failure, InputsAreNotOverwritten) {
  const std::string before = content("my.yaml");
  EXPECT_EQ(shell("stormproof simulate my.yaml --trace my.yaml"), 2);
  EXPECT_TRUE(says("err", "--trace my.yaml: would replace an input")) << content("err");
  EXPECT_EQ(shell("ln my.yaml hard.yaml; ln -s my.yaml soft.yaml; "
                  "stormproof simulate hard.yaml --report html=$T/soft.yaml"),
            2);
  EXPECT_EQ(shell("stormproof profile show fastdds-2.6.11 --report json=p.xml >/dev/null; echo "
                  "'base: fastdds-2.6.11' >p.yaml; stormproof simulate my.yaml --set dds=p.yaml "
                  "--perfetto p.yaml"),
            2);
  EXPECT_EQ(content("p.yaml"), "base: fastdds-2.6.11\n");
  EXPECT_EQ(content("my.yaml"), before);
  EXPECT_FALSE(has_partial_files());
}

TEST_F(Failure, WhatWasReadOnTheWayIsNotOverwritten) {
  const std::string profile = "base: fastdds-2.6.11\n";
  std::ofstream{folder_ / "p.yaml"} << profile;
  EXPECT_EQ(shell("sed 's/^dds:.*/dds: p.yaml/' my.yaml >other.yaml; grep -q p.yaml other.yaml && "
                  "stormproof simulate other.yaml --report json=p.yaml"),
            2);
  EXPECT_TRUE(says("err", "it would replace a file that was read")) << content("err");
  EXPECT_FALSE(content("out").empty());
  EXPECT_EQ(content("p.yaml"), profile);
}

TEST_F(Failure, TwoOutputsAreTwoFiles) {
  EXPECT_EQ(shell("stormproof simulate my.yaml --trace x --perfetto ./x"), 2);
  EXPECT_TRUE(says("err", "is the same file as")) << content("err");
  EXPECT_EQ(shell("stormproof simulate my.yaml --trace out"), 2);
  EXPECT_TRUE(says("err", "is where standard output goes")) << content("err");
  EXPECT_EQ(shell("stormproof sweep nothing -o a.db --csv a.db"), 2);
  EXPECT_TRUE(says("err", "is the same file as")) << content("err");
  EXPECT_EQ(shell("stormproof simulate my.yaml --trace /dev/null --perfetto /dev/null"), 0);
}

TEST_F(Failure, FoldersAreTriedBeforeTheWork) {
  EXPECT_EQ(shell(violated + "--counterexamples /proc/none"), 2);
  EXPECT_TRUE(says("err", "--counterexamples /proc/none: cannot be written into"))
      << content("err");
  EXPECT_TRUE(content("out").empty());
  EXPECT_EQ(shell("stormproof check my.yaml --export /proc/none"), 2);
  EXPECT_TRUE(says("err", "--export /proc/none")) << content("err");
  for (const char* verb : {"diff fastdds-2.6.11 fastdds-2.9.1 --over smallest",
                           "tune my.yaml --preset fastdds-2.6.11", "reproduce paper"}) {
    EXPECT_EQ(shell(std::string{"stormproof "} + verb + " --output /proc/none"), 2) << verb;
    EXPECT_TRUE(says("err", "--output /proc/none: cannot be")) << verb << content("err");
    EXPECT_TRUE(content("out").empty());
  }
}

TEST_F(Failure, NobodyAskedForTheFilesThatCannotBeWritten) {
  EXPECT_EQ(shell("cd /proc && stormproof check $T/my.yaml "
                  "--property timer.single-heartbeat --set dds.sedp.heartbeat_timer=additive "
                  "--single-solver"),
            1);
  EXPECT_TRUE(says("out", "timer.single-heartbeat is violated"))
      << content("out") << content("err");
  EXPECT_TRUE(says("out", "cannot be made")) << content("out");
}

TEST_F(Failure, TheUsualFolderHoldsOneRun) {
  const fs::path usual = folder_ / "stormproof-out" / "check-my";
  const std::string trace = "timer.single-heartbeat.jsonl";
  EXPECT_EQ(shell(violated), 1);
  EXPECT_TRUE(says("out", "stormproof-out/check-my/: ")) << content("out");
  EXPECT_TRUE(fs::exists(usual / trace));
  EXPECT_EQ(content("stormproof-out/.gitignore"), "*\n");
  std::ofstream{usual / "mine.txt"} << "notes\n";
  EXPECT_EQ(shell("stormproof check my.yaml --property order.total --single-solver"), 0);
  EXPECT_FALSE(fs::exists(usual / trace));
  EXPECT_EQ(content("stormproof-out/check-my/mine.txt"), "notes\n");
  fs::remove_all(usual);
  EXPECT_EQ(shell("stormproof check my.yaml --property order.total --single-solver"), 0);
  EXPECT_FALSE(fs::exists(usual));
}

TEST_F(Failure, TheUsualFolderHasALimit) {
  EXPECT_EQ(shell("stormproof fuzz wifi-5x20 --limit completion=12s --start-jitter 100ms --loss 1% "
                  "--runs 1"),
            1);
  EXPECT_TRUE(says("out", "limit.completion.jsonl is left out")) << content("out");
  EXPECT_FALSE(says("out", "replay ")) << content("out");
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator{folder_ / "stormproof-out/fuzz-wifi-5x20"}) {
    bytes += entry.file_size();
  }
  EXPECT_GT(bytes, 10'000U);
  EXPECT_LT(bytes, 16'000'000U);
}

TEST_F(Failure, TwoRunsAtOnceHaveTwoFolders) {
  EXPECT_EQ(shell(violated), 1);
  const fs::path usual = folder_ / "stormproof-out" / "check-my";
  const int marker = open((usual / ".stormproof").c_str(), O_RDWR);
  ASSERT_GE(marker, 0);
  ASSERT_EQ(flock(marker, LOCK_EX), 0);  // as a run that goes on does
  EXPECT_EQ(shell(violated), 1);
  close(marker);
  EXPECT_TRUE(says("out", "stormproof-out/check-my-2/: ")) << content("out");
  EXPECT_TRUE(fs::exists(usual / "timer.single-heartbeat.jsonl"));
}

TEST_F(Failure, ANamedFolderHoldsOneRun) {
  fs::create_directory(folder_ / "here");
  const int held = open((folder_ / "here").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(held, LOCK_EX), 0);  // as a run that goes on does
  EXPECT_EQ(shell(violated + std::string{"--counterexamples here"}), 2);
  EXPECT_TRUE(says("err", "here: another run writes into it")) << content("err");
  EXPECT_TRUE(fs::is_empty(folder_ / "here"));
  close(held);
  EXPECT_EQ(shell(violated + std::string{"--counterexamples here"}), 1);
}

TEST_F(Failure, RunsThatWriteTheSameFileAtOnceLeaveOneOfThem) {
  const std::string run = "stormproof simulate wired-5x20 --trace same.jsonl >/dev/null";
  EXPECT_EQ(shell(run + " & a=$!; " + run + " & b=$!; " + run +
                  "; c=$?; wait $a && wait $b && "
                  "exit $c"),
            0)
      << content("err");
  EXPECT_EQ(shell("stormproof replay same.jsonl"), 0);
  EXPECT_FALSE(has_partial_files());
}

TEST_F(Failure, OneSweepAtATime) {
  std::ofstream{folder_ / "grid.yaml"} << "scenarios: [smallest]\ngrid: {time_limit: [2s, 3s]}\n";
  const int database = open((folder_ / "runs.db").c_str(), O_RDWR | O_CREAT, 0666);
  ASSERT_GE(database, 0);
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = off_t{1} << 60;
  lock.l_len = 1;
  ASSERT_EQ(fcntl(database, F_OFD_SETLK, &lock), 0);
  EXPECT_EQ(shell("stormproof sweep grid.yaml -o runs.db"), 2);
  EXPECT_TRUE(says("err", "another sweep works on this database")) << content("err");
  close(database);
  EXPECT_EQ(shell("stormproof sweep grid.yaml -o runs.db", "2>&-"), 0);
}

TEST_F(Failure, MemoryHasALimit) {
  EXPECT_EQ(shell("stormproof simulate my.yaml --max-memory 100MB --set "
                  "dds.sedp.heartbeat_period=1ns"),
            3);
  EXPECT_TRUE(says("err", "needs more memory than 100 MB")) << content("err");
  EXPECT_EQ(shell("stormproof simulate my.yaml --max-memory 5"), 2);
  EXPECT_TRUE(says("err", "--max-memory '5': expected a size")) << content("err");
}

/// A capture with some of its bytes replaced.
std::string damaged(const char* capture, const char* bytes, int at) {
  return std::string{"xz -dc '" STORMPROOF_CAPTURES_DIR "/"} + capture +
         ".pcap.xz' >m.pcap; printf '" + bytes +
         "' | dd of=m.pcap bs=1 seek=" + std::to_string(at) + " conv=notrunc 2>/dev/null; ";
}

TEST_F(Failure, DamagedNumbersInCapturesTakeNoMemory) {
  EXPECT_EQ(shell(damaged("fastdds2611_ap150_np1_ne2_r0", "\\100", 4363) +
                  "stormproof conform m.pcap --dds fastdds-2.6.11 --max-memory 200MB"),
            4);
  EXPECT_TRUE(says("out", "number_beyond")) << content("out") << content("err");
  EXPECT_EQ(shell(damaged("cyclone0102_veth_np2_ne20_r0", "\\040", 46730) +
                  "stormproof conform m.pcap --dds fastdds-2.6.11 --max-memory 200MB"),
            4);
  EXPECT_TRUE(says("out", "number_beyond")) << content("out") << content("err");
}

TEST_F(Failure, ADamagedTimeIsLeftOutAndSaid) {
  EXPECT_EQ(shell(damaged("fastdds2611_ap150_np1_ne2_r0", "\\001\\000\\000\\000", 3468) +
                  "stormproof doctor m.pcap --no-advice"),
            0);
  EXPECT_TRUE(says("out", "packets whose time is more than a day from that of the one before"))
      << content("out");
  EXPECT_TRUE(says("out", "packet 13")) << content("out");
}

/// The ends of an endless word tell which it is.
TEST_F(Failure, AnEndlessWordIsNotRepeated) {
  EXPECT_EQ(shell("stormproof simulate my.yaml --set " + std::string(5'000, 'a') + "z=1"), 2);
  EXPECT_LT(content("err").size(), 1'000U);
  EXPECT_TRUE(says("err", "aaa…aaa")) << content("err");
  EXPECT_TRUE(says("err", "z")) << content("err");
}

TEST_F(Failure, CommandsSayTheProgramAsItWasCalled) {
  EXPECT_EQ(shell("stormproof simulate my.yaml --format json"), 0);
  EXPECT_TRUE(says("out", "\"command\": \"stormproof simulate my.yaml\"")) << content("out");
  EXPECT_EQ(shell("ln -s '" STORMPROOF_PROGRAM "' other; PATH=/usr/bin:/bin; ./other simulate "
                  "my.yaml --format json"),
            0);
  EXPECT_TRUE(says("out", "\"command\": \"./other simulate my.yaml\"")) << content("out");
}

}  // namespace failure_test
