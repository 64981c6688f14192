// Variables are looked at one after the other as specs/variables.yaml has them; what those say that
// are read is put together as rcl and rmw_fastrtps do.
#include "checker/evidence/init/environment.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/evidence/init/variables.hpp"
#include "model/config/tree/tree.hpp"
#include "model/config/vendor/addresses.hpp"

namespace stormproof::init {

namespace {

using model::config::InputError;
using model::config::Result;

/// rmw_fastrtps asks so many ports of its own host and of each peer where there is no multicast
/// (rmw_fastrtps_shared_cpp, participant.cpp).
constexpr std::uint32_t ports_of_localhost = 32;

class Environment {
 public:
  Environment(System& system, const std::function<const char*(const char*)>& value_of)
      : system_{system}, value_of_{value_of} {}

  std::optional<InputError> take(const model::config::SpecPath& specs) {
    if (const std::string ros = set("ROS_DISTRO"); !ros.empty()) {
      system_.ros = ros;
      system_.knows_ros = true;
    }
    if (auto error = take_rmw()) return error;
    const auto variables = read_variables(specs.directories);
    if (!variables) return variables.error();
    for (const Variable& variable : *variables) {
      if (auto error = read(variable)) return error;
    }
    take_file();
    if (auto error = look_at_addresses()) return error;
    if (auto error = take_range()) return error;
    take_server();
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::string set(const std::string& name) const {
    const char* found = value_of_(name.c_str());
    return found == nullptr ? "" : found;
  }
  /// As the library has it: empty if it does not read it.
  [[nodiscard]] std::string value(const std::string& name) const {
    const auto found = read_.find(name);
    return found == read_.end() ? "" : found->second;
  }
  void remark(const std::string& name, const std::string& what) {
    system_.remarks.push_back(
        fmt::format("{}={} is set where this was drafted. {}", name, set(name), what));
  }

  std::optional<InputError> take_rmw() {
    const std::string rmw = set("RMW_IMPLEMENTATION");
    if (rmw == "rmw_fastrtps_cpp" || rmw == "rmw_fastrtps_dynamic_cpp") {
      system_.rmw = "fastrtps";
    } else if (rmw == "rmw_cyclonedds_cpp") {
      system_.rmw = "cyclonedds";
    } else if (!rmw.empty()) {
      return InputError{"RMW_IMPLEMENTATION=" + rmw,
                        "there is a model of rmw_fastrtps_cpp, rmw_fastrtps_dynamic_cpp and "
                        "rmw_cyclonedds_cpp"};
    }
    return std::nullopt;
  }
  /// What the distribution and the RMW do not read is said, and not looked at.
  std::optional<InputError> read(const Variable& variable) {
    const std::string is = set(variable.name);
    if (is.empty()) return std::nullopt;
    if (variable.rmw != "any" && variable.rmw != system_.rmw) {
      remark(variable.name, fmt::format("rmw_{}_cpp does not read it.", system_.rmw));
      return std::nullopt;
    }
    if (!variable.is_read_by(system_.ros)) {
      remark(variable.name, fmt::format("ROS 2 {} does not read it; {} do.", system_.ros,
                                        fmt::join(variable.read_by, ", ")));
      return std::nullopt;
    }
    if (const std::string why = variable.why_not(is); !why.empty()) {
      return InputError{variable.name + "=" + is, why};
    }
    if (!variable.remark.empty()) remark(variable.name, variable.remark);
    read_.emplace(variable.name, is);
    return std::nullopt;
  }

  void take_file() {
    for (const char* name :
         {"CYCLONEDDS_URI", "FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE"}) {
      std::string file = value(name);
      if (file.starts_with("file://")) file = file.substr(7);
      if (file.empty() || !system_.dds.empty()) continue;
      system_.dds = file;
      system_.remarks.push_back(fmt::format("The profile is the file that {} names.", name));
    }
  }

  /// Addresses that a tutorial has in their place, and what is none, reach nobody.
  [[nodiscard]] std::optional<InputError> look_at_addresses() const {
    for (const char* name : {"ROS_STATIC_PEERS", "ROS_DISCOVERY_SERVER"}) {
      const std::string list = value(name);
      bool has_one = false;
      for (std::size_t at = 0; at <= list.size();) {
        const std::size_t end = std::min(list.find(';', at), list.size());
        std::string_view one = model::config::trimmed(std::string_view{list}.substr(at, end - at));
        at = end + 1;
        if (one.empty()) continue;  // a server that is left out
        has_one = true;
        constexpr std::string_view udp = "UDPv4:[";
        if (one.starts_with(udp)) {
          one.remove_prefix(udp.size());
          one = one.substr(0, one.find(']'));
        }
        const std::string why = model::config::vendor::why_no_endpoint(one);
        if (!why.empty()) return InputError{fmt::format("{}={}", name, list), why};
      }
      if (!list.empty() && !has_one) {
        return InputError{fmt::format("{}={}", name, list), "there is no address in it"};
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] static InputError nobody(const std::string& setting) {
    return {setting, "with it nobody on other hosts is discovered, so there is nothing to draft"};
  }
  /// Which peers and which multicast there are. ROS_LOCALHOST_ONLY prevails; what is no word is
  /// LOCALHOST (rcl, init.c and discovery_options.c).
  std::optional<InputError> take_range() {
    const std::string name = "ROS_AUTOMATIC_DISCOVERY_RANGE";
    if (const std::string only = value("ROS_LOCALHOST_ONLY"); only.starts_with('1')) {
      return nobody("ROS_LOCALHOST_ONLY=" + only);
    }
    const std::string setting = value(name);
    const std::string peers = value("ROS_STATIC_PEERS");
    constexpr std::array words{"", "OFF", "LOCALHOST", "SUBNET", "SYSTEM_DEFAULT"};
    const bool is_word = std::ranges::find(words, setting) != words.end();
    const std::string range = is_word ? setting : "LOCALHOST";
    const std::string is_said =
        name + "=" + setting + (is_word ? "" : ", which is none of its words and means LOCALHOST");
    if (range == "OFF" || (range == "LOCALHOST" && peers.empty())) return nobody(is_said);
    if (setting.empty() && peers.empty()) return std::nullopt;
    const std::string about = about_range(range, peers);
    if (!setting.empty()) {
      remark(name,
             fmt::format("{}{}{}", is_word ? "" : "That is no word of it and means LOCALHOST.",
                         is_word || about.empty() ? "" : " ", about));
    }
    if (!peers.empty()) remark("ROS_STATIC_PEERS", about);
    return std::nullopt;
  }
  std::string about_range(const std::string& range, const std::string& peers) {
    if (peers.empty()) return "Announcements go by multicast.";
    if (range == "SYSTEM_DEFAULT") return "So ROS_STATIC_PEERS is not looked at.";
    if (system_.rmw == "cyclonedds") return "Announcements to peers are not in this scenario.";
    if (range != "LOCALHOST")
      return "Announcements go by multicast and to these peers, too, which is not in this "
             "scenario.";
    system_.discovery = "static";
    system_.peer_ports = ports_of_localhost;
    return fmt::format("Announcements go to {} ports of each of ROS_STATIC_PEERS={}.",
                       ports_of_localhost, peers);
  }

  /// Those between semicolons; an empty place is an identity that no server has.
  static std::uint32_t servers_in(const std::string& list) {
    std::uint32_t count = 0;
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
      end = list.find(';', begin);
      if (end != begin && begin < list.size()) ++count;
    }
    return count;
  }

  void take_server() {
    const std::string servers = value("ROS_DISCOVERY_SERVER");
    if (servers.empty()) return;
    const std::string super = value("ROS_SUPER_CLIENT");
    const bool is_super = super == "TRUE" || super == "True" || super == "true" || super == "1";
    system_.discovery = is_super ? "super_client" : "server";
    system_.servers = servers_in(servers);
    const std::string one = is_super ? "With ROS_SUPER_CLIENT all are super clients."
                                     : "All are clients of one server on the first host.";
    remark("ROS_DISCOVERY_SERVER", system_.servers < 2
                                       ? one
                                       : fmt::format("All are {}clients of all {} servers.",
                                                     is_super ? "super " : "", system_.servers));
  }

  System& system_;
  const std::function<const char*(const char*)>& value_of_;
  std::map<std::string, std::string> read_;
};

}  // namespace

Result<System> from_environment(System system,
                                const std::function<const char*(const char*)>& value_of,
                                const model::config::SpecPath& specs) {
  if (auto error = Environment{system, value_of}.take(specs)) return *std::move(error);
  return system;
}

}  // namespace stormproof::init
