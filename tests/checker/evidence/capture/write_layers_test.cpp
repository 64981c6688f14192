// The layers of the writer: what MessageWriter and PcapWriter make is what the readers of captures
// understand, at every size.
#include <gtest/gtest.h>

#include "checker/evidence/capture/discovery_data.hpp"
#include "checker/evidence/capture/write/descriptions.hpp"
#include "checker/evidence/capture/write/message_writer.hpp"
#include "checker/evidence/capture/write/pcap_writer.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture::testing {
namespace write_layers_test {

Buffer frames_of(const std::vector<Buffer>& payloads, std::int64_t time_ns = 5'000'000'007) {
  Buffer file;
  write::PcapWriter pcap{
      [&file](Bytes bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); }};
  for (const Buffer& payload : payloads) pcap.datagram(time_ns, at(1, 7410), at(2, 7412), payload);
  return file;
}

write::MessageWriter message() { return write::MessageWriter{fastdds_vendor, prefix(1)}; }

TEST(WriteLayers, AMessageFillsUpToEverySize) {
  for (std::size_t size = 0; size < 90; ++size) {
    write::MessageWriter out = message();
    out.info_dst(prefix(2));
    out.heartbeat(entity::publications_reader, entity::publications_writer, 7, 3);
    out.fill(size);
    EXPECT_EQ(out.size(), std::max<std::size_t>(size, 68));
    SubmessageReader reader{out.buffer()};
    EXPECT_EQ(decode_prefix(*reader.next()), prefix(2));
    const auto heartbeat = decode_heartbeat(*reader.next());
    ASSERT_TRUE(heartbeat);
    EXPECT_EQ(heartbeat->last, 7);
    EXPECT_EQ(heartbeat->count, 3U);
    const auto padding = reader.next();
    EXPECT_EQ(padding.has_value(), size >= 72) << size;
    EXPECT_TRUE(!padding || padding->id == SubmessageId::pad);
    EXPECT_FALSE(reader.is_cut());
    EXPECT_FALSE(reader.next());
  }
}

TEST(WriteLayers, DataIsPaddedInsideItsParameterList) {
  model::Deployment deployment = model::Deployment::homogeneous(2, 1, 2);
  const write::Identity source = write::identities(deployment, fastdds_vendor).front();
  const auto parameters = write::endpoint_parameters(source, fastdds_vendor, model::Stream::sub, 8,
                                                     {"rt/topic", "type"});
  const std::size_t least = write::smallest_data(parameters);
  for (const std::size_t more : {0U, 3U, 4U, 7U, 8U, 40'000U}) {
    write::MessageWriter out = message();
    out.data(entity::subscriptions_reader, entity::subscriptions_writer, 9, parameters,
             least + more);
    EXPECT_EQ(out.size(), 20 + least + more / 4 * 4);
    SubmessageReader reader{out.buffer()};
    const auto submessage = reader.next();
    ASSERT_TRUE(submessage);
    const auto data = decode_data(*submessage);
    ASSERT_TRUE(data);
    EXPECT_EQ(data->sequence_number, 9);
    const auto endpoint = endpoint_data(*data, submessage->order());
    ASSERT_TRUE(endpoint);
    EXPECT_EQ(endpoint->topic, "rt/topic");
    EXPECT_EQ(endpoint->endpoint->entity, 0x00000904U);
  }
}

TEST(WriteLayers, DatagramsAreFragmentedAtTheMtu) {
  struct Case {
    std::size_t payload;
    std::uint32_t frames;
  };
  for (const auto& [payload, frames] : {Case{52, 1}, Case{1472, 1}, Case{1473, 2}, Case{2952, 2},
                                        Case{2953, 3}, Case{65'507, 45}}) {
    write::MessageWriter out = message();
    out.heartbeat(0, entity::publications_writer, 7, 3);
    out.fill(payload);
    const Conversation read =
        conversation_of(std::vector<Buffer>{frames_of({out.buffer(), out.buffer()})});
    EXPECT_TRUE(read.remarks.empty());
    ASSERT_EQ(read.datagrams.size(), 2U);
    EXPECT_EQ(read.datagrams[1].payload_bytes, payload);
    EXPECT_EQ(read.datagrams[1].frames, frames);
    EXPECT_EQ(read.datagrams[1].time_ns, 5'000'000'007);
    EXPECT_EQ(read.datagrams[1].destination, at(2, 7412));
    EXPECT_EQ(read.captures.front().packets, 2 * frames);
    EXPECT_EQ(read.events.size(), 2U);
  }
}

TEST(WriteLayers, IpHeadersHaveTheirChecksum) {
  const Buffer file = frames_of({message().buffer()});
  constexpr std::size_t ip_header = 24 + 16 + 14;
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < 20; k += 2) {
    sum += static_cast<std::uint32_t>(file[ip_header + k] << 8U | file[ip_header + k + 1]);
  }
  EXPECT_EQ((sum & 0xffffU) + (sum >> 16U), 0xffffU);
}

}  // namespace write_layers_test
}  // namespace stormproof::capture::testing
