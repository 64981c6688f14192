// The text of a drafted scenario.
#include "checker/evidence/init/draft.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/evidence/doctor/advise.hpp"
#include "checker/evidence/validate/validate.hpp"
#include "checker/presentation/document/unreached.hpp"
#include "model/config/distributions.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/config/resolve.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/quantities.hpp"
#include "model/config/tree/suggestion.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "model/config/vendor/reference.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/implementations.hpp"

namespace stormproof::init {

namespace {

using model::config::InputError;
using model::config::print_duration;
using model::config::quoted_scalar;
using model::config::Result;
using model::config::Rmw;
using model::config::SpecPath;

/// How far apart the processes of one launch file start, about.
constexpr model::Nanoseconds launch{200'000'000};
/// How long a process takes to create one endpoint, from measurements of live runs.
constexpr std::int64_t creation_ns = 2'500'000;
/// Endpoints that every node of ROS 2 has: services of parameters, rosout, discovery info.
constexpr std::int64_t defaults = 17;

/// What stands for the library: the value of `dds`, and how it came about.
struct Library {
  std::string dds;
  std::string why;
  std::string text = quoted_scalar(dds);  ///< as the file has it
};

/// "fastdds-2.6.11" → "fastdds-server-2.6.11", or the profile with the way to discover beside it.
Library with_discovery(Library library, const System& system, const SpecPath& specs) {
  if (system.discovery.empty()) return library;
  const bool is_static = system.discovery == "static";
  const auto preset = system.dds.empty() ? model::config::preset_with(
                                               library.dds, is_static ? "static" : "server", specs)
                                         : std::nullopt;
  if (preset) library.dds = *preset;
  const bool has_usual_ports = system.peer_ports == model::DdsProfile{}.peer_ports;
  if (preset && system.discovery != "super_client" && has_usual_ports) {
    library.text = quoted_scalar(*preset);
    return library;
  }
  library.text =
      fmt::format("{{base: {}, discovery: {}{}}}", library.text, system.discovery,
                  is_static ? fmt::format(", peer_ports: {}", system.peer_ports) : std::string{});
  return library;
}

/// The profile that is given. A vendor's file is read by the version that the distribution ships,
/// if it is known; a way to discover that the environment chooses acts on simple discovery alone.
Result<Library> given(const System& system, const std::string& version, const SpecPath& specs) {
  Library library{system.dds, "as given"};
  const auto file = model::config::vendor::parse_reference(system.dds);
  if (file && file->selection.base.empty() && system.knows_ros) {
    library.dds += "@" + version;
    library.text = quoted_scalar(library.dds);
    library.why = fmt::format("as given, read by what ROS 2 {} ships", system.ros);
  }
  if (system.discovery.empty()) return library;
  const auto profile = model::config::read_dds_profile(library.dds, {}, specs);
  if (!profile) return profile.error();
  if (profile->discovery == model::Discovery::simple) return with_discovery(library, system, specs);
  library.why += "; it chooses a way to discover itself, which prevails over the environment";
  return library;
}

Result<Library> library_of(const System& system, const SpecPath& specs) {
  if (!system.dds.empty() && !system.knows_ros) return given(system, {}, specs);
  if (system.rmw != "fastrtps" && system.rmw != "cyclonedds") {
    return InputError{"--rmw " + system.rmw, "expected fastrtps or cyclonedds"};
  }
  const Rmw rmw = system.rmw == "cyclonedds" ? Rmw::cyclonedds : Rmw::of_the_distribution;
  const auto known = model::config::read_distributions(specs.directories, rmw);
  if (!known) return known.error();
  std::vector<std::string> names;
  for (const model::config::Distribution& one : *known) {
    if (one.name == system.ros) {
      if (!system.dds.empty()) return given(system, one.profile, specs);
      return with_discovery({one.profile, statement_of(one)}, system, specs);
    }
    names.push_back(one.name);
  }
  return InputError{
      "--ros " + system.ros,
      fmt::format("no distribution with a profile for rmw_{}_cpp{}; there are: {}", system.rmw,
                  model::config::suggestion(system.ros, names), fmt::join(names, ", "))};
}

/// `text` as a comment, in lines.
std::string comment(const std::string& text) {
  constexpr std::size_t width = 110;
  std::string lines;
  std::string line = "#";
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (line.size() + 1 + word.size() > width) {
      lines += line + "\n";
      line = "#";
    }
    line += " " + word;
    at = end + 1;
  }
  return lines + line + "\n";
}

std::string schedule(const System& system, bool creates_over_time) {
  if (!creates_over_time) {
    return fmt::format(
        "  schedule:                       # drawn anew for each run of `simulate --samples`\n"
        "    start: [0s, {}]            # assumed: when processes start\n",
        print_duration(launch));
  }
  const std::int64_t creation = creation_ns * (system.endpoints + defaults);
  return fmt::format(
      "  loopback_delay: 60us              # assumed: a packet to a participant of the same host\n"
      "  schedule:                         # drawn anew for each run of `simulate --samples`\n"
      "    start: [0s, {}]              # assumed: when processes start; measure yours\n"
      "    endpoints_done: [{}, {}]     # assumed: 2.5 ms for each endpoint, as in live runs\n",
      print_duration(launch), print_duration(launch + model::Nanoseconds{creation}),
      print_duration(launch + model::Nanoseconds{2 * creation}));
}

/// What participants ask for. No line where none asks, and none where the model has no answer: with
/// a Discovery Server and with losses.
std::string types(const System& system, const model::DdsProfile& dds) {
  if (!model::fastdds::looks_up_types(dds) || model::traits_of(dds).has_server) return {};
  return fmt::format(
      "  types: {{unknown_per_participant: {}}}  # {} message types of a process that another "
      "lacks\n"
      "                                    # and asks for; none: fastdds.type_propagation =\n"
      "                                    # registration_only, which is dds.type_lookup=false\n",
      system.unknown_types.value_or(usual_unknown_types),
      system.unknown_types ? "given:" : "assumed, as in Nav2:");
}

/// Several Discovery Servers; one is there anyway.
std::string servers(const System& system) {
  if (system.servers < 2) return {};
  std::vector<std::string> hosts;
  for (std::uint32_t k = 0; k < system.servers; ++k) {
    hosts.push_back(fmt::format("{{host: {}}}", k % system.hosts));
  }
  return fmt::format("  servers: [{}]  # assumed: on which hosts they are\n",
                     fmt::join(hosts, ", "));
}

std::string head(const System& system) {
  std::string text =
      "# Drafted by `stormproof init`. Change what is not so on your robots, then:\n"
      "#   stormproof simulate THIS_FILE     how long discovery takes, and whether it is a storm\n"
      "#   stormproof check THIS_FILE        what is proved about it, and what breaks\n"
      "#   stormproof tune THIS_FILE         which settings help\n";
  for (const std::string& remark : system.remarks) text += comment(remark);
  return text;
}

/// With a remark on top about participants that some never find.
std::string with_unreached(const std::string& text, const model::Scenario& scenario) {
  const std::string remark = report::unreached(scenario);
  return remark.empty() ? text : comment(remark) + text;
}

/// What is wrong with the numbers that were given: the draft, of which the error of its reading
/// speaks, is nothing that anybody has seen.
InputError about_numbers(const System& system, const InputError& error) {
  if (!error.where.starts_with("init:")) return error;
  constexpr std::string_view key = "deployment: expected ";
  if (!error.message.starts_with(key)) {
    return {fmt::format("init with {} hosts, {} participants and {} endpoints", system.hosts,
                        system.participants, system.endpoints),
            error.message};
  }
  return {fmt::format("--participants {}", system.participants),
          "expected " + error.message.substr(key.size())};
}

}  // namespace

