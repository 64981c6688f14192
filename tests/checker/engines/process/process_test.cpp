// Other programs: their output and status, and why there is none.
#include "checker/engines/process/process.hpp"

#include <chrono>
#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>

namespace stormproof::process {
namespace process_test {

using namespace std::chrono_literals;

TEST(Process, OutputAndStatusAreThoseOfTheProgram) {
  const auto ran = run({{"sh", "-c", "echo one; echo two >&2; exit 3"}});
  EXPECT_EQ(ran.output, "one\n");
  EXPECT_EQ(ran.failure, "");
  EXPECT_EQ(ran.status, 3);
  EXPECT_FALSE(ran.succeeded());
}

TEST(Process, ErrorsBelongToTheOutputIfAskedFor) {
  const auto ran = run({.arguments = {"sh", "-c", "echo one; echo two >&2"}, .errors = true});
  EXPECT_EQ(ran.output, "one\ntwo\n");
  EXPECT_TRUE(ran.succeeded());
}

TEST(Process, RunsInItsFolderAndGetsNothingToRead) {
  const auto ran = run({.arguments = {"sh", "-c", "pwd; cat"}, .folder = "/"});
  EXPECT_EQ(ran.output, "/\n");
  EXPECT_TRUE(ran.succeeded());
}

TEST(Process, AProgramThatIsNotThereIsAFailure) {
  const auto ran = run({{"no-such-program-as-this"}});
  EXPECT_NE(ran.failure.find("cannot be started"), std::string::npos) << ran.failure;
  EXPECT_FALSE(ran.succeeded());
}

TEST(Process, AProgramThatTakesTooLongIsStopped) {
  const auto start = std::chrono::steady_clock::now();
  const auto ran = run({.arguments = {"sleep", "600"}, .limit = 100ms});
  EXPECT_EQ(ran.failure, "was stopped after its time-out");
  EXPECT_LT(std::chrono::steady_clock::now() - start, 300s);
}

TEST(Process, AProgramIsStoppedOnRequestWithThoseThatItStarted) {
  int asked = 0;
  const auto ran =
      run({.arguments = {"sh", "-c", "sleep 600 & wait"}, .stop = [&] { return ++asked > 2; }});
  EXPECT_EQ(ran.failure, "interrupted");
}

TEST(Process, SignalsAreAsUsualForIt) {
  const auto previous = std::signal(SIGPIPE, SIG_IGN);
  const auto ran = run({.arguments = {"sh", "-c", "kill -PIPE $$; echo ignored"}});
  std::signal(SIGPIPE, previous);
  EXPECT_EQ(ran.failure, "ended by signal 13");
}

TEST(Process, AProgramThatPrintsTooMuchIsStopped) {
  const auto ran = run({{"yes"}});
  EXPECT_EQ(ran.failure, "printed more than 16 MB");
  EXPECT_LE(ran.output.size(), (1U << 24U) + 4096U);
}

TEST(Process, ASignalIsAFailure) {
  const auto ran = run({{"sh", "-c", "kill -9 $$"}});
  EXPECT_EQ(ran.failure, "ended by signal 9");
}

}  // namespace process_test
}  // namespace stormproof::process
