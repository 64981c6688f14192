// Ctrl-C on a long run: whatever it is doing, the program soon ends by itself with what is known so
// far, says so, and the files that it was writing are complete. A second Ctrl-C leaves none behind.
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/files.hpp"

namespace interrupt_test {

namespace fs = std::filesystem;
namespace files = stormproof::files;

using Words = std::vector<std::string>;

class Interrupt : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream grid{folder_ / "big.yaml"};
    grid << "base: live-5x20\ngrid: {time_limit: [100s";
    for (int k = 1; k < 5'000; ++k) grid << ", " << 100'000 + k << "ms";
    grid << "]}\n";
  }

  /// Starts the program in the folder, with its output in the files `out` and `err`.
  [[nodiscard]] pid_t start(const Words& arguments) const {
    const pid_t child = fork();
    if (child != 0) return child;
    (void)!chdir(folder_.c_str());
    (void)freopen("out", "w", stdout);
    (void)freopen("err", "w", stderr);
    std::vector<const char*> argv{"stormproof"};
    for (const std::string& word : arguments) argv.push_back(word.c_str());
    argv.push_back(nullptr);
    execv(STORMPROOF_PROGRAM, const_cast<char* const*>(argv.data()));
    _exit(127);
  }

  /// Its exit code, or minus the signal that ended it.
  static int end_of(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  /// The temporary file of the trace, once it has grown.
  [[nodiscard]] fs::path growing_trace() const {
    while (true) {
      for (const auto& entry : fs::directory_iterator{folder_}) {
        const bool is_partial = entry.path().extension() == ".partial";
        if (is_partial && entry.file_size() > 100'000) return entry.path();
      }
      usleep(10'000);
    }
  }

  [[nodiscard]] std::string content(const char* name) const {
    return files::content(folder_ / name);
  }
  [[nodiscard]] bool says_interrupted() const {
    return (content("out") + content("err")).find("nterrupted") != std::string::npos;
  }

  const files::Folder own_;
  const fs::path folder_ = own_.path();
};

const Words endless{
    "simulate",  "high-load-6x30",     "--set",   "deployment.participants_per_host=30",
    "--set",     "time_limit=100000s", "--trace", "trace.jsonl",
    "--progress"};

TEST_F(Interrupt, ReportsWhatIsKnownAndCompletesTheTrace) {
  const pid_t child = start(endless);
  const fs::path partial = growing_trace();
  kill(child, SIGINT);
  EXPECT_EQ(end_of(child), 3);
  EXPECT_NE(content("out").find("The run was interrupted at"), std::string::npos);
  EXPECT_FALSE(fs::exists(partial));
  const std::string trace = content("trace.jsonl");
  ASSERT_FALSE(trace.empty());
  EXPECT_EQ(trace.back(), '\n');
  EXPECT_NE(trace.find("\"end\":\"interrupted\""), std::string::npos);
}

TEST_F(Interrupt, ASecondOneEndsTheProgramWithoutHalfAFile) {
  const pid_t child = start(endless);
  const fs::path partial = growing_trace();
  kill(child, SIGSTOP);  // so that both are there when it looks
  kill(child, SIGINT);
  kill(child, SIGTERM);
  kill(child, SIGCONT);
  const int end = end_of(child);
  EXPECT_TRUE(end == -SIGINT || end == -SIGTERM || end == 3) << end;
  EXPECT_FALSE(fs::exists(partial));
}

/// A verb that works for much longer than this test waits.
struct Case {
  const char* name;
  Words arguments;
};

void PrintTo(const Case& tested, std::ostream* out) { *out << tested.name; }

const std::array cases{
    Case{"check", {"check", "high-load-6x30"}},
    Case{"check_without_cvc5", {"check", "wifi-5x20-fastdds", "--single-solver"}},
    Case{"mutate", {"mutate"}}, Case{"diff", {"diff", "fastdds-2.6.11", "fastdds-2.9.1"}},
    // What a variant has broken by then would be the answer.
    Case{"fuzz", {"fuzz", "wifi-5x20", "--runs", "100000", "--property", "safety.conservation"}},
    Case{"tune", {"tune", "wifi-5x20-fastdds", "--budget", "1000000"}},
    Case{"samples", {"simulate", "live-5x20", "--samples", "1000000"}},
    Case{"sweep", {"sweep", "big.yaml", "-o", "runs.db"}}, Case{"museum", {"museum"}},
    Case{"reproduce", {"reproduce", "paper", "--samples", "1000"}}};

/// Nobody has to stop a study that has been given its time.
TEST_F(Interrupt, AStudyKeepsToItsTime) {
  const Words studies[] = {{"compare-discovery", "wifi-5x20-fastdds", "--samples", "10000"},
                           {"launch", "fleet-4x2x20", "--samples", "10000"},
                           {"survive", "live-5x20", "--samples", "10000"},
                           {"sensitivity", "live-5x20"},
                           {"sweep", "big.yaml", "-o", "runs.db"},
                           {"fix", "fleet-4x2x20", "--samples", "100000"}};
  for (Words study : studies) {
    study.insert(study.end(), {"--time", "800ms"});
    const auto started = std::chrono::steady_clock::now();
    EXPECT_EQ(end_of(start(study)), 3) << study.front() << content("out") << content("err");
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
    EXPECT_LT(took.count(), 20.0) << study.front();  // on a loaded machine, sanitized
    EXPECT_NE(content("err").find("--time 800ms is over"), std::string::npos) << study.front();
  }
}

/// Those that plan for their time answer within it, and say what they did not ask; on a loaded
/// machine they may be stopped.
TEST_F(Interrupt, AStudyPlansForItsTime) {
  const Words studies[] = {
      {"tune", "wifi-5x20-fastdds", "--budget", "1000000", "--samples", "100000"},
      {"diff", "fastdds-2.6.11", "fastdds-2.9.1"}};
  for (Words study : studies) {
    study.insert(study.end(), {"--time", "800ms"});
    const auto started = std::chrono::steady_clock::now();
    const int code = end_of(start(study));
    EXPECT_TRUE(code == 0 || code == 1 || code == 3) << study.front() << content("err");
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
    EXPECT_LT(took.count(), 20.0) << study.front();  // on a loaded machine, sanitized
    const bool is_said = content("out").find("to keep to --time") != std::string::npos ||
                         content("err").find("--time 800ms is over") != std::string::npos;
    EXPECT_TRUE(is_said) << study.front() << content("out");
  }
}

TEST_F(Interrupt, FuzzRunsAsManyAsThereIsTimeFor) {
  EXPECT_EQ(
      end_of(start({"fuzz", "wifi-5x20", "--property", "safety.conservation", "--time", "2s"})), 0);
  EXPECT_EQ(content("err"), "");
  EXPECT_EQ(end_of(start({"fuzz", "smallest", "--property", "safety.conservation", "--runs", "2",
                          "--seconds", "2"})),
            0);
  EXPECT_NE(content("err").find("--seconds is given up; --time 60s says it"), std::string::npos);
}

TEST_F(Interrupt, TimeThatIsNoneIsRefused) {
  for (const char* time : {"0s", "60", "soon", "-1s"}) {
    EXPECT_EQ(end_of(start({"simulate", "smallest", "--time", time})), 2) << time;
    EXPECT_NE(content("err").find("--time"), std::string::npos) << time;
  }
}

class InterruptedVerb : public Interrupt, public testing::WithParamInterface<Case> {};

/// At different instants, so at different work.
TEST_P(InterruptedVerb, EndsSoonAndSaysSo) {
  for (const int milliseconds : {150, 700, 1'500}) {
    const pid_t child = start(GetParam().arguments);
    usleep(static_cast<useconds_t>(milliseconds) * 1000);
    const auto asked = std::chrono::steady_clock::now();
    kill(child, milliseconds == 700 ? SIGTERM : SIGINT);
    const int end = end_of(child);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - asked;
    // Before the program watches, a signal ends it.
    if (milliseconds == 150 && end < 0) continue;
    EXPECT_EQ(end, 3) << milliseconds << " ms: " << content("out") << content("err");
    EXPECT_TRUE(says_interrupted()) << milliseconds << " ms: " << content("out") << content("err");
    EXPECT_LT(took.count(), 20.0) << milliseconds << " ms";  // on a loaded machine, sanitized
  }
}

INSTANTIATE_TEST_SUITE_P(Verbs, InterruptedVerb, testing::ValuesIn(cases),
                         [](const auto& tested) { return std::string{tested.param.name}; });

}  // namespace interrupt_test
