// How differences are looked for: one object that sees both sides and collects what it finds.
// Participants and endpoints are looked at in differences.cpp, messages in message_differences.cpp.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "checker/evidence/validate/differences.hpp"
#include "model/implementations.hpp"

namespace stormproof::validate {

class Finder {
 public:
  Finder(const capture::Conversation& conversation, const Observation& observation,
         const model::Scenario& scenario, const Sizes& sizes)
      : conversation_{conversation},
        observation_{observation},
        counting_{observation.counting},
        scenario_{scenario},
        sizes_{sizes} {}

  [[nodiscard]] std::vector<Difference> find();

 private:
  void add(const char* id, std::uint64_t count, std::string text) {
    if (count > 0) found_.push_back({id, std::move(text), count});
  }
  [[nodiscard]] const model::ImplementationTraits& traits() const {
    return model::traits_of(scenario_.dds);
  }
  /// Whether the model's messages mix submessages of all built-in endpoints, as in Cyclone DDS.
  [[nodiscard]] bool mixes_submessages() const { return traits().mixes_messages; }
  [[nodiscard]] const capture::Participant& captured(const CapturedParticipant& one) const {
    return conversation_.topology.participants[one.number];
  }

  void who_takes_part();
  void endpoints();
  void control_relations();
  void creation();
  void destinations();
  void submessages();
  void other_bytes();
  void sizes_of_messages();
  void heartbeat_kinds();

  const capture::Conversation& conversation_;
  const Observation& observation_;
  const capture::Counting& counting_;
  const model::Scenario& scenario_;
  const Sizes& sizes_;
  std::vector<Difference> found_;
};

}  // namespace stormproof::validate
