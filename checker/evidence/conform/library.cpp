// Compares the version that DATA(p) shows with the profile's sizes.
#include "checker/evidence/conform/library.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/capture/library_version.hpp"
#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/vendor/fastdds_schema.hpp"

namespace stormproof::conform {

namespace versions = model::config::vendor::fastdds;

std::optional<Unexplained> other_version(const Context& its, std::size_t i) {
  const capture::Conversation& conversation = its.dialogue.conversation;
  const capture::Participant& participant = conversation.topology.participants[i];
  const auto version = capture::version_in(participant.version);
  if (participant.vendor != capture::fastdds_vendor || !version) return std::nullopt;
  const model::SizesSince sizes = its.dds.version.sizes;
  const model::SizesSince announced =
      versions::sizes_in(static_cast<int>(version->first * 100 + version->second));
  if (announced == sizes) return std::nullopt;
  const auto first = std::ranges::find_if(conversation.events, [&](const capture::Event& event) {
    return event.source == participant.prefix && event.traffic() == capture::Traffic::spdp &&
           event.data() != nullptr;
  });
  if (first == conversation.events.end()) return std::nullopt;
  const auto event = static_cast<std::size_t>(first - conversation.events.begin());
  const auto name = [](model::SizesSince since) {
    return model::config::enum_names<model::SizesSince>[static_cast<std::size_t>(since)];
  };
  return Unexplained{
      event,
      Fault::other_version,
      {i, {}, capture::entity::spdp_writer},
      fmt::format("an announcement of Fast DDS {}", participant.version),
      fmt::format("the profile speaks of another version (dds.sizes: {})", name(sizes)),
      {{fmt::format("sizes: {}", name(announced)), {}, {}}},
      {event}};
}

}  // namespace stormproof::conform
