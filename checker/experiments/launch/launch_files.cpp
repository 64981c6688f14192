// A launch file and units for each host, with the delays of the plan after the instant at which the
// host is told to start. Which nodes a process runs is not known here: their names are put in.
#include <algorithm>

#include <fmt/core.h>

#include "checker/experiments/launch/launch_report.hpp"

namespace stormproof::launch {

namespace {

struct Process {
  std::string name;
  double delay_s = 0;
};

std::string launch_text(const std::vector<Process>& processes, const std::string& head) {
  std::string text = head +
                     "# Put your packages and executables in.\n"
                     "from launch import LaunchDescription\n"
                     "from launch.actions import TimerAction\n"
                     "from launch_ros.actions import Node\n"
                     "\n"
                     "\n"
                     "def generate_launch_description():\n"
                     "    return LaunchDescription([\n";
  for (const Process& one : processes) {
    text += fmt::format(
        "        TimerAction(period={:.3f}, actions=[\n"
        "            Node(package='your_package', executable='your_{}'),\n"
        "        ]),\n",
        one.delay_s, one.name);
  }
  return text + "    ])\n";
}

/// The first process of a host is ready when it runs; systemd has no delay but by a timer or a
/// sleep before.
std::string unit_text(const Process& process, const std::string& head) {
  return head + fmt::format(
                    "[Unit]\n"
                    "Description=ROS 2 process {}\n"
                    "After=network-online.target\n"
                    "Wants=network-online.target\n"
                    "\n"
                    "[Service]\n"
                    "ExecStartPre=/bin/sleep {:.3f}\n"
                    "# Put your package and executable in.\n"
                    "ExecStart=/usr/bin/env ros2 run your_package your_{}\n"
                    "\n"
                    "[Install]\n"
                    "WantedBy=multi-user.target\n",
                    process.name, process.delay_s, process.name);
}

}  // namespace

std::vector<LaunchFile> launch_files(const Setting& setting, const Plan& plan,
                                     const Request& request) {
  const std::vector<model::Nanoseconds> starts = starts_in(setting, plan, request);
  std::vector<LaunchFile> files;
  if (starts.empty()) return files;
  const auto& deployment = setting.scenario.deployment;
  std::string head = fmt::format("# {}: {}, {}.\n", request.scenario, words_of(plan), setting.name);
  if (plan.waits()) head += "# The delays are those of a simulated run.\n";
  const std::vector<std::uint32_t> hosts = starts_of(deployment, Order::by_host);
  for (std::uint32_t host = 0; host <= *std::ranges::max_element(hosts); ++host) {
    std::vector<Process> processes;
    std::string name = fmt::format("host-{}", host);
    for (std::size_t i = 0; i < hosts.size(); ++i) {
      if (hosts[i] != host) continue;
      const std::uint32_t number = deployment.participants[i].host.value;
      if (number < deployment.hosts.size()) name = deployment.hosts[number].name;
      processes.push_back({fmt::format("process_{}", processes.size()),
                           static_cast<double>(starts[i].count()) * 1e-9});
    }
    files.push_back({name + ".launch.py", launch_text(processes, head)});
    for (const Process& one : processes) {
      files.push_back({fmt::format("{}-{}.service", name, one.name), unit_text(one, head)});
    }
  }
  return files;
}

std::vector<LaunchFile> launch_files(const std::string& what, const model::Scenario& scenario,
                                     const Plan& plan, const std::string& named,
                                     std::uint64_t seed) {
  Request request;
  request.scenario = named;
  request.seed = seed;
  return launch_files(Setting{"", what, scenario, {}, {}}, plan, request);
}

}  // namespace stormproof::launch
