// Fuzz targets: DDS profiles and wireless profiles. An accepted profile also has to make a valid
// scenario of the smallest deployment, or be refused with an error.
#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/fuzzing/checks.hpp"
#include "tests/fuzzing/memory_file.hpp"
#include "tests/fuzzing/targets.hpp"

namespace stormproof::fuzzing {

namespace {

namespace config = model::config;

/// The effective profile, read again, is equal; then it goes into a scenario.
template <class Profile>
Outcome check_profile(std::string_view input, const std::string& scenario_key,
                      config::Result<Profile> (*read)(const std::string&,
                                                      std::span<const std::string>,
                                                      const config::SpecPath&)) {
  if (names_a_device(input)) return Outcome::refused;
  const MemoryFile file{input};
  const auto profile = read(file.path(), {}, specs());
  if (!profile) {
    require(!profile.error().where.empty(), "an error has a place");
    require(!profile.error().message.empty(), "an error says what is wrong");
    return Outcome::refused;
  }
  const std::string text = config::effective_json(*profile).dump();
  const auto again = read(MemoryFile{text}.path(), {}, specs());
  require(again && *again == *profile, "an effective profile reads back as an equal one");

  const std::string replacement = scenario_key + "=" + text;
  const auto scenario = config::read_scenario("smallest", std::span{&replacement, 1}, specs());
  if (scenario) check_scenario(*scenario);
  return Outcome::accepted;
}

}  // namespace

Outcome dds_profile(std::string_view input) {
  return check_profile<model::DdsProfile>(input, "dds", config::read_dds_profile);
}

Outcome wireless_profile(std::string_view input) {
  return check_profile<model::WirelessProfile>(input, "wireless", config::read_wireless_profile);
}

}  // namespace stormproof::fuzzing
