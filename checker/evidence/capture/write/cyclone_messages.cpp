// From submessages of the model to those of RTPS.
#include "checker/evidence/capture/write/cyclone_messages.hpp"

#include <algorithm>

#include "checker/evidence/capture/write/descriptions.hpp"
#include "model/cyclone/endpoints.hpp"

namespace stormproof::capture::write {

namespace {

namespace cyclone = model::cyclone;
using model::Stream;
using model::Submessage;

constexpr std::uint32_t bits_per_word = 32;
constexpr std::uint16_t user_group_port = 7401;

/// Of the writers of a participant, in their order.
Ends ends_of(std::uint32_t writer) {
  // Type lookup: RTPS has no others of these ids.
  constexpr Ends requests{0x000300c3, 0x000300c4};
  constexpr Ends replies{0x000301c3, 0x000301c4};
  if (writer == cyclone::writer::publications) {
    return {sedp_writer(Stream::pub), sedp_reader(Stream::pub)};
  }
  if (writer == cyclone::writer::subscriptions) {
    return {sedp_writer(Stream::sub), sedp_reader(Stream::sub)};
  }
  if (writer == cyclone::writer::liveliness) {
    return {capture::entity::liveliness_writer, entity::liveliness_reader};
  }
  if (writer < cyclone::writer::first_topic) {
    return writer == cyclone::writer::liveliness + 1 ? requests : replies;
  }
  return {endpoint_entity(Stream::pub, cyclone::descriptor_of(writer, Stream::pub)),
          endpoint_entity(Stream::sub, cyclone::descriptor_of(writer, Stream::sub))};
}

std::uint32_t words_of(const SequenceNumberSet& missing) {
  return (missing.num_bits + bits_per_word - 1) / bits_per_word;
}

SequenceNumberSet missing_in(const Submessage& acknack) {
  SequenceNumberSet missing;
  missing.base = std::int64_t{acknack.sample} + 1;
  acknack.bitmap.for_each([&](std::uint32_t d) { ask(missing, d); });
  return missing;
}

}  // namespace

std::int64_t CycloneMessages::bytes_of(const Submessage& m) const {
  switch (m.kind) {
    case Submessage::Kind::spdp:
      return dds_of(scenario_, m.participant).allow_multicast == model::AllowMulticast::always
                 ? cyclone::announcement_with_multicast_bytes
                 : cyclone::announcement_bytes;
    case Submessage::Kind::data:
      return cyclone::data_bytes(m.writer, m.sample);
    case Submessage::Kind::heartbeat:
      return cyclone::heartbeat_bytes;
    case Submessage::Kind::gap:
      return cyclone::gap_bytes;
    case Submessage::Kind::acknack:
      break;
  }
  return cyclone::acknack_bytes + cyclone::bitmap_word_bytes * words_of(missing_in(m));
}

auto CycloneMessages::datagram(const model::Packet& packet, std::uint32_t source,
                               std::optional<std::uint32_t> destination, std::int64_t time_ns) const
    -> Datagram {
  const std::vector<Submessage>& contents = *packet.submessages;
  // A packet is larger than its parts if it names its destination, and if the bitmap of an ACKNACK,
  // which always does, goes on behind the last sample that it asks for.
  std::int64_t more = std::int64_t{packet.payload_bytes} - cyclone::header_bytes;
  for (const Submessage& m : contents) more -= bytes_of(m);
  const bool is_directed = destination && more >= cyclone::destination_bytes;
  MessageWriter out{vendor_, identities_[source].prefix};
  if (is_directed) {
    out.info_dst(identities_[*destination].prefix);
    more -= cyclone::destination_bytes;
  }
  auto more_words =
      static_cast<std::uint32_t>(std::max<std::int64_t>(more, 0) / cyclone::bitmap_word_bytes);
  for (const Submessage& m : contents) {
    const bool takes_them = m.kind == Submessage::Kind::acknack && !m.bitmap.empty();
    add(out, m, source, is_directed, time_ns, takes_them ? more_words : 0);
    if (takes_them) more_words = 0;
  }
  out.fill(packet.payload_bytes);
  const bool of_user = contents.front().kind != Submessage::Kind::spdp &&
                       contents.front().writer >= cyclone::writer::first_topic;
  UdpEnd to = discovery_group();
  if (destination) {
    const Identity& receiver = identities_[*destination];
    to = of_user ? receiver.user : receiver.metatraffic;
  } else if (of_user) {
    to.port = user_group_port;
  }
  return {to, out.buffer()};
}

void CycloneMessages::add(MessageWriter& out, const Submessage& m, std::uint32_t source,
                          bool is_directed, std::int64_t time_ns, std::uint32_t more_words) const {
  if (m.kind == Submessage::Kind::spdp || m.kind == Submessage::Kind::data) {
    out.info_ts(time_ns);
    return add_sample(out, m, source, is_directed);
  }
  const Ends ends = ends_of(m.writer);
  const auto count = static_cast<std::uint32_t>(m.count);
  if (m.kind == Submessage::Kind::heartbeat) {
    out.heartbeat(is_directed ? ends.reader : 0, ends.writer, m.sample, count);
    return;
  }
  if (m.kind == Submessage::Kind::gap) {
    std::vector<std::int64_t> numbers;
    m.bitmap.for_each([&](std::uint32_t d) { numbers.push_back(std::int64_t{d} + 1); });
    return out.gap(ends.reader, ends.writer, numbers);
  }
  SequenceNumberSet missing = missing_in(m);
  if (more_words > 0) {
    const std::uint32_t bits = (words_of(missing) + more_words - 1) * bits_per_word + 1;
    missing.num_bits = std::min(bits, SequenceNumberSet::most_bits);
  }
  out.acknack(ends.reader, ends.writer, missing, count, missing.num_bits == 0 && !m.initial);
}

void CycloneMessages::add_sample(MessageWriter& out, const Submessage& m, std::uint32_t source,
                                 bool is_directed) const {
  const auto bytes = static_cast<std::size_t>(bytes_of(m)) - MessageWriter::info_ts_size;
  if (m.kind == Submessage::Kind::spdp) {
    out.data(is_directed ? capture::entity::spdp_reader : 0, capture::entity::spdp_writer, 1,
             participant_parameters(identities_[source], vendor_), bytes);
    return;
  }
  const Ends ends = ends_of(m.writer);
  const EntityId reader = is_directed ? ends.reader : 0;
  if (m.writer > cyclone::writer::subscriptions) {
    return out.data(reader, ends.writer, m.sample + std::uint64_t{1}, ParameterWriter{}, bytes);
  }
  const Stream stream = m.writer == cyclone::writer::publications ? Stream::pub : Stream::sub;
  const model::DescriptorProfile& descriptors = scenario_.dds.descriptors;
  const TopicName name = topic_name(
      stream, m.sample,
      stream == Stream::pub ? descriptors.default_publications : descriptors.default_subscriptions,
      identities_[source].name);
  out.data(reader, ends.writer, m.sample + std::uint64_t{1},
           short_endpoint_parameters(identities_[source], stream, m.sample, name), bytes);
}

}  // namespace stormproof::capture::write
