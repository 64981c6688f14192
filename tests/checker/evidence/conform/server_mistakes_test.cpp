// Each rule of a Discovery Server and of its clients has a message that breaks it: a run that
// conforms is changed in one place, and the mistake is noticed.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/checker/evidence/conform/captures.hpp"
#include "tests/checker/evidence/conform/fault_cases.hpp"

namespace stormproof::conform::testing {
namespace server_mistakes_test {

constexpr std::int64_t ms = 1'000'000;
constexpr capture::EntityId announcements = capture::entity::spdp_writer;
constexpr capture::EntityId publications = capture::entity::publications_writer;

/// What no participant sends, in a run that conforms.
struct Wrong {
  const char* name;
  void (*edit)(Conversation&);
  Fault fault;
};
std::ostream& operator<<(std::ostream& out, const Wrong& one) { return out << one.name; }

bool is_of_server(const Conversation& c, const Event& event) {
  return event.source == c.topology.server()->prefix;
}
Matches relayed(const Conversation& c, capture::EntityId writer) {
  return [&c, writer](const Event& event) {
    return is_of_server(c, event) && event.writer == writer && event.acknack() == nullptr;
  };
}
Matches and_also(const Matches& one, const Matches& other) {
  return [=](const Event& event) { return one(event) && other(event); };
}
bool is_data(const Event& event) { return event.data() != nullptr; }
bool is_gap(const Event& event) { return event.gap() != nullptr; }
bool is_heartbeat(const Event& event) { return event.heartbeat() != nullptr; }
bool is_acknack(const Event& event) { return event.acknack() != nullptr; }
Matches to_server(const Conversation& c, capture::EntityId writer, bool (*what)(const Event&)) {
  return [&c, writer, what](const Event& event) {
    return !is_of_server(c, event) && event.writer == writer && what(event);
  };
}

/// Those of the datagram that carries `event`.
Matches with(const Conversation& c, std::size_t event) {
  const std::uint32_t datagram = c.events[event].datagram;
  return [datagram](const Event& other) { return other.datagram == datagram; };
}
/// The whole datagram is sent at another time.
void shift(Conversation& c, std::size_t event, std::int64_t by_ns) {
  const Matches there = with(c, event);
  for (Event& one : c.events) {
    if (there(one)) one.time_ns += by_ns;
  }
  std::ranges::stable_sort(c.events, {}, &Event::time_ns);
}
void repeat(Conversation& c, const Matches& matches, std::int64_t later_ns) {
  const Event event = c.events[find_last(c, matches)];
  add(c, event, event.time_ns + later_ns);
}
template <class Content>
void change(Conversation& c, std::size_t event, void (*how)(Content&)) {
  how(std::get<Content>(c.events[event].content));
}

const std::vector<Wrong>& mistakes_of_server() {
  using capture::DataEvent;
  using capture::GapEvent;
  using capture::HeartbeatEvent;
  static const std::vector<Wrong> list{
      {"GapIsMissing",
       [](Conversation& c) {
         drop(c, with(c, find(c, and_also(relayed(c, publications), is_gap))));
       },
       Fault::data_cause},
      {"GapIsTooLong",
       [](Conversation& c) {
         change<GapEvent>(c, find(c, and_also(relayed(c, announcements), is_gap)),
                          [](GapEvent& gap) { ++gap.list.base; });
       },
       Fault::data_cause},
      {"GapOfNothing",
       [](Conversation& c) {
         change<GapEvent>(c, find(c, and_also(relayed(c, announcements), is_gap)),
                          [](GapEvent& gap) { gap.list.base = gap.start; });
       },
       Fault::gap_cause},
      {"GapBeginsTooEarly",
       [](Conversation& c) {
         const auto matches = [&c](const Event& event) {
           return relayed(c, publications)(event) && event.gap() != nullptr &&
                  event.gap()->start > 2;
         };
         change<GapEvent>(c, find(c, matches), [](GapEvent& gap) { --gap.start; });
       },
       Fault::gap_cause},
      {"GapThatNobodyAskedFor",
       [](Conversation& c) { repeat(c, and_also(relayed(c, publications), is_gap), 20 * ms); },
       Fault::gap_cause},
      {"DescriptorBeforeItsParticipantIsAcknowledged",
       [](Conversation& c) {
         shift(c, find(c, and_also(relayed(c, publications), is_data)), -430 * ms);
       },
       Fault::data_early},
      {"DescriptorBeforeTheRoutineRuns",
       [](Conversation& c) {
         shift(c, find(c, and_also(relayed(c, publications), is_data)), -100 * ms);
       },
       Fault::data_early},
      {"DescriptorThatTheClientDoesNotNeed",
       [](Conversation& c) {
         const auto is_private = [&c](const Event& event) {
           const auto* whose = c.topology.find(event.source);
           return event.writer == publications && event.data() != nullptr &&
                  !is_of_server(c, event) && event.data()->endpoint &&
                  whose->endpoints.at(*event.data()->endpoint).topic.ends_with("rosout");
         };
         const auto rosout = c.events[find(c, is_private)].data()->endpoint;
         const std::size_t at = find(c, [&](const Event& event) {
           return relayed(c, publications)(event) && event.data() != nullptr &&
                  event.data()->endpoint->prefix == rosout->prefix;
         });
         std::get<DataEvent>(c.events[at].content).endpoint = rosout;
       },
       Fault::data_cause},
      {"NumberOfAnotherChange",
       [](Conversation& c) {
         const std::size_t last = find_last(c, and_also(relayed(c, publications), is_data));
         std::get<DataEvent>(c.events[last].content).endpoint =
             c.events[find(c, and_also(relayed(c, publications), is_data))].data()->endpoint;
       },
       Fault::data_cause},
      {"DataWithoutHeartbeat",
       [](Conversation& c) { drop(c, find(c, and_also(relayed(c, publications), is_data)) + 1); },
       Fault::data_cause},
      {"DataThatIsAcknowledged",
       [](Conversation& c) {
         const std::size_t last = find_last(c, and_also(relayed(c, publications), is_data));
         const Event data = c.events[last];
         Event heartbeat = c.events[last + 1];
         std::get<HeartbeatEvent>(heartbeat.content).count += 100;
         const std::size_t added = add(c, data, data.time_ns + 300 * ms);
         heartbeat.datagram = c.events[added].datagram;
         heartbeat.time_ns = c.events[added].time_ns;
         c.events.insert(c.events.begin() + static_cast<std::ptrdiff_t>(added) + 1, heartbeat);
       },
       Fault::data_acknowledged},
      {"HeartbeatThatForgets",
       [](Conversation& c) {
         change<HeartbeatEvent>(c, find_last(c, and_also(relayed(c, publications), is_heartbeat)),
                                [](HeartbeatEvent& heartbeat) { heartbeat.last = 1; });
       },
       Fault::heartbeat_range},
      {"HeartbeatThatLeavesOutWhatIsNotAcknowledged",
       [](Conversation& c) {
         const std::size_t last = find_last(c, and_also(relayed(c, publications), is_heartbeat));
         const std::int64_t newest = std::get<HeartbeatEvent>(c.events[last].content).last;
         const auto is_sent = [newest](const Event& event) {
           return event.data() != nullptr && event.data()->sequence_number == newest;
         };
         const auto is_older = [newest](const Event& event) {
           return event.data() != nullptr && event.data()->sequence_number < newest;
         };
         // What is sent again behind it, as if nobody had acknowledged it; and nothing after that.
         const auto from = c.events.begin() + static_cast<std::ptrdiff_t>(find(
                                                  c, and_also(relayed(c, publications), is_sent)));
         const auto again =
             std::find_if(from, c.events.end(), and_also(relayed(c, publications), is_older));
         std::get<HeartbeatEvent>(std::next(again)->content).last = newest - 1;
         c.events.erase(again + 2, c.events.end());
         const auto acknowledges = [newest](const Event& event) {
           return event.acknack() != nullptr && event.acknack()->missing.base > newest;
         };
         c.events.erase(std::remove_if(from, c.events.end(), acknowledges), c.events.end());
       },
       Fault::heartbeat_range},
      {"HeartbeatOfWhatHasLeft",  // it is announced again by the next one
       [](Conversation& c) {
         const std::size_t third = find(c, and_also(relayed(c, publications), is_data), 2);
         auto& heartbeat = std::get<HeartbeatEvent>(c.events[third + 1].content);
         heartbeat.last = c.events[third].data()->sequence_number;
       },
       Fault::heartbeat_range},
      {"HeartbeatThatBeginsTooLate",
       [](Conversation& c) {
         const std::size_t data = find_last(c, and_also(relayed(c, publications), is_data));
         auto& heartbeat = std::get<HeartbeatEvent>(c.events[data + 1].content);
         heartbeat.first = c.events[data].data()->sequence_number + 1;
       },
       Fault::heartbeat_range},
      {"HeartbeatAgain",
       [](Conversation& c) { repeat(c, and_also(relayed(c, publications), is_heartbeat), ms); },
       Fault::heartbeat_count},
      {"HeartbeatWithoutCause",
       [](Conversation& c) {
         Event event = c.events[find_last(c, and_also(relayed(c, publications), is_heartbeat))];
         std::get<HeartbeatEvent>(event.content).count += 100;
         add(c, event, event.time_ns + 5 * ms);
         std::get<HeartbeatEvent>(event.content).count += 1;
         add(c, event, event.time_ns + 10 * ms);
       },
       Fault::heartbeat_cause},
      {"MessagePastTheServer",
       [](Conversation& c) {
         const std::size_t data = find(c, to_server(c, publications, is_data));
         const auto other = std::ranges::find_if(c.topology.participants, [&](const auto& one) {
           return !one.is_server() && one.prefix != c.events[data].source;
         });
         c.events[data].destination = other->prefix;
       },
       Fault::no_such_rule}};
  return list;
}

const std::vector<Wrong>& mistakes_of_clients() {
  using capture::AcknackEvent;
  using capture::HeartbeatEvent;
  static const auto asks = [](const Event& event) {
    return event.acknack() != nullptr && event.acknack()->missing.size() > 0;
  };
  static const std::vector<Wrong> list{
      {"ReplyTooEarly",
       [](Conversation& c) { shift(c, find(c, to_server(c, announcements, asks)), -2 * ms); },
       Fault::acknack_early},
      {"ReplyAboutWhatIsNot",
       [](Conversation& c) {
         change<AcknackEvent>(c, find(c, to_server(c, publications, asks)),
                              [](AcknackEvent& acknack) { acknack.missing.base += 3; });
       },
       Fault::acknack_content},
      {"ReplyOfTheServerAgain",
       [](Conversation& c) {
         repeat(
             c,
             [&c](const Event& event) {
               return is_of_server(c, event) && event.writer == announcements && is_acknack(event);
             },
             20 * ms);
       },
       Fault::acknack_cause},
      {"AnnouncementTooOften",
       [](Conversation& c) { repeat(c, to_server(c, announcements, is_data), 20 * ms); },
       Fault::announcement_extra},
      {"AnnouncementMissing",
       [](Conversation& c) { drop(c, find(c, to_server(c, announcements, is_data), 3)); },
       Fault::announcement_due},
      {"AnnouncedHeartbeatWithoutCause",
       [](Conversation& c) {
         Event event = c.events[find_last(c, to_server(c, announcements, is_heartbeat))];
         std::get<HeartbeatEvent>(event.content).count += 1;
         add(c, event, event.time_ns + 5 * ms);
       },
       Fault::heartbeat_cause},
      {"AnnouncedHeartbeatTwice",
       [](Conversation& c) { repeat(c, to_server(c, announcements, is_heartbeat), 5 * ms); },
       Fault::heartbeat_count},
      {"AnnouncedHeartbeatOfTwo",
       [](Conversation& c) {
         change<HeartbeatEvent>(c, find_last(c, to_server(c, announcements, is_heartbeat)),
                                [](HeartbeatEvent& heartbeat) { heartbeat.last = 2; });
       },
       Fault::heartbeat_range},
      {"WritersOpenBetweenTicks",
       [](Conversation& c) {
         shift(c, find(c, to_server(c, publications, is_heartbeat)), -30 * ms);
       },
       Fault::announcement_extra}};
  return list;
}

class ServerMistake : public ::testing::TestWithParam<Wrong> {};
TEST_P(ServerMistake, BreaksARule) {
  const model::Scenario scenario = served(model::Discovery::server);
  Simulated run = simulated(scenario);
  Bounds bounds = exact_bounds(scenario, run);
  bounds.most_delay_ns = 2 * ms;
  ASSERT_TRUE(is_explained(conformance(run.conversation, scenario.dds, bounds)));
  GetParam().edit(run.conversation);
  const Conformance result = conformance(run.conversation, scenario.dds, bounds);
  EXPECT_TRUE(std::ranges::any_of(result.unexplained, [](const Unexplained& one) {
    return one.fault == GetParam().fault;
  })) << description(result);
}
INSTANTIATE_TEST_SUITE_P(OfServer, ServerMistake, ::testing::ValuesIn(mistakes_of_server()),
                         [](const auto& one) { return std::string{one.param.name}; });
INSTANTIATE_TEST_SUITE_P(OfClients, ServerMistake, ::testing::ValuesIn(mistakes_of_clients()),
                         [](const auto& one) { return std::string{one.param.name}; });

}  // namespace server_mistakes_test
}  // namespace stormproof::conform::testing
