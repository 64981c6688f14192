// The receiver of an RTPS message, and the events that it hands out.
#include "checker/evidence/capture/message_events.hpp"

namespace stormproof::capture {

namespace {

class Receiver {
 public:
  Receiver(const Datagram& datagram, std::uint32_t index, const GuidPrefix& source,
           const std::string& place, Extraction& extraction, Remarks& remarks)
      : place_{place}, extraction_{extraction}, remarks_{remarks} {
    event_.time_ns = datagram.time_ns;
    event_.datagram = index;
    event_.source = source;
    event_.is_multicast = datagram.destination.address.is_multicast();
  }

  void receive(const Submessage& submessage) {
    if (has_writer(submessage.id) && !has_room()) return;
    switch (submessage.id) {
      case SubmessageId::info_dst:
      case SubmessageId::info_src:
        return redirect(submessage);
      case SubmessageId::data:
      case SubmessageId::data_frag:
        return data(submessage);
      case SubmessageId::heartbeat:
        return heartbeat(submessage);
      case SubmessageId::acknack:
        return acknack(submessage);
      case SubmessageId::gap:
        return gap(submessage);
      default:
        return skip(submessage);
    }
  }

 private:
  static bool has_writer(SubmessageId id) {
    return id == SubmessageId::data || id == SubmessageId::data_frag ||
           id == SubmessageId::heartbeat || id == SubmessageId::acknack || id == SubmessageId::gap;
  }

  /// Whether one more event of the present source is within the limits.
  bool has_room() {
    if (extraction_.events.size() >= extraction_.limits.events) {
      remarks_.add("submessages beyond the most that are looked at", place_);
      return false;
    }
    return has_room_for(event_.source);
  }

  bool has_room_for(const GuidPrefix& participant) {
    if (extraction_.sources.contains(participant)) return true;
    if (extraction_.sources.size() >= extraction_.limits.participants) {
      remarks_.add("submessages of participants beyond the most that are looked at", place_);
      return false;
    }
    extraction_.sources.insert(participant);
    return true;
  }

  void redirect(const Submessage& submessage) {
    const auto prefix = decode_prefix(submessage);
    if (!prefix) return malformed();
    if (submessage.id == SubmessageId::info_src) {
      event_.source = *prefix;
      return;
    }
    event_.has_info_dst = !prefix->is_unknown();
    event_.destination.reset();
    if (event_.has_info_dst) event_.destination = *prefix;
  }

  void data(const Submessage& submessage) {
    const auto data = decode_data(submessage);
    if (!data) return malformed();
    DataEvent content;
    content.sequence_number = data->sequence_number;
    content.fragment = data->fragment;
    const Traffic traffic = traffic_of(data->writer);
    if (data->fragment != 0) {
      if (traffic == Traffic::sedp) {
        remarks_.add("SEDP samples in fragments (DATA_FRAG), counted apart from DATA", place_);
      }
    } else if (traffic == Traffic::spdp) {
      content.is_gone = data->payload.empty() || data->has_key_only;
      if (!content.is_gone) describe_participant(*data, content);
    } else if (traffic == Traffic::sedp) {
      describe_endpoint(*data, submessage.order(), content);
    } else if (traffic == Traffic::type_lookup) {
      if (auto lookup = type_lookup(*data)) {
        extraction_.lookups.try_emplace({event_.source, data->writer, data->sequence_number},
                                        *std::move(lookup));
      }
    }
    add(submessage, data->reader, data->writer, content);
  }

  void describe_participant(const DataSubmessage& data, DataEvent& content) {
    auto participant = participant_data(data);
    if (!participant || !data.inline_qos_is_valid) return unreadable();
    content.participant = participant->prefix;
    // A Discovery Server tells of others, who may be in no message of their own.
    if (participant->prefix && !has_room_for(*participant->prefix)) return;
    describe(data, std::move(*participant));
  }

  void describe_endpoint(const DataSubmessage& data, ByteOrder order, DataEvent& content) {
    auto endpoint = endpoint_data(data, order);
    if (!endpoint || !data.inline_qos_is_valid) return unreadable();
    content.endpoint = endpoint->endpoint;
    content.is_gone = endpoint->is_gone;
    describe(data, std::move(*endpoint));
  }

  template <class Content>
  void describe(const DataSubmessage& data, Content content) {
    extraction_.descriptions.push_back(
        {event_.datagram, event_.source, data.writer, data.sequence_number, std::move(content)});
  }

  void heartbeat(const Submessage& submessage) {
    const auto heartbeat = decode_heartbeat(submessage);
    if (!heartbeat) return malformed();
    add(submessage, heartbeat->reader, heartbeat->writer,
        HeartbeatEvent{heartbeat->first, heartbeat->last, heartbeat->count, heartbeat->is_final,
                       heartbeat->is_liveliness});
  }

  void acknack(const Submessage& submessage) {
    const auto acknack = decode_acknack(submessage);
    if (!acknack) return malformed();
    add(submessage, acknack->reader, acknack->writer,
        AcknackEvent{acknack->missing, acknack->count, acknack->is_final});
  }

  void gap(const Submessage& submessage) {
    const auto gap = decode_gap(submessage);
    if (!gap) return malformed();
    add(submessage, gap->reader, gap->writer, GapEvent{gap->start, gap->list});
  }

  void skip(const Submessage& submessage) {
    constexpr unsigned first_secured = 0x30;
    constexpr unsigned last_secured = 0x3f;
    const auto id = static_cast<unsigned>(submessage.id);
    if (id >= first_secured && id <= last_secured) {
      remarks_.add("encrypted submessages (DDS Security), which cannot be looked into", place_);
    }
  }

  void add(const Submessage& submessage, EntityId reader, EntityId writer, auto content) {
    Event event = event_;
    event.bytes = static_cast<std::uint32_t>(submessage.size);
    event.reader = reader;
    event.writer = writer;
    event.content = std::move(content);
    extraction_.events.push_back(std::move(event));
  }

  void malformed() {
    remarks_.add("submessages that are too short or contradict themselves", place_);
  }
  void unreadable() {
    remarks_.add("SPDP or SEDP DATA whose payload is not a complete parameter list", place_);
  }

  const std::string& place_;
  Extraction& extraction_;
  Remarks& remarks_;
  Event event_;  ///< what the events of this message have in common
};

}  // namespace

std::optional<Extracted> extract(const Datagram& datagram, std::uint32_t index,
                                 const std::string& place, Extraction& extraction,
                                 Remarks& remarks) {
  const auto header = message_header(datagram.payload);
  if (!header) return std::nullopt;
  Extracted extracted{header->vendor};
  Receiver receiver{datagram, index, header->source, place, extraction, remarks};
  SubmessageReader submessages{datagram.payload};
  while (const auto submessage = submessages.next()) {
    receiver.receive(*submessage);
    const bool is_statistics =
        submessage->id == SubmessageId::statistics && header->vendor == fastdds_vendor;
    if (is_statistics) {
      extracted.statistics_bytes += static_cast<std::uint32_t>(submessage->size);
    }
  }
  if (submessages.is_cut()) remarks.add("RTPS messages that end inside a submessage", place);
  return extracted;
}

}  // namespace stormproof::capture
