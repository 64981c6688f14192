// The changes, by what they are about.
#include "tests/checker/evidence/conform/fault_cases.hpp"

#include "tests/checker/evidence/conform/captures.hpp"

namespace stormproof::conform::testing {

namespace {

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t us = 1'000;
constexpr capture::EntityId publications = capture::entity::publications_writer;

/// The packet that opens the relation from participant 0 to 1, and the initial ACKNACK that follows
/// from its loss.
constexpr std::uint64_t opening_packet = 4;
constexpr std::uint64_t initial_packet = 62;

/// Events of the relation from participant `from` to `to`, publications.
Matches sent(const Conversation& c, std::size_t from, std::size_t to) {
  return [&c, from, to](const Event& event) {
    return event.writer == publications && event.acknack() == nullptr &&
           source_of(c, event) == from && destination_of(c, event) == to;
  };
}
Matches answers(const Conversation& c, std::size_t from, std::size_t to) {
  return [&c, from, to](const Event& event) {
    return event.writer == publications && event.acknack() != nullptr &&
           source_of(c, event) == from && destination_of(c, event) == to;
  };
}
Matches both(const Matches& one, const Matches& other) {
  return [=](const Event& event) { return one(event) && other(event); };
}
bool is_heartbeat(const Event& event) { return event.heartbeat() != nullptr; }
bool is_data(const Event& event) { return event.data() != nullptr; }
bool is_initial(const Event& event) {
  return event.acknack() != nullptr && event.acknack()->is_initial() && !event.acknack()->is_final;
}
bool asks(const Event& event) {
  return event.acknack() != nullptr && event.acknack()->missing.size() > 0;
}
bool acknowledges(const Event& event) {
  return event.acknack() != nullptr && event.acknack()->missing.base > 1;
}
Matches multicast_of(const Conversation& c, std::size_t participant) {
  return [&c, participant](const Event& event) {
    return event.traffic() == capture::Traffic::spdp && event.is_multicast &&
           source_of(c, event) == participant;
  };
}
capture::HeartbeatEvent& heartbeat_at(Conversation& c, std::size_t event) {
  return std::get<capture::HeartbeatEvent>(c.events[event].content);
}
capture::AcknackEvent& acknack_at(Conversation& c, std::size_t event) {
  return std::get<capture::AcknackEvent>(c.events[event].content);
}

std::vector<Case> announcement_cases() {
  return {{Fault::not_announced, "opening_before_announcement",
           [](Conversation& c) {
             return move(c, find(c, sent(c, 0, 1)),
                         c.events[find(c, multicast_of(c, 1))].time_ns - ms);
           },
           "clock error"},
          {Fault::not_announced, "acknack_before_announcement",
           [](Conversation& c) {
             const Event first = c.events[find(c, answers(c, 1, 0))];
             return add(c, first, c.events[find(c, multicast_of(c, 0))].time_ns - ms);
           },
           "clock error"},
          {Fault::announcement_extra, "additional_multicast",
           [](Conversation& c) {
             const Event one = c.events[find_last(c, multicast_of(c, 1))];
             return add(c, one, one.time_ns - 30 * ms);
           },
           "send lag"},
          {Fault::announcement_extra, "additional_copy",
           [](Conversation& c) {
             const Event one = c.events[find_last(c, [&c](const Event& event) {
               return event.traffic() == capture::Traffic::spdp && !event.is_multicast &&
                      source_of(c, event) == 1;
             })];
             return add(c, one, one.time_ns - 30 * ms);
           },
           "send lag, so that a multicast is near"},
          {Fault::announcement_due, "one_is_missing",
           [](Conversation& c) {
             const std::int64_t gone = c.events[find(c, multicast_of(c, 1), 3)].time_ns;
             drop(c, [&c, gone](const Event& event) {
               return event.traffic() == capture::Traffic::spdp && source_of(c, event) == 1 &&
                      event.time_ns == gone;
             });
             return find(c, multicast_of(c, 1), 3);
           },
           "lateness"},
          {Fault::other_version, "announcement_of_another_version",
           [](Conversation& c) {
             c.topology.participants[1].version = "3.6.2";
             return find(c, multicast_of(c, 1));
           },
           "sizes: v3.6"}};
}

std::vector<Case> heartbeat_cases() {
  return {{Fault::not_opened, "without_opening",
           [](Conversation& c) {
             drop(c, find(c, both(sent(c, 0, 1), is_heartbeat)));
             return find(c, sent(c, 0, 1));
           },
           "a HEARTBEAT with INFO_DST before it"},
          {Fault::heartbeat_cause, "before_the_timer",
           [](Conversation& c) {
             const std::size_t last = find_last(c, both(sent(c, 0, 1), is_heartbeat));
             const std::size_t added = add(c, c.events[last], c.events[last].time_ns + 300 * ms);
             heartbeat_at(c, added).count += 1;
             return added;
           },
           "send lag"},
          {Fault::heartbeat_range, "starts_at_two",
           [](Conversation& c) {
             const std::size_t first = find(c, both(sent(c, 0, 1), is_heartbeat));
             heartbeat_at(c, first).first = 2;
             return first;
           },
           "a writer whose endpoints are only created"},
          {Fault::heartbeat_copies, "one_reader_left_out",
           [](Conversation& c) {
             const auto fan_out = both(sent(c, 0, 1), [](const Event& event) {
               return is_heartbeat(event) && !event.has_info_dst;
             });
             const std::uint32_t count = c.events[find(c, fan_out)].heartbeat()->count;
             const auto copies = [&c, count](const Event& event) {
               return event.writer == publications && is_heartbeat(event) &&
                      source_of(c, event) == 0 && event.heartbeat()->count == count;
             };
             drop(c, find(c, copies, 1));
             return find(c, copies);
           },
           "a copy to each of the other readers", 3},
          {Fault::heartbeat_due, "timer_never_expires",
           [](Conversation& c) {
             const std::size_t opening = find(c, both(sent(c, 0, 1), is_heartbeat));
             const std::int64_t opened = c.events[opening].time_ns;
             heartbeat_at(c, opening).last =
                 std::max<std::int64_t>(1, heartbeat_at(c, opening).last);
             drop(c, [&, opened](const Event& event) {
               return event.time_ns > opened && (sent(c, 0, 1)(event) || answers(c, 1, 0)(event));
             });
             return find(c, sent(c, 0, 1));
           },
           "a HEARTBEAT to this reader in time"},
          {Fault::heartbeat_count,
           "counts_down",
           [](Conversation& c) {
             heartbeat_at(c, find(c, both(sent(c, 0, 1), is_heartbeat))).count += 100;
             return find(c, both(sent(c, 0, 1), is_heartbeat), 1);
           },
           "send lag",
           2,
           true,
           {opening_packet}}};
}

std::vector<Case> data_cases() {
  return {{Fault::data_cause, "pushed_twice",
           [](Conversation& c) {
             const std::size_t last = find_last(c, both(sent(c, 0, 1), is_data));
             return add(c, c.events[last], c.events[last].time_ns + 5 * ms);
           },
           "an ACKNACK of this reader before it that asks for the descriptor"},
          {Fault::data_order, "one_is_left_out",
           [](Conversation& c) {
             const std::int64_t existing =
                 c.events[find(c, both(sent(c, 0, 1), is_heartbeat))].heartbeat()->last;
             const auto number = [&](std::int64_t n) {
               return both(sent(c, 0, 1), [n](const Event& event) {
                 return is_data(event) && event.data()->sequence_number == n;
               });
             };
             drop(c, number(existing + 1));
             return find(c, number(existing + 2));
           },
           "a push of every smaller number before it"},
          {Fault::data_early, "before_the_response_delay",
           [](Conversation& c) {
             const std::size_t asked = find(c, both(answers(c, 1, 0), asks));
             const std::size_t number = static_cast<std::size_t>(acknack_at(c, asked).missing.base);
             const std::size_t data =
                 find(c, both(sent(c, 0, 1), [number](const Event& event) {
                        return is_data(event) &&
                               event.data()->sequence_number == static_cast<std::int64_t>(number);
                      }));
             return move(c, data, c.events[asked].time_ns + 50 * us);
           },
           "clock error"}};
}

std::vector<Case> reply_cases() {
  return {{Fault::acknack_cause, "answers_nothing",
           [](Conversation& c) {
             const std::size_t last = find_last(c, answers(c, 1, 0));
             return add(c, c.events[last], c.events[last].time_ns + 50 * ms);
           },
           "one more HEARTBEAT to this reader before it"},
          {Fault::acknack_early, "before_the_response_delay",
           [](Conversation& c) {
             const std::size_t heartbeat = find(c, both(sent(c, 0, 1), is_heartbeat));
             const std::size_t answer = find(c, answers(c, 1, 0));
             return move(c, answer, c.events[heartbeat].time_ns + 5 * us);
           },
           "clock error"},
          {Fault::acknack_count, "leaves_some_out",
           [](Conversation& c) {
             const std::size_t answer = find_last(c, answers(c, 1, 0));
             acknack_at(c, answer).count += 7;
             return answer;
           },
           "another count"},
          {Fault::acknack_content, "asks_for_too_little",
           [](Conversation& c) {
             const std::size_t answer = find(c, both(answers(c, 1, 0), asks));
             acknack_at(c, answer).missing.base += 1;
             return answer;
           },
           "clock error"}};
}

std::vector<Case> other_cases() {
  return {{Fault::initial_early,
           "before_its_delay",
           [](Conversation& c) {
             const std::size_t initial = find(c, both(answers(c, 1, 0), is_initial));
             return move(c, initial, c.events[initial].time_ns - 20 * ms);
           },
           "clock error",
           2,
           true,
           {opening_packet}},
          {Fault::initial_late,
           "after_its_delay",
           [](Conversation& c) {
             const std::size_t initial = find(c, both(answers(c, 1, 0), is_initial), 1);
             return move(c, initial, c.events[initial].time_ns + 500 * us);
           },
           "lateness",
           2,
           true,
           {opening_packet, initial_packet}},
          {Fault::initial_after_heartbeat, "after_a_reply",
           [](Conversation& c) {
             Event initial = c.events[find_last(c, answers(c, 1, 0))];
             initial.content = capture::AcknackEvent{{0, 0, {}}, 77, false};
             return add(c, initial, initial.time_ns + 80 * ms);
           },
           ""},
          {Fault::unanswered, "heartbeat_without_answer",
           [](Conversation& c) {
             const std::size_t last = find_last(c, both(sent(c, 0, 1), is_heartbeat));
             const std::int64_t time = c.events[last].time_ns;
             drop(c, both(answers(c, 1, 0),
                          [time](const Event& event) { return event.time_ns > time; }));
             return last;
           },
           "a loss, or a longer delay", 2, false},
          {Fault::data_acknowledged, "after_the_acknowledgment",
           [](Conversation& c) {
             const std::size_t last = find_last(c, both(answers(c, 1, 0), acknowledges));
             Event data = c.events[find(c, both(sent(c, 0, 1), is_data))];
             data.time_ns = c.events[last].time_ns + 500 * ms;
             return add(c, data, data.time_ns);
           },
           "delay", 2, false},
          {Fault::number_beyond, "data_with_a_damaged_number",
           [](Conversation& c) {
             const std::size_t last = find_last(c, both(sent(c, 0, 1), is_data));
             Event damaged = c.events[last];
             std::get<capture::DataEvent>(damaged.content).sequence_number += 1 << 30;
             return add(c, damaged, damaged.time_ns + 50 * ms);
           },
           "numbers that the writer can have reached"},
          {Fault::number_beyond, "heartbeat_with_a_damaged_number",
           [](Conversation& c) {
             Event damaged = c.events[find_last(c, both(sent(c, 0, 1), is_heartbeat))];
             std::get<capture::HeartbeatEvent>(damaged.content).last += 1 << 29;
             return add(c, damaged, damaged.time_ns + 50 * ms);
           },
           "numbers that the writer can have reached"},
          {Fault::no_such_rule, "gap",
           [](Conversation& c) {
             const std::size_t last = find_last(c, both(sent(c, 0, 1), is_heartbeat));
             Event gap = c.events[last];
             gap.content = capture::GapEvent{1, {}};
             return add(c, gap, gap.time_ns + 50 * ms);
           },
           ""},
          {Fault::gap_cause,
           "again",
           [](Conversation& c) {
             const Event gap = c.events[find_last(c, [](const Event& event) {
               return event.gap() != nullptr && event.writer == publications;
             })];
             return add(c, gap, gap.time_ns + 50 * ms);
           },
           "",
           3,
           false,
           {},
           true}};
}

}  // namespace

model::Scenario served(model::Discovery discovery, std::vector<std::uint64_t> lost) {
  model::Scenario scenario = quiet(3, std::move(lost));
  std::int64_t start = 0;
  for (model::Participant& one : scenario.deployment.participants) {
    ++one.host.value;  // the server is on host 0
    start += one.host.value == 3 ? 700 * ms : 12 * ms;
    one.start = model::Nanoseconds{start};
    one.endpoints_done = model::Nanoseconds{start + 5 * ms};
  }
  scenario.dds = profile("fastdds-server-2.6.11");
  scenario.dds.discovery = discovery;
  scenario.time_limit = model::Nanoseconds{6'000 * ms};
  return scenario;
}

model::Scenario quiet(std::uint32_t participants, std::vector<std::uint64_t> lost) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(participants, 1, 2);
  std::int64_t start = 0;
  for (model::Participant& one : scenario.deployment.participants) {
    one.start = model::Nanoseconds{start += 2 * ms};
    one.endpoints_done = model::Nanoseconds{start + 20 * ms};
  }
  scenario.dds = profile("fastdds-2.6.11");
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = model::Nanoseconds{ms};
  scenario.wireless.lost_packets = std::move(lost);
  scenario.time_limit = model::Nanoseconds{4'000 * ms};
  if (participants > 2) scenario.dds.sedp.piggyback_threshold_bytes = model::Bytes{2'000};
  scenario.run_until = model::RunUntil::time_limit;
  return scenario;
}

std::vector<Case> all_cases() {
  std::vector<Case> all;
  for (const auto& some :
       {announcement_cases(), heartbeat_cases(), data_cases(), reply_cases(), other_cases()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace stormproof::conform::testing
