// Each candidate is read as a scenario with another DDS profile, so that whatever depends on the
// profile (a wireless profile of the same name, ranges, rules) is as if the user had written it.
#include "checker/experiments/compare/candidates.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/vendor/vendor_knobs.hpp"
#include "model/fastdds/peer_ports.hpp"

namespace stormproof::compare {

using model::DdsProfile;
using model::config::Result;
using model::config::SpecKind;
using model::config::SpecPath;
namespace vendor = model::config::vendor;

namespace {

constexpr std::string_view fastdds = "fastdds-";
constexpr std::string_view usual_version = "2.6.11";

/// "fastdds-server-2.14.5", "fastdds-2.6.11-sndbuf4M" → "2.14.5", "2.6.11".
std::string version_in(const std::string& preset) {
  const std::size_t digit = preset.find_first_of("0123456789");
  if (digit == std::string::npos) return {};
  return preset.substr(digit, preset.find('-', digit) - digit);
}

/// What a candidate is made of.
struct Recipe {
  const char* id;
  const char* name;
  const char* change;
  std::string preset;
  std::vector<std::string> settings{};  ///< below `dds`: "discovery=static"
  const char* measured = "";
  Placement placement = Placement::as_it_is;
};

class Kitchen {
 public:
  Kitchen(const std::string& reference, std::span<const std::string> overrides,
          const SpecPath& specs, Candidates& all)
      : reference_{reference}, overrides_{overrides}, specs_{specs}, all_{all} {
    const bool of_fastdds = all.preset.starts_with(fastdds);
    const std::string version = of_fastdds ? version_in(all.preset) : std::string{usual_version};
    simple_ = shipped(fmt::format("fastdds-{}", version), "fastdds-2.6.11");
    server_ = shipped(fmt::format("fastdds-server-{}", version), "fastdds-server-2.6.11");
    const bool is_cyclone = vendor::vendor_of_preset(all.preset) == vendor::Vendor::cyclonedds;
    cyclone_ = is_cyclone ? shipped(fmt::format("cyclonedds-{}", version_in(all.preset)),
                                    "cyclonedds-0.10")
                          : "cyclonedds-0.10";
  }

  void cook() {
    for (const Recipe& recipe : recipes()) all_.list.push_back(read(recipe));
    mark_own();
    add_all_at_once();
  }

 private:
  [[nodiscard]] std::string shipped(const std::string& name, const std::string& otherwise) const {
    const auto names = specs_.names(SpecKind::dds);
    return std::ranges::find(names, name) != names.end() ? name : otherwise;
  }

  [[nodiscard]] std::vector<Recipe> recipes() const {
    std::vector<Recipe> all{
        {"simple", "simple", "Fast DDS as it comes", simple_, {}, "simple"},
        {"server-on-a-robot",
         "server on a robot",
         "ROS_DISCOVERY_SERVER everywhere, and the server on the first robot",
         server_,
         {},
         "server"},
        {"server-on-its-own-host",
         "server on its own host",
         "the same with the server on one more host of the network",
         server_,
         {},
         "",
         Placement::server_on_own_host},
        {"super-clients",
         "super clients",
         "ROS_SUPER_CLIENT=TRUE beside it, everywhere",
         server_,
         {"discovery=super_client"},
         "super_client"},
        {"static-peers",
         "static peers",
         "initial peers instead of multicast, with as many ports as a robot has participants",
         simple_,
         {"discovery=static"},
         "static"},
        {"large-send-buffer",
         "send buffer 4 MB",
         "sendBufferSize of the UDP transport",
         simple_,
         {"sedp.piggyback_threshold_bytes=4000000"},
         "large-send-buffer"},
        {"one-process",
         "one process per robot",
         "all nodes of a robot as components of one container",
         simple_,
         {},
         "",
         Placement::one_process_per_host},
        {"cyclone-unicast",
         "Cyclone spdp",
         "rmw_cyclonedds_cpp; what it chooses on Wi-Fi",
         cyclone_,
         {"allow_multicast=spdp"},
         "cyclone-unicast"},
        {"cyclone-multicast",
         "Cyclone multicast",
         "the same with AllowMulticast true",
         cyclone_,
         {"allow_multicast=true"},
         "cyclone-multicast"},
        {"cyclone-heartbeat",
         "Cyclone HEARTBEAT 1 s",
         "spdp with HeartbeatInterval 1 s instead of 100 ms",
         cyclone_,
         {"allow_multicast=spdp", "sedp.heartbeat_interval=1s"},
         "cyclone-heartbeat"}};
    if (looks_up_types(simple_)) {
      all.insert(all.begin() + 1, {"registration-only",
                                   "types not announced",
                                   "the property fastdds.type_propagation=registration_only",
                                   simple_,
                                   {"type_lookup=false"}});
    }
    return all;
  }

  [[nodiscard]] bool looks_up_types(const std::string& preset) const {
    const auto dds = model::config::read_dds_profile(preset, {}, specs_);
    return dds && dds->version.type_lookup == model::Whether::yes;
  }

