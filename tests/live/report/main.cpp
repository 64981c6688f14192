// usage: stormproof_live_report [--json FILE] FOLDER...
// Puts runs of the live bed into one table, with what is wrong with them. Exit code: 0 all are as
// expected, 1 a check failed, 3 one is not complete (and no check failed), 2 bad usage or input.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "checker/cli/exit_code.hpp"
#include "checker/cli/output_file.hpp"
#include "tests/live/report/judgement.hpp"

namespace stormproof::live {

namespace {

int exit_code(const std::vector<RunRecord>& runs) {
  int code = cli::established;
  for (const RunRecord& run : runs) {
    const Outcome outcome = judge(run).outcome;
    if (outcome == Outcome::check_failed) return cli::violated;
    if (outcome == Outcome::incomplete) code = cli::inconclusive;
  }
  return code;
}

int complain(const std::string& message) {
  std::fprintf(stderr, "stormproof_live_report: %s\n", message.c_str());
  return cli::bad_input;
}

int report(const std::vector<std::string>& arguments) {
  std::string json_file;
  std::vector<RunRecord> runs;
  for (std::size_t at = 0; at < arguments.size(); ++at) {
    if (arguments[at] != "--json") {
      runs.push_back(read_run(arguments[at]));
    } else if (++at == arguments.size()) {
      return complain("--json: expected a file behind it");
    } else {
      json_file = arguments[at];
    }
  }
  if (runs.empty()) return complain("expected at least one folder of a run");
  cli::OutputFile file{json_file};
  if (const auto error = file.open_error()) return complain(*error);
  if (file.wanted()) file.stream() << to_json(runs);
  if (const auto error = file.commit()) return complain(*error);
  std::fputs(to_text(runs).c_str(), stdout);
  return exit_code(runs);
}

}  // namespace

}  // namespace stormproof::live

int main(int argc, char** argv) {
  try {
    return stormproof::live::report({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    return stormproof::live::complain(error.what());
  }
}
