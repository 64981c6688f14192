// How many types that others lack a process is drafted with, if nobody says: as many as give the
// lookups that the processes of Nav2 would make, by the list in specs/published.
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "checker/evidence/init/draft.hpp"

namespace stormproof::init {
namespace nav2_types_test {

using Types = std::set<std::string>;

/// A service is two types on the wire, an action two services and its feedback.
void add(Types& types, const std::string& name) {
  const auto with = [&](std::initializer_list<const char*> parts) {
    for (const char* part : parts) types.insert(name + part);
  };
  if (name.find("/srv/") != std::string::npos) return with({"_Request", "_Response"});
  if (name.find("/action/") == std::string::npos) return with({""});
  with({"_SendGoal_Request", "_SendGoal_Response", "_GetResult_Request", "_GetResult_Response",
        "_FeedbackMessage"});
}

TEST(UsualUnknownTypes, GiveAsManyLookupsAsTheProcessesOfNav2) {
  std::vector<Types> processes;
  Types all;
  for (const auto& process : YAML::LoadFile(STORMPROOF_SPECS_DIR "/published/nav2-types.yaml")) {
    processes.emplace_back();
    for (const auto& type : process.second) {
      add(processes.back(), type.as<std::string>());
      add(all, type.as<std::string>());
    }
  }
  ASSERT_EQ(processes.size(), 12U);
  // Each asks once for each type that it lacks, whoever has it. With U types of each that nobody
  // else has it would ask for (N - 1) U.
  std::size_t asked = 0;
  for (const Types& own : processes) asked += all.size() - own.size();
  const double n = static_cast<double>(processes.size());
  const double of_each = static_cast<double>(asked) / (n * (n - 1));
  EXPECT_EQ(std::lround(of_each), usual_unknown_types) << of_each;
}

}  // namespace nav2_types_test
}  // namespace stormproof::init