bool looks_up_types(const System& system, const SpecPath& specs) {
  const auto library = library_of(system, specs);
  if (!library) return false;
  const auto dds = model::config::read_dds_profile(library->dds, {}, specs);
  return dds && model::fastdds::looks_up_types(*dds);
}

Result<std::string> draft(const System& system, const SpecPath& specs) {
  if (system.hosts < 2) {
    return InputError{fmt::format("--hosts {}", system.hosts),
                      "on a single host nothing crosses the network, so there is no discovery to "
                      "predict; give the number of robots and other computers, 2 or more"};
  }
  const auto library = library_of(system, specs);
  if (!library) return library.error();
  const auto dds = model::config::read_dds_profile(library->dds, {}, specs);
  if (!dds) return dds.error();
  const bool over_time = model::traits_of(*dds).creates_endpoints_over_time;
  std::string text = head(system);
  text += fmt::format(
      "description: {} hosts with {} participants of {} endpoints each, {} over {}\n\n"
      "deployment:\n"
      "  hosts: {}                          # whatever has an address of its own: robots, servers\n"
      "  participants_per_host: {}          # processes (contexts) with nodes; a container is one\n"
      "  endpoints_per_participant: {}     # publishers and subscriptions, two for each client or\n"
      "                                    # server of a service; each node's own are added\n",
      system.hosts, system.participants, system.endpoints,
      system.dds.empty() ? "ROS 2 " + system.ros : system.dds, system.wireless, system.hosts,
      system.participants, system.endpoints);
  text += servers(system);
  const std::string before = text;
  text += types(system, *dds);
  std::string rest = schedule(system, over_time);
  rest += comment(library->why);
  rest += fmt::format("dds: {}\n", library->text);
  rest += fmt::format("wireless: {}        # `stormproof list wireless` shows all\n",
                      quoted_scalar(system.wireless));
  rest += "time_limit: 120s                    # a run that takes longer did not complete\n";
  const auto read = model::config::parse_scenario(text + rest, "init", {}, specs);
  if (read) return with_unreached(text + rest, *read);
  if (system.unknown_types || text == before) return about_numbers(system, read.error());
  const std::string without =
      before +
      comment("Lookups of types are left out: the model has none where packets are lost.") + rest;
  if (model::config::parse_scenario(without, "init", {}, specs)) return without;
  return about_numbers(system, read.error());
}

