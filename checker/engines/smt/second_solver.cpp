// Asks cvc5, and turns the lines that it prints into answers.
#include "checker/engines/smt/second_solver.hpp"

#include <optional>
#include <sstream>

#include "checker/engines/process/process.hpp"

namespace stormproof::smt {
namespace {

/// Why a run has no answers, or nothing.
std::string failure_of(const process::Run& run) {
  if (!run.failure.empty() || run.status == 0) return run.failure;
  return "exit status " + std::to_string(run.status);
}

std::optional<Answer> answer_in(const std::string& line) {
  if (line == "sat") return Answer::sat;
  if (line == "unsat") return Answer::unsat;
  if (line == "unknown") return Answer::unknown;
  return std::nullopt;
}

}  // namespace

std::string second_solver_name() {
  const process::Run run =
      process::run({.arguments = {"cvc5", "--version"}, .limit = std::chrono::seconds{10}});
  const std::string prefix = "cvc5 version ";
  const auto begin = run.output.find(prefix);
  if (!run.succeeded()) return {};
  if (begin == std::string::npos) return "cvc5";
  const auto first = begin + prefix.size();
  return "cvc5 " + run.output.substr(first, run.output.find_first_of(" \n", first) - first);
}

SolverRun ask_second_solver(const std::string& path, std::size_t questions,
                            const Options& options) {
  // Budget and time-out per query are the solver's own; should it ignore them, it is stopped a
  // little later.
  const auto all =
      options.timeout * (static_cast<long long>(questions) + 1) + std::chrono::seconds{2};
  const process::Run run =
      process::run({.arguments = {"cvc5", "--lang=smt2", "--incremental",
                                  "--seed=" + std::to_string(options.seed),
                                  "--rlimit-per=" + std::to_string(options.budget.cvc5),
                                  "--tlimit-per=" + std::to_string(options.timeout.count()), path},
                    .limit = all,
                    .stop = options.interrupted});
  SolverRun result;
  result.failure = failure_of(run);
  std::istringstream lines{run.output};
  for (std::string line; std::getline(lines, line);) {
    if (const auto answer = answer_in(line)) {
      result.answers.push_back(*answer);
    } else if (!line.empty() && result.failure.empty()) {
      result.failure = line.substr(0, 200);
    }
  }
  return result;
}

}  // namespace stormproof::smt
