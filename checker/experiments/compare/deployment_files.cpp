// Texts beside the vendor's writer, which tuning uses, too.
#include "checker/experiments/compare/deployment_files.hpp"

#include <fmt/core.h>

#include "checker/experiments/tune/deploy.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/vendor/vendor_knobs.hpp"

namespace stormproof::compare {

using model::DdsProfile;
using model::Discovery;
using model::config::Result;
using model::config::SpecPath;
namespace vendor = model::config::vendor;

namespace {

constexpr const char* launch_file =
    "# All nodes of a robot in one process: one participant, as long as they share a context.\n"
    "# Put your packages and plugins in.\n"
    "from launch import LaunchDescription\n"
    "from launch_ros.actions import ComposableNodeContainer\n"
    "from launch_ros.descriptions import ComposableNode\n"
    "\n"
    "\n"
    "def generate_launch_description():\n"
    "    nodes = [\n"
    "        ComposableNode(package='your_package', plugin='your_package::YourNode'),\n"
    "    ]\n"
    "    return LaunchDescription([\n"
    "        ComposableNodeContainer(\n"
    "            name='robot', namespace='', package='rclcpp_components',\n"
    "            executable='component_container_mt', composable_node_descriptions=nodes),\n"
    "    ])\n";

std::string head(const Candidate& candidate) {
  return fmt::format("# {}: {}.\n", candidate.name, candidate.change);
}

std::string server_environment(const Candidate& candidate, bool is_super) {
  const bool apart = candidate.placement == Placement::server_on_own_host;
  std::string text = head(candidate);
  text += fmt::format(
      "# On {}, before anything else starts: fastdds discovery -i 0 -p 11811\n"
      "export RMW_IMPLEMENTATION=rmw_fastrtps_cpp\n"
      "export ROS_DISCOVERY_SERVER=192.0.2.1:11811  # put its address here\n",
      apart ? "a host of its own" : "the first robot");
  if (is_super) text += "export ROS_SUPER_CLIENT=TRUE  # from Fast DDS 2.6.7 and 2.13 on\n";
  return text;
}

std::string environment_with(const Candidate& candidate, const DdsProfile& dds,
                             const tune::Subject& subject, const std::string& xml) {
  std::string text = head(candidate);
  for (const std::string& line : tune::prerequisites(subject, dds)) text += "# " + line + "\n";
  for (const std::string& line : tune::how_to_load(subject.vendor, xml)) text += line + "\n";
  return text;
}

std::string plain_environment(const Candidate& candidate) {
  return head(candidate) +
         "export RMW_IMPLEMENTATION=rmw_fastrtps_cpp\n"
         "unset ROS_DISCOVERY_SERVER ROS_SUPER_CLIENT\n";
}

/// The library whose file is written: that of a profile that is built on a preset.
Result<tune::Subject> subject_of(const Candidate& candidate, const DdsProfile& dds,
                                 vendor::Vendor whose, const SpecPath& specs) {
  const auto base = model::config::read_dds_profile(candidate.profile, {}, specs);
  if (!base) return base.error();
  tune::Subject subject;
  subject.preset = candidate.profile;
  subject.vendor = whose;
  subject.base = *base;
  if (whose == vendor::Vendor::cyclonedds) {  // what is said by no file depends on the network
    const bool always = dds.allow_multicast == model::AllowMulticast::always;
    subject.base.allow_multicast =
        always ? model::AllowMulticast::spdp : model::AllowMulticast::always;
  }
  return subject;
}

}  // namespace

Result<std::vector<DeploymentFile>> deployment_files(const Candidate& candidate,
                                                     const DdsProfile& dds, const SpecPath& specs) {
  std::vector<DeploymentFile> files;
  const auto whose = vendor::vendor_of_preset(candidate.profile);
  if (!candidate.skipped.empty() || !whose || candidate.plan || candidate.id == "as-it-is") {
    return files;
  }
  const std::string environment = candidate.id + ".env";
  const std::string xml_name = candidate.id + ".xml";
  const bool is_super = dds.discovery == Discovery::super_client;
  if ((dds.discovery == Discovery::server || is_super) && candidate.id != "tuned") {
    files.push_back({environment, server_environment(candidate, is_super)});
    return files;
  }
  if (candidate.placement == Placement::one_process_per_host) {
    files.push_back({candidate.id + ".launch.py", launch_file});
    return files;
  }
  if (candidate.id == "simple") {
    files.push_back({environment, plain_environment(candidate)});
    return files;
  }
  const auto subject = subject_of(candidate, dds, *whose, specs);
  if (!subject) return subject.error();
  auto xml = tune::deployable(
      *subject, dds,
      fmt::format("{}: {} ({}).", candidate.name, candidate.change, candidate.profile), specs);
  if (!xml) return xml.error();
  files.push_back({xml_name, *std::move(xml)});
  files.push_back({environment, environment_with(candidate, dds, *subject, xml_name)});
  return files;
}

}  // namespace stormproof::compare