Result<std::string> draft_of_capture(const capture::Conversation& conversation,
                                     const System& system) {
  doctor::Request look;
  look.advise = false;
  auto report = doctor::diagnose(conversation, look);
  if (!report) return report.error();
  std::string dds = system.dds;
  std::string why = "as given";
  if (dds.empty() && !report->presets.empty()) {
    dds = report->presets.front();
    why = "every message of the capture has a cause under this profile";
  } else if (dds.empty() && !report->products.empty()) {
    const auto profiles = doctor::profiles_of(report->products.front());
    if (!profiles.empty()) dds = profiles.front();
    why = fmt::format("the shipped profile nearest to {} {}", report->products.front().vendor,
                      report->products.front().version);
  }
  if (dds.empty()) {
    return InputError{"capture", "of a library of which there is no profile; give one with --dds"};
  }
  validate::Request request;
  request.dds = dds;
  request.wireless = system.wireless;
  request.sampling.samples = 1;
  const auto shown = validate::validate(conversation, request);
  if (!shown) return shown.error();
  // Only the deployment: the profiles are named, so that they can be changed.
  const std::string all = model::config::effective_yaml(shown->scenario);
  const std::string deployment = all.substr(0, all.find("\ndds:") + 1);
  std::string text =
      head(system) +
      comment("The deployment is the one in the capture, participant by participant.") +
      deployment + comment(fmt::format("{}: {}", dds, why)) +
      fmt::format("dds: {}\nwireless: {}\ntime_limit: 120s\n", quoted_scalar(dds),
                  quoted_scalar(system.wireless));
  const auto read = model::config::parse_scenario(text, "init", {}, SpecPath::standard());
  if (!read) return read.error();
  return text;
}

}  // namespace stormproof::init
