// The check of the required keys does not look at every writer, destination and number one by one;
// here is one that does, for comparison, and what hostile captures would cost it.
#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "checker/evidence/capture/counting.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture {

namespace required_keys_test {

using namespace testing;

constexpr std::int64_t always = std::numeric_limits<std::int64_t>::max();
constexpr EntityId pub = entity::publications_writer;
constexpr std::int64_t most_numbers = 40;  // more than the random captures have

struct Keys {
  std::set<MissingKey> required{};
  std::set<MissingKey> missing{};
  std::optional<std::int64_t> last_initial_ns{};
};

/// Whether a GAP of the writer takes the number back.
bool is_taken_back(const Conversation& conversation, const GuidPrefix& source,
                   std::int64_t number) {
  return std::ranges::any_of(conversation.events, [&](const Event& event) {
    const GapEvent* gap = event.gap();
    if (gap == nullptr || event.source != source || number < gap->start) return false;
    const std::int64_t index = number - gap->list.base;
    return index < 0 || (index < 256 && gap->list.has(static_cast<std::uint32_t>(index)));
  });
}

/// Numbers of a writer that have to be sent to everybody: of the latest description of each
/// endpoint, and those that only the last HEARTBEAT mentions.
std::set<std::int64_t> required_numbers(const Conversation& conversation,
                                        const GuidPrefix& source) {
  std::map<Guid, std::int64_t> latest;
  std::set<std::int64_t> seen;
  std::int64_t first = 1;
  std::int64_t last = 0;
  for (const Event& event : conversation.events) {
    if (event.source != source || event.writer != pub) continue;
    if (const DataEvent* data = event.data()) {
      seen.insert(data->sequence_number);
      auto& number = latest[*data->endpoint];
      number = std::max(number, data->sequence_number);
    } else if (const HeartbeatEvent* heartbeat = event.heartbeat()) {
      first = heartbeat->first;
      last = heartbeat->last;
    }
  }
  std::set<std::int64_t> numbers;
  for (const auto& [endpoint, number] : latest) numbers.insert(number);
  for (std::int64_t k = first; k <= last; ++k) {
    if (!seen.contains(k) && !is_taken_back(conversation, source, k)) numbers.insert(k);
  }
  return numbers;
}

Keys keys_of(const Conversation& conversation) {
  Keys keys;
  for (const Participant& source : conversation.topology.participants) {
    for (const Participant& destination : conversation.topology.participants) {
      const bool is_one_host = conversation.topology.hosts == 1;
      if (is_one_host ? source.prefix == destination.prefix : source.host == destination.host) {
        continue;
      }
      for (const std::int64_t number : required_numbers(conversation, source.prefix)) {
        const MissingKey key{source.prefix, destination.prefix, pub, number};
        keys.required.insert(key);
        const auto sent = std::ranges::find_if(conversation.events, [&](const Event& event) {
          return event.source == source.prefix && event.writer == pub && event.data() != nullptr &&
                 event.data()->sequence_number == number &&
                 event.destination.value_or(destination.prefix) == destination.prefix;
        });
        if (sent == conversation.events.end()) {
          keys.missing.insert(key);
        } else {
          keys.last_initial_ns = std::max(keys.last_initial_ns.value_or(0), sent->time_ns);
        }
      }
    }
  }
  if (!keys.missing.empty()) keys.last_initial_ns.reset();
  return keys;
}

/// DATA, HEARTBEATs and GAPs of three participants on two hosts, to one or to all of the others.
Conversation random_conversation(std::mt19937& random) {
  const auto below = [&random](std::uint32_t end) {
    return static_cast<std::uint32_t>(random() % end);
  };
  PcapFile file;
  const std::uint32_t numbers = 1 + below(4);
  const std::uint32_t messages = below(60);
  for (std::uint32_t k = 0; k < messages; ++k) {
    const auto source = static_cast<std::uint8_t>(1 + below(3));
    const auto destination = static_cast<std::uint8_t>(1 + below(3));
    Message message{prefix(source)};
    Route route{at(source == 3 ? 1 : source, 7410), at(9, 7410), k};
    if (below(3) == 0) {
      route.destination = multicast();
    } else {
      message.to(prefix(destination));
    }
    const std::uint32_t number = 1 + below(numbers);
    const std::uint32_t kind = below(12);
    if (kind == 0) {
      message.heartbeat(pub, 1 + below(3), 1 + below(numbers + 2), k);
    } else if (kind == 1) {
      Writer body{ByteOrder::little};
      body.entity(pub + 5).entity(pub).sequence_number(number).sequence_number(1 + below(6));
      message.submessage(0x08, 0, body.u32(32).u32(random()).buffer());
    } else {
      message.descriptor(pub, number);
    }
    file.message(k, route, message);
  }
  file.message(100, {at(1, 7410), multicast()}, Message{prefix(1)}.announcement({at(1, 7410)}));
  return conversation_of({file.buffer()});
}

TEST(RequiredKeysOneByOne, AreTheSame) {
  std::mt19937 random{2022};
  std::size_t complete = 0;
  std::size_t incomplete = 0;
  for (int round = 0; round < 3'000; ++round) {
    const Conversation conversation = random_conversation(random);
    const Keys keys = keys_of(conversation);
    const Counting counting = count(conversation, always);
    ASSERT_LT(keys.required.size(), most_numbers);
    ASSERT_EQ(counting.required, keys.required.size()) << round;
    ASSERT_EQ(std::set(counting.missing.begin(), counting.missing.end()), keys.missing) << round;
    ASSERT_EQ(counting.missing_count, keys.missing.size()) << round;
    ASSERT_EQ(counting.last_initial_ns, keys.last_initial_ns) << round;
    if (keys.last_initial_ns) ++complete;
    if (!keys.missing.empty()) ++incomplete;
  }
  EXPECT_GT(complete, 100U);
  EXPECT_GT(incomplete, 100U);
}

TEST(RequiredKeysOneByOne, ManyGapsAndSourcesAreNotLookedAtForEveryNumber) {
  PcapFile file;
  const Route route{at(1, 7410), at(2, 7410)};
  file.message(0, {at(2, 7410), multicast()}, Message{prefix(2)}.announcement({at(2, 7410)}));
  file.message(1, route, Message{prefix(1)}.to(prefix(2)).heartbeat(pub, 1, 65'536, 1));
  Message gaps{prefix(1)};
  gaps.to(prefix(2));
  for (std::int64_t k = 0; k < 1'500; ++k) gaps.gap(pub, 10, 60'000 + k);
  for (int copies = 0; copies < 40; ++copies) file.message(2, route, gaps);
  // 9 numbers before the GAPs, and what is behind the farthest of them.
  EXPECT_EQ(count(conversation_of({file.buffer()}), always).missing_count, 9U + 65'536U - 61'498U);
  Message sources{prefix(1)};
  for (int k = 0; k < 1'000; ++k) {
    GuidPrefix source = prefix(static_cast<std::uint8_t>(k));
    source.bytes[0] = static_cast<std::uint8_t>(10 + k / 256);
    sources.from(source).heartbeat(pub, 1, 65'536, 1);
  }
  file.message(3, route, sources);
  const Counting counting = count(conversation_of({file.buffer()}), always);
  EXPECT_GT(counting.missing_count, 65'536'000U);
  EXPECT_EQ(counting.missing.size(), most_missing_listed);
}

}  // namespace required_keys_test
}  // namespace stormproof::capture
