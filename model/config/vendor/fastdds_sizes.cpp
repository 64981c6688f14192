// The two sizes by which transports act on SEDP in Fast DDS (v2.6.11): the piggyback threshold of
// every writer is the least send buffer of all registered transports (NetworkFactory.cpp:130-147,
// StatefulWriter.cpp:193-194), and an RTPS message is at most as large as the least of their limits
// and of a property (RTPSParticipantImpl.cpp:443-457).
#include <algorithm>

#include <fmt/core.h>

#include "model/config/vendor/fastdds_discovery.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::model::config::vendor::fastdds {
namespace {

/// Linux: the default send buffer of 212,992 bytes, of which the library reads half.
constexpr std::int64_t default_threshold = 106'496;
constexpr std::int64_t default_wmem_max = 212'992;
constexpr std::int64_t default_segment = 524'288;  ///< of shared memory
constexpr std::int64_t largest_message = 65'500;   ///< TransportInterface.h:33
constexpr std::int64_t largest_buffer = 2'147'483'647;

/// With the sizes of the version.
DdsProfile profile_of(Version version) {
  DdsProfile dds;
  dds.version.sizes = sizes_in(version);
  return dds;
}
/// A packet with the largest descriptor of a ROS 2 node, for one receiver.
std::int64_t largest_descriptor_packet(const DdsProfile& dds) {
  return model::fastdds::message_header_bytes + model::fastdds::destination_bytes +
         model::fastdds::timestamp_bytes + model::fastdds::largest_submessage_bytes(dds);
}

/// A number of bytes that one setting or default contributes; the least one counts.
struct Contribution {
  std::int64_t bytes = 0;
  const Found* source = nullptr;  ///< null: a default
  std::string owner;              ///< "transport 'UDP1'"
};

/// The sizes that one transport registers with, or that make it fail.
void check_sizes(Reading& reading, const Found* buffer, std::int64_t message,
                 std::string_view owner) {
  if (buffer == nullptr || buffer->value.number == 0) return;
  if (buffer->value.number < message) {
    add_remark(reading.profile, Severity::error, "fastdds.buffer-below-message",
               buffer->value.place,
               fmt::format("<{}> of {} is {} bytes, less than a message of {} bytes may have; the "
                           "library does not register the transport",
                           buffer->item->name(), owner, buffer->value.number, message));
  } else if (buffer->value.number > largest_buffer) {
    add_remark(reading.profile, Severity::error, "fastdds.buffer-size", buffer->value.place,
               fmt::format("<{}> of {} is {} bytes; the library does not register a transport "
                           "with more than {}",
                           buffer->item->name(), owner, buffer->value.number, largest_buffer));
  }
}

void check_transport_sizes(Reading& reading, const Transport& transport) {
  const std::string owner = fmt::format("transport {}", quote(transport.id));
  const Found* message = transport.section.find("maxMessageSize");
  const std::int64_t largest = message == nullptr ? largest_message : message->value.number;
  const bool is_shm = transport.type == "SHM";
  const Found* segment = transport.section.find("segment_size");
  if (is_shm && (segment == nullptr || segment->value.number == 0) && largest > default_segment) {
    add_remark(reading.profile, Severity::error, "fastdds.message-size", message->value.place,
               fmt::format("<maxMessageSize> of {} is {} bytes; the library does not register a "
                           "transport with more than its segment of {}",
                           owner, largest, default_segment));
  }
  if (!is_shm && largest > largest_message) {
    add_remark(reading.profile, Severity::error, "fastdds.message-size", message->value.place,
               fmt::format("<maxMessageSize> of {} is {} bytes; the library does not register a "
                           "transport with more than {}",
                           owner, largest, largest_message));
  }
  for (const std::string_view name : {"sendBufferSize", "receiveBufferSize", "segment_size"}) {
    check_sizes(reading, transport.section.find(name), largest, owner);
  }
}

/// The settings that compete, with the default first where there is one.
std::vector<Contribution> send_buffers(Reading& reading, bool builtin_udp) {
  std::vector<Contribution> all;
  const auto contribute = [&](const Found* found, std::int64_t otherwise, std::string owner) {
    const bool is_set = found != nullptr && found->value.number != 0;
    all.push_back(
        {is_set ? found->value.number : otherwise, is_set ? found : nullptr, std::move(owner)});
  };
  if (builtin_udp) {
    contribute(reading.section.find("rtps/sendSocketBufferSize"), default_threshold,
               "the builtin UDP transport");
  }
  for (const Transport& transport : reading.transports) {
    if (!transport.is_used) continue;
    const std::string owner = fmt::format("transport {}", quote(transport.id));
    if (transport.type == "SHM") {
      contribute(transport.section.find("segment_size"), default_segment, owner);
    } else if (is_udp(transport)) {
      contribute(transport.section.find("sendBufferSize"), default_threshold, owner);
    } else if (const Found* size = transport.section.find("sendBufferSize")) {
      if (size->value.number != 0) all.push_back({size->value.number, size, owner});
    }
  }
  return all;
}

/// Sets the knob from the least contribution, and says of the others that they do nothing.
void set_least(Reading& reading, const std::vector<Contribution>& all, std::string_view key,
               std::string_view rule, std::string_view meaning) {
  if (all.empty()) return;
  const auto least = std::ranges::min_element(all, [](const auto& a, const auto& b) {
    return std::pair{a.bytes, a.source == nullptr} < std::pair{b.bytes, b.source == nullptr};
  });
  for (const Contribution& one : all) {
    if (one.source == nullptr) continue;
    if (one.source == least->source) {
      set_knob(reading, *one.source, "sedp", key, std::to_string(one.bytes));
      reading.setting_of(*one.source).note = meaning;
    } else if (one.bytes == least->bytes) {
      set_inert(reading, *one.source, fmt::format("{} has as much", least->owner));
    } else {
      set_inert(reading, *one.source,
                fmt::format("{} has {} bytes, and the least counts", least->owner, least->bytes));
      if (one.source->item->name() == "segment_size") continue;  // it holds user data, too
      add_remark(reading.profile, Severity::warning, std::string{rule}, one.source->value.place,
                 fmt::format("{} bytes for {} change nothing: {} has {} bytes, and the least of "
                             "all transports in use counts",
                             one.bytes, one.owner, least->owner, least->bytes),
                 least->owner.starts_with("the builtin") && one.owner.starts_with("transport")
                     ? "to use your transport alone, set "
                       "<useBuiltinTransports>false</useBuiltinTransports>"
                     : "");
    }
  }
}

void interpret_threshold(Reading& reading, bool builtin_udp) {
  const Found* participant = reading.section.find("rtps/sendSocketBufferSize");
  if (participant != nullptr && !builtin_udp) {
    set_inert(reading, *participant, "acts on builtin transports only, and none is in use");
    add_remark(reading.profile, Severity::warning, "fastdds.participant-send-buffer",
               participant->value.place,
               "<sendSocketBufferSize> does nothing: it acts on builtin transports only, and none "
               "is in use",
               "set <sendBufferSize> in the transport descriptor");
  }
  if (builtin_udp) {
    for (const std::string_view name : {"sendSocketBufferSize", "listenSocketBufferSize"}) {
      check_sizes(reading, reading.section.find("rtps/" + std::string{name}), largest_message,
                  "the builtin UDP transport");
    }
  }
  const std::vector<Contribution> all = send_buffers(reading, builtin_udp);
  set_least(
      reading, all, "piggyback_threshold_bytes", "fastdds.send-buffer-not-least",
      "bytes that a writer may send without a HEARTBEAT; Linux has to allow them "
      "(net.core.wmem_max), and the queue of the socket itself is wireless.source_queue_bytes");
  for (const Contribution& one : all) {
    if (one.source == nullptr || one.bytes <= default_wmem_max || one.bytes > largest_buffer ||
        reading.setting_of(*one.source).effect != Effect::knob ||
        one.source->item->name() == "segment_size") {
      continue;
    }
    add_remark(reading.profile, Severity::note, "fastdds.wmem-max", one.source->value.place,
               fmt::format("Linux cuts a send buffer of {} bytes to net.core.wmem_max, {} bytes "
                           "unless it is raised",
                           one.bytes, default_wmem_max),
               fmt::format("sysctl -w net.core.wmem_max={}", one.bytes));
  }
}

/// The participant's property as a contribution, unless it says nothing.
void add_property(Reading& reading, std::vector<Contribution>& all) {
  const Found* property = reading.section.find("fastdds.max_message_size");
  if (property == nullptr) return;
  const auto number = leading_number(property->value.shown);
  const auto ignored = [&](std::string why) {
    set_inert(reading, *property, why);
    add_remark(reading.profile, Severity::warning, "fastdds.max-message-size",
               property->value.place,
               fmt::format("fastdds.max_message_size = {} does nothing: {}",
                           quote(property->value.shown), why),
               "give a number of bytes up to 65500");
  };
  if (!number) return ignored("the library cannot read it as a number and ignores it");
  if (number->number < 0 || number->number > largest_message) {
    return ignored(fmt::format("no message exceeds {} bytes anyway", largest_message));
  }
  if (!number->rest.empty()) {
    add_remark(reading.profile, Severity::warning, "fastdds.number-tail", property->value.place,
               fmt::format("{} is read as {}: what follows the digits is ignored",
                           quote(property->value.shown), number->number),
               "write a whole number without a unit");
  }
  all.push_back({number->number, property, "the property"});
}

void interpret_message_size(Reading& reading) {
  std::vector<Contribution> all;
  add_property(reading, all);
  for (const Transport& transport : reading.transports) {
    const Found* size = transport.section.find("maxMessageSize");
    if (!transport.is_used || size == nullptr || size->value.number > largest_message) continue;
    all.push_back({size->value.number, size, fmt::format("transport {}", quote(transport.id))});
  }
  if (all.empty()) return;
  const Contribution& least = *std::ranges::min_element(all, {}, &Contribution::bytes);
  const DdsProfile dds = profile_of(reading.version);
  const std::int64_t announcement = model::fastdds::sizes_of(dds).announcement;
  if (least.bytes < announcement) {
    return set_outside(
        reading, *least.source,
        fmt::format("an announcement has {} bytes and does not fit in a message", announcement));
  }
  set_least(reading, all, "grouping_limit_bytes", "fastdds.message-size-not-least",
            "largest RTPS message, that is, UDP payload");
  if (least.bytes < largest_descriptor_packet(dds)) {
    add_remark(reading.profile, Severity::warning, "fastdds.small-message",
               least.source->value.place,
               fmt::format("messages of {} bytes do not hold the largest descriptor of a ROS 2 "
                           "node ({} bytes with headers); the library sends it in fragments "
                           "(DATA_FRAG), the model in one larger packet",
                           least.bytes, largest_descriptor_packet(dds)));
  }
}

}  // namespace

void interpret_sizes(Reading& reading, bool builtin_udp) {
  for (const Transport& transport : reading.transports) {
    if (transport.is_used) check_transport_sizes(reading, transport);
  }
  interpret_threshold(reading, builtin_udp);
  interpret_message_size(reading);
}

}  // namespace stormproof::model::config::vendor::fastdds
