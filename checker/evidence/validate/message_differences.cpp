// What is sent that the model does not send: other destinations, submessages, sizes and reasons.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "checker/evidence/validate/difference_finder.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::validate {

using capture::Event;
using capture::Traffic;
using model::MessageClass;
using report::grouped;

namespace {

std::uint32_t usual_size(const std::map<std::uint32_t, std::uint64_t>& sizes) {
  const auto usual =
      std::ranges::max_element(sizes, {}, [](const auto& one) { return one.second; });
  return usual == sizes.end() ? 0 : usual->first;
}

}  // namespace

void Finder::destinations() {
  const std::uint64_t same_host = counting_.same_host.total();
  add("same-host", same_host,
      fmt::format("{} messages go to a participant on the sender's own host over this link; the "
                  "model's stay on the host",
                  grouped(same_host)));
  const bool has_multicast =
      mixes_submessages() && scenario_.dds.allow_multicast == model::AllowMulticast::always;
  add("multicast-sedp", has_multicast ? 0 : counting_.multicast_data,
      fmt::format("{} SEDP DATA go by multicast to all at once; the model sends a copy to each",
                  grouped(counting_.multicast_data)));
  add("unknown-destination", counting_.unknown_destination,
      fmt::format("{} messages go to an address that nobody announced",
                  grouped(counting_.unknown_destination)));
}

void Finder::submessages() {
  const auto of = [this](Traffic traffic) -> const capture::TrafficFigures& {
    return counting_.traffic[static_cast<std::size_t>(traffic)];
  };
  std::uint64_t gaps = 0;
  std::uint64_t fragments = 0;
  for (const capture::TrafficFigures& figures : counting_.traffic) {
    gaps += figures.gap;
    fragments += figures.data_frag;
  }
  add("gap", traits().has_server ? 0 : gaps,
      fmt::format("{} GAPs; the model never takes descriptors back", grouped(gaps)));
  add("data-frag", fragments,
      fmt::format("{} DATA_FRAG; the model's descriptors fit into DATA", grouped(fragments)));
  const auto data = [&](Traffic traffic, const char* id, const char* what) {
    add(id, of(traffic).data,
        fmt::format("{} DATA of {}, which take channel time; the model has none",
                    grouped(of(traffic).data), what));
  };
  data(Traffic::user, "user-data", "user endpoints");
  if (mixes_submessages()) return;  // it has those of all built-in endpoints
  data(Traffic::liveliness, "liveliness-data", "liveliness");
  if (!scenario_.deployment.types) {
    data(Traffic::type_lookup, "lookups", "questions about types and answers");
  }
  const capture::TrafficFigures& builtin = of(Traffic::other_builtin);
  const std::uint64_t messages = builtin.data + builtin.heartbeat + builtin.acknack + builtin.gap;
  add("other-builtin", messages,
      fmt::format("{} submessages of other built-in endpoints ({} bytes); the model has none",
                  grouped(messages), grouped(builtin.bytes)));
  if (traits().has_control_relations) return;
  const std::uint64_t control = of(Traffic::user).heartbeat + of(Traffic::user).acknack +
                                of(Traffic::liveliness).heartbeat + of(Traffic::liveliness).acknack;
  add("control", control,
      fmt::format("{} HEARTBEATs and ACKNACKs of user endpoints and liveliness; with this profile "
                  "the model has none",
                  grouped(control)));
}

/// What a datagram of HEARTBEATs and ACKNACKs holds beside them, the RTPS header and INFO_DST: such
/// datagrams need nothing else.
void Finder::other_bytes() {
  constexpr std::uint32_t header = 20;
  constexpr std::uint32_t info_dst = 16;
  std::map<std::uint32_t, std::uint64_t> rest;  // bytes → datagrams
  std::uint64_t all = 0;
  for (std::size_t k = 0; k < counting_.classes.size();) {
    const std::uint32_t datagram = conversation_.events[k].datagram;
    std::uint32_t known = header;
    bool has_data = false;
    bool has_destination = false;
    for (; k < counting_.classes.size() && conversation_.events[k].datagram == datagram; ++k) {
      const Event& event = conversation_.events[k];
      known += event.bytes;
      has_data = has_data || event.data() != nullptr || event.gap() != nullptr;
      has_destination = has_destination || event.has_info_dst;
    }
    if (has_data) continue;
    known += has_destination ? info_dst : 0;
    const std::uint32_t payload = conversation_.datagrams[datagram].payload_bytes;
    ++rest[payload > known ? payload - known : 0];
    ++all;
  }
  const auto usual = std::ranges::max_element(rest, {}, [](const auto& one) { return one.second; });
  if (usual == rest.end() || usual->first == 0) return;
  add("other-submessages", usual->second,
      fmt::format("{} of {} datagrams with HEARTBEATs or ACKNACKs alone hold {} bytes of other "
                  "submessages (of the vendor); the model's hold none",
                  grouped(usual->second), grouped(all), usual->first));
}

/// Sizes of datagrams with one message of a class that the model never has.
void Finder::sizes_of_messages() {
  for (std::size_t k = 0; k < model::message_class_count; ++k) {
    if (sizes_[k].empty()) continue;
    std::map<std::uint32_t, std::uint64_t> unknown;
    std::uint64_t others = 0;
    std::uint64_t all = 0;
    for (const auto& [size, count] : counting_.sizes[k].single) {
      all += count;
      if (sizes_[k].contains(size)) continue;
      others += count;
      unknown[size] += count;
    }
    add("size", others,
        fmt::format(
            "{} of {} datagrams with one {} have a UDP payload that the model's never have, "
            "most often {} bytes; the model's have {}",
            grouped(others), grouped(all), words_of(static_cast<MessageClass>(k)),
            grouped(usual_size(unknown)), grouped(usual_size(sizes_[k]))));
  }
}

void Finder::heartbeat_kinds() {
  using capture::HeartbeatKind;
  if (mixes_submessages() || traits().has_server) return;  // its HEARTBEATs are not told apart
  const auto kind = [&](HeartbeatKind one, const char* id, const char* what) {
    const std::uint64_t count = counting_.heartbeats.of(one);
    add(id, count, fmt::format("{} HEARTBEATs {}", grouped(count), what));
  };
  kind(HeartbeatKind::directed, "heartbeat-directed",
       "go to one reader for a reason that the capture does not show; they are in no kind of the "
       "model");
  kind(HeartbeatKind::fan_out, "heartbeat-fan-out",
       "go to all readers of a vendor whose timer is not known; they are in no kind of the model");
  const std::uint64_t empty = counting_.heartbeats.empty;
  add("heartbeat-empty", empty, fmt::format("{} HEARTBEATs announce nothing yet", grouped(empty)));
}

}  // namespace stormproof::validate