  [[nodiscard]] Candidate read(const Recipe& recipe) const {
    Candidate made;
    made.id = recipe.id;
    made.name = recipe.name;
    made.change = recipe.change;
    made.profile = recipe.preset;
    made.measured = recipe.measured;
    made.placement = recipe.placement;
    std::vector<std::string> changes{"dds=" + recipe.preset};
    for (const std::string& setting : recipe.settings) changes.push_back("dds." + setting);
    for (const std::string& given : overrides_) {
      if (!given.starts_with("dds=") && !given.starts_with("dds.")) changes.push_back(given);
    }
    // Several servers are the scenario's own; others have one or none.
    const model::Deployment& deployment = all_.scenario.deployment;
    if (!deployment.servers.empty()) changes.emplace_back("deployment.servers=[]");
    const auto scenario = model::config::read_scenario(reference_, changes, specs_);
    if (!scenario) {
      made.skipped = to_string(scenario.error());
      return made;
    }
    made.dds = scenario->dds;
    made.wireless = scenario->wireless;
    made.asks_every_port = made.dds.discovery == model::Discovery::static_peers;
    if (recipe.preset == server_ && version_in(server_) != version_in(simple_)) {
      made.note = fmt::format("that of {}: there is no profile of another version", server_);
    }
    return made;
  }

  /// The scenario's own profile is one of the candidates, or stands before them.
  void mark_own() {
    const auto plain = [](DdsProfile dds) {
      dds.unmodelled.clear();
      return dds;
    };
    const DdsProfile own = plain(all_.scenario.dds);
    const bool reaches_all = model::fastdds::announcements_reach_all(all_.scenario);
    const bool lists_servers = !all_.scenario.deployment.servers.empty();
    const auto same = std::ranges::find_if(all_.list, [&](const Candidate& one) {
      if (lists_servers) return false;
      if (one.asks_every_port && !reaches_all) return false;
      return one.skipped.empty() && one.placement == Placement::as_it_is && plain(one.dds) == own;
    });
    if (same != all_.list.end()) {
      same->is_own = true;
      return;
    }
    Candidate first;
    first.id = "as-it-is";
    first.name = "as it is";
    first.change = "nothing: the DDS profile of the scenario";
    first.profile = all_.preset.empty() ? "of its own" : all_.preset;
    first.dds = all_.scenario.dds;
    first.wireless = all_.scenario.wireless;
    first.is_own = true;
    all_.list.insert(all_.list.begin(), std::move(first));
  }

  /// Where starts are spread, what the scenario says with all started at once.
  void add_all_at_once() {
    const launch::Plan together{launch::Order::at_once};
    const model::Deployment& deployment = all_.scenario.deployment;
    if (!launch::can_vary(deployment) || launch::plan_of(deployment) == together) return;
    const auto own = std::ranges::find_if(all_.list, &Candidate::is_own);
    Candidate made = *own;
    made.id = "all-at-once";
    made.name = "all at once";
    made.change =
        "all processes start at once, instead of " + launch::words_of(launch::plan_of(deployment));
    made.measured.clear();
    made.plan = together;
    made.is_own = false;
    all_.list.insert(own + 1, std::move(made));
  }

  const std::string& reference_;
  std::span<const std::string> overrides_;
  const SpecPath& specs_;
  Candidates& all_;
  std::string simple_, server_, cyclone_;
};

}  // namespace

Result<Candidates> candidates_of(const std::string& reference,
                                 std::span<const std::string> overrides, const SpecPath& specs) {
  auto traced = model::config::trace_scenario(reference, overrides, specs);
  if (!traced) return traced.error();
  Candidates all;
  all.scenario = std::move(traced->value);
  all.preset = traced->preset;
  Kitchen{reference, overrides, specs, all}.cook();
  return all;
}

namespace {
/// There is one, if there is any.
void without_listed_servers(model::Deployment& deployment) {
  deployment.servers.clear();
  for (model::Participant& one : deployment.participants) one.servers.clear();
}
}  // namespace

Instance instance_of(const Candidates& all, const Candidate& candidate, Grows what,
                     std::uint32_t size) {
  Instance instance{all.scenario, candidate.skipped};
  if (!instance.refused.empty()) return instance;
  model::Scenario& scenario = instance.scenario;
  scenario.dds = candidate.dds;
  scenario.wireless = candidate.wireless;
  scenario.deployment = grown(all.scenario.deployment, what, size);
  if (!candidate.is_own) without_listed_servers(scenario.deployment);
  if (candidate.asks_every_port) {
    const std::uint32_t ports = size_of(scenario.deployment, Grows::participants);
    scenario.dds.peer_ports = std::max(scenario.dds.peer_ports, ports);
  }
  switch (candidate.placement) {
    case Placement::as_it_is:
      break;
    case Placement::one_process_per_host:
      if (size_of(scenario.deployment, Grows::participants) == 1) {
        instance.refused = "every robot has one participant as it is";
      }
      scenario.deployment = composed(scenario.deployment);
      break;
    case Placement::server_on_own_host:
      scenario.deployment = beside_a_server(std::move(scenario.deployment));
      break;
  }
  if (const auto& schedule = scenario.deployment.schedule) {
    scenario.deployment.draw_schedule(schedule->seed);
  }
  if (!model::config::is_valid(scenario)) {
    instance.refused = "no scenario that runs: a rule or range of the model forbids it";
  }
  return instance;
}

}  // namespace stormproof::compare
