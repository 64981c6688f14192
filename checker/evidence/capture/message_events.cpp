// The receiver of an RTPS message, and the events that it hands out.
#include "checker/evidence/capture/message_events.hpp"

#include "checker/evidence/capture/merge.hpp"

namespace stormproof::capture {

namespace {

class Receiver {
 public:
  Receiver(const Datagram& datagram, std::uint32_t index, const GuidPrefix& source,
           const std::string& place, Extraction& extraction, Remarks& remarks)
      : place_{place}, from_{datagram.source.address}, extraction_{extraction}, remarks_{remarks} {
    event_.time_ns = datagram.time_ns;
    event_.datagram = index;
    event_.source = source;
    event_.is_multicast = datagram.destination.address.is_multicast();
  }

  void receive(const Submessage& submessage) {
    if (has_writer(submessage.id) && !has_room_for(event_.source)) return;
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

  [[nodiscard]] const UserData& user() const { return user_; }

 private:
  static bool has_writer(SubmessageId id) {
    return id == SubmessageId::data || id == SubmessageId::data_frag ||
           id == SubmessageId::heartbeat || id == SubmessageId::acknack || id == SubmessageId::gap;
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
    if (traffic == Traffic::user) return add_user(submessage, data->fragment != 0);
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
    describe(data, Content{std::move(*participant)});
  }

  void describe_endpoint(const DataSubmessage& data, ByteOrder order, DataEvent& content) {
    auto endpoint = endpoint_data(data, order);
    if (!endpoint || !data.inline_qos_is_valid) return unreadable();
    content.endpoint = endpoint->endpoint;
    content.is_gone = endpoint->is_gone;
    describe(data, Content{std::move(*endpoint)});
  }

  void describe(const DataSubmessage& data, Content content) {
    const std::uint32_t number = extraction_.contents.number_of(data.payload, std::move(content));
    extraction_.descriptions.push_back(
        {event_.datagram, number, event_.source, data.writer, data.sequence_number});
  }

  void add_user(const Submessage& submessage, bool is_fragment) {
    ++user_.data;
    if (is_fragment) ++user_.fragments;
    user_.bytes += static_cast<std::uint32_t>(submessage.size);
    const std::pair only{event_.datagram, event_.datagram};
    extraction_.user_sources.try_emplace({event_.source, from_}, only).first->second.second =
        event_.datagram;
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
  const Address& from_;
  Extraction& extraction_;
  Remarks& remarks_;
  Event event_;  ///< what the events of this message have in common
  UserData user_;
};

}  // namespace

std::uint32_t Contents::number_of(Bytes payload, Content content) {
  const std::uint64_t digest = digest_of(payload);
  const auto [first, last] = by_digest_.equal_range(digest);
  for (auto known = first; known != last; ++known) {
    if (all_[known->second] == content) return known->second;
  }
  const auto number = static_cast<std::uint32_t>(all_.size());
  all_.push_back(std::move(content));
  by_digest_.emplace(digest, number);
  return number;
}

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
  extracted.user = receiver.user();
  if (submessages.is_cut()) remarks.add("RTPS messages that end inside a submessage", place);
  return extracted;
}

}  // namespace stormproof::capture
