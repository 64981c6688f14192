// What a user deploys: the files of the way or settings, and those of the launch plan.
#include <fmt/core.h>

#include "checker/experiments/fix/fix.hpp"
#include "checker/experiments/launch/launch_report.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::fix {

using compare::DeploymentFile;
using model::config::Result;

Result<std::vector<DeploymentFile>> files_of(const Attempt& attempt, const Request& request,
                                             const model::config::SpecPath& specs) {
  auto files = compare::deployment_files(attempt.candidate, attempt.scenario.dds, specs);
  if (!files || !attempt.plan) return files;
  for (launch::LaunchFile& file : launch::launch_files(
           attempt.name, attempt.scenario, *attempt.plan, request.scenario, request.seed)) {
    files->push_back({std::move(file.name), std::move(file.text)});
  }
  return files;
}

std::vector<std::string> how_to_load(const std::vector<DeploymentFile>& files,
                                     const std::string& folder) {
  std::vector<std::string> lines{"cd " + report::shell_word(folder)};
  bool has_units = false;
  for (const DeploymentFile& file : files) {
    if (file.name.ends_with(".env")) {
      lines.push_back(
          fmt::format(". ./{}  # on every robot, in the shell that starts ROS 2", file.name));
    } else if (file.name.ends_with(".launch.py")) {
      lines.push_back(
          fmt::format("ros2 launch ./{}  # on that robot; put your nodes in first", file.name));
    }
    has_units = has_units || file.name.ends_with(".service");
  }
  if (has_units) {
    lines.emplace_back("# or, at boot, on each robot its own units:");
    lines.emplace_back("# sudo cp HOST-*.service /etc/systemd/system/");
    lines.emplace_back("# sudo systemctl enable HOST-process_0.service …");
  }
  return lines;
}

}  // namespace stormproof::fix
