// Starts the programs and reads what the verifier prints.
#include "checker/engines/promela/run_spin.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <vector>

#include <fmt/core.h>

#include "checker/engines/process/process.hpp"

namespace stormproof::promela {
namespace {

template <class T>
using Outcome = model::config::Result<T, std::string>;

/// Runs a program in `folder` that has to succeed; what went wrong, or nothing.
std::optional<std::string> run_tool(const std::vector<std::string>& arguments,
                                    const std::filesystem::path& folder) {
  const process::Run run = process::run({arguments, folder, true});
  if (!run.failure.empty()) return arguments[0] + " " + run.failure;
  if (run.status == 0) return std::nullopt;
  return fmt::format("{} failed with status {}: {}", arguments[0], run.status,
                     run.output.substr(0, 500));
}

/// The names of the claims, in the order of the model.
std::vector<std::string> claims_in(const std::string& promela) {
  static const std::regex claim{R"(\bltl\s+(\w+)\s*\{)"};
  std::vector<std::string> names;
  for (std::sregex_iterator it{promela.begin(), promela.end(), claim}, end; it != end; ++it) {
    names.push_back((*it)[1]);
  }
  return names;
}

/// Adds what one run of the verifier printed.
std::optional<std::string> add_run(const std::string& name, const std::string& output,
                                   SpinRun& total) {
  static const std::regex states{R"(([0-9]+) states, stored)"};
  static const std::regex errors{R"(errors: ([0-9]+))"};
  static const std::regex complaint{R"(pan: ?[0-9]+: [^\n]*|pan: error: [^\n]*)"};
  static const std::regex unfinished{
      R"(max search depth too small|reached -DMEMLIM bound|Search not completed|exceeded)"};
  std::smatch found;
  if (!std::regex_search(output, found, states)) {
    return fmt::format("the verifier counted no states: {}", output.substr(0, 500));
  }
  total.states += std::stoull(found[1]);
  if (!std::regex_search(output, found, errors)) return "the verifier counted no errors";
  const bool clean = found[1] == "0";
  std::smatch message;
  if (!clean && total.error.empty()) {
    const bool explained = std::regex_search(output, message, complaint);
    total.error = name + ": " + (explained ? message[0].str() : "error");
  } else if (clean && std::regex_search(output, message, unfinished) && total.error.empty()) {
    total.error = name + ": not exhaustive: " + message[0].str();
  }
  return std::nullopt;
}

std::optional<std::string> compile(const std::string& program,
                                   const std::vector<std::string>& options,
                                   const std::filesystem::path& folder) {
  std::vector<std::string> arguments{"gcc", "-Og", "-w", "-DMEMLIM=4096", "-o", program, "pan.c"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run_tool(arguments, folder);
}

/// One run of a verifier.
struct Verification {
  std::string name;
  std::string program;
  std::vector<std::string> options;
};

std::optional<std::string> verify(const Verification& what, const std::filesystem::path& folder,
                                  SpinRun& total) {
  std::vector<std::string> arguments{(folder / what.program).string(), "-m200000", "-Q10"};
  arguments.insert(arguments.end(), what.options.begin(), what.options.end());
  const auto started = std::chrono::steady_clock::now();
  const process::Run run = process::run({arguments, folder, true});
  total.seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!run.failure.empty()) return arguments.front() + " " + run.failure;
  return add_run(what.name, run.output, total);
}

}  // namespace

bool spin_is_available() {
  const std::filesystem::path nowhere = std::filesystem::temp_directory_path();
  return !run_tool({"spin", "-V"}, nowhere) && !run_tool({"gcc", "--version"}, nowhere);
}

Outcome<SpinRun> run_spin(const std::string& promela, const std::string& folder_name) {
  std::error_code failure;
  const std::filesystem::path folder = std::filesystem::absolute(folder_name, failure);
  std::ofstream model{folder / "model.pml"};
  model << promela;
  model.close();
  if (failure || !model) return fmt::format("{}: no model can be written there", folder_name);
  if (auto error = run_tool({"spin", "-a", "model.pml"}, folder)) return *error;
  SpinRun total;
  // Weak fairness needs a counter for every few processes; at most 18 of them here.
  if (auto error = compile("pan", {"-DNFAIR=5"}, folder)) return *error;
  for (const std::string& name : claims_in(promela)) {
    std::vector<std::string> options{"-a", "-N", name};
    if (name == "progress") options.emplace_back("-f");
    if (auto error = verify({name, "pan", options}, folder, total)) return *error;
    if (!total.error.empty()) return total;
  }
  // A verifier that has a claim does not look for invalid end states, whatever it is told.
  if (auto error = compile("pan_without_claims", {"-DNOCLAIM", "-DSAFETY"}, folder)) return *error;
  if (auto error = verify({"no deadlock", "pan_without_claims", {}}, folder, total)) return *error;
  total.ok = total.error.empty();
  return total;
}

}  // namespace stormproof::promela
