// Histories that cannot have happened: random edits of true captures, class by class. Of each class
// at least nine in ten are rejected, whatever else in the capture could explain them; what was not
// edited conforms.
#include <algorithm>
#include <functional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "props/generators/dice.hpp"
#include "tests/checker/evidence/conform/captures.hpp"
#include "tests/checker/evidence/conform/edits.hpp"

namespace stormproof::conform::testing {
namespace histories_test {

using props::Dice;
constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t us = 1'000;

/// A class of histories. `edit` says whether the capture has something that it can change.
struct History {
  std::string name;
  std::function<bool(Conversation&, Dice&)> edit;
  bool no_loss = false;  ///< it is impossible only if nothing is lost

  friend void PrintTo(const History& one, std::ostream* out) { *out << one.name; }
};

bool is_sedp(const Event& event) {
  return event.writer == capture::entity::publications_writer ||
         event.writer == capture::entity::subscriptions_writer;
}
bool is_heartbeat(const Event& event) { return is_sedp(event) && event.heartbeat() != nullptr; }
bool is_data(const Event& event) { return is_sedp(event) && event.data() != nullptr; }
bool is_acknack(const Event& event) { return is_sedp(event) && event.acknack() != nullptr; }
bool is_reply(const Event& event) {
  return is_acknack(event) && !(event.acknack()->is_initial() && !event.acknack()->is_final);
}
std::uint32_t& count_of(Event& event) {
  if (auto* heartbeat = std::get_if<capture::HeartbeatEvent>(&event.content)) {
    return heartbeat->count;
  }
  return std::get<capture::AcknackEvent>(event.content).count;
}
/// Whether both are from one side of a relation.
bool same_way(const Event& a, const Event& b) {
  return a.source == b.source && a.destination == b.destination && a.writer == b.writer &&
         (a.acknack() == nullptr) == (b.acknack() == nullptr);
}

/// A random event for which `is_one` holds; SIZE_MAX if there is none.
std::size_t pick(const Conversation& c, Dice& dice,
                 const std::function<bool(std::size_t)>& is_one) {
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < c.events.size(); ++k) {
    if (is_one(k)) all.push_back(k);
  }
  return all.empty() ? SIZE_MAX : dice.pick(all);
}
/// Changes a random event for which `is_one` holds.
auto changing(bool (*is_one)(const Event&),
              std::function<bool(const Conversation&, std::size_t)> also,
              std::function<void(Conversation&, std::size_t)> change) {
  return [=](Conversation& c, Dice& dice) {
    const std::size_t k =
        pick(c, dice, [&](std::size_t k) { return is_one(c.events[k]) && also(c, k); });
    if (k != SIZE_MAX) change(c, k);
    return k != SIZE_MAX;
  };
}
bool anyhow(const Conversation&, std::size_t) { return true; }
bool is_not_first(const Conversation& c, std::size_t k) {
  return std::any_of(
      c.events.begin(), c.events.begin() + static_cast<std::ptrdiff_t>(k), [&](const Event& one) {
        return same_way(one, c.events[k]) && one.content.index() == c.events[k].content.index();
      });
}
bool has_counted_before(const Conversation& c, std::size_t k) {
  return c.events[k].heartbeat()->count > 1 && is_not_first(c, k);
}

/// Whether its writer has shown before, to whomever, that there are three or more.
bool shows_more_before(const Conversation& c, std::size_t k) {
  const Event& one = c.events[k];
  return std::ranges::any_of(c.events, [&](const Event& other) {
    const bool is_before = other.source == one.source && other.writer == one.writer &&
                           other.time_ns + 2 * us < one.time_ns;
    return is_before && ((other.heartbeat() != nullptr && other.heartbeat()->last >= 3) ||
                         (other.data() != nullptr && other.data()->sequence_number >= 3));
  });
}

/// Descriptors that the HEARTBEAT that opens the relation of this DATA announces.
std::int64_t existing(const Conversation& c, const Event& data) {
  const auto opening = std::ranges::find_if(
      c.events, [&](const Event& one) { return same_way(one, data) && is_heartbeat(one); });
  return opening == c.events.end() ? INT64_MAX : opening->heartbeat()->last;
}
bool is_first_transmission(const Conversation& c, std::size_t k) {
  return std::none_of(c.events.begin(), c.events.begin() + static_cast<std::ptrdiff_t>(k),
                      [&](const Event& one) {
                        return same_way(one, c.events[k]) && is_data(one) &&
                               one.data()->sequence_number == c.events[k].data()->sequence_number;
                      });
}
bool is_pushed(const Conversation& c, std::size_t k) {
  const Event& one = c.events[k];
  return is_data(one) && is_first_transmission(c, k) &&
         one.data()->sequence_number > existing(c, one);
}
/// The push of the next number to the same reader.
std::size_t next_push(const Conversation& c, std::size_t k) {
  for (std::size_t n = k + 1; n < c.events.size(); ++n) {
    if (same_way(c.events[n], c.events[k]) && is_pushed(c, n) &&
        c.events[n].data()->sequence_number == c.events[k].data()->sequence_number + 1) {
      return n;
    }
  }
  return SIZE_MAX;
}
bool has_a_next(const Conversation& c, std::size_t k) {
  return is_pushed(c, k) && next_push(c, k) != SIZE_MAX;
}

/// Takes out all copies of announcements from one participant to another that announced itself
/// when it was there already.
bool remain_unintroduced(Conversation& c, Dice& dice) {
  const auto is_spdp = [](const Event& one) { return one.traffic() == capture::Traffic::spdp; };
  const std::size_t heard = pick(c, dice, [&](std::size_t k) {
    return is_spdp(c.events[k]) && c.events[k].destination &&
           std::any_of(c.events.begin(), c.events.begin() + static_cast<std::ptrdiff_t>(k),
                       [&](const Event& one) { return one.source == c.events[k].source; });
  });
  if (heard == SIZE_MAX) return false;
  const Event copy = c.events[heard];
  const auto of = [&](const capture::GuidPrefix& who) {
    return std::ranges::find_if(c.events, [&](const Event& one) {
      return is_spdp(one) && one.source == who && one.is_multicast;
    });
  };
  const auto own = of(copy.source);
  const auto other = of(*copy.destination);
  if (own == c.events.end() || other == c.events.end() || own->time_ns >= other->time_ns) {
    return false;
  }
  drop(c, [&](const Event& one) {
    return is_spdp(one) && one.source == copy.source && one.destination == copy.destination;
  });
  return true;
}

std::vector<History> histories() {
  return {{"acknack_count_jumps",
           changing(is_acknack, anyhow,
                    [](Conversation& c, std::size_t k) { count_of(c.events[k]) += 7; })},
          {"acknack_count_starts_anew",
           changing(is_acknack, is_not_first,
                    [](Conversation& c, std::size_t k) { count_of(c.events[k]) = 1; })},
          {"acknack_comes_again", changing(is_acknack, anyhow,
                                           [](Conversation& c, std::size_t k) {
                                             add(c, c.events[k], c.events[k].time_ns + 300 * us);
                                           })},
          {"acknack_confirms_what_is_not",
           changing(is_reply, anyhow,
                    [](Conversation& c, std::size_t k) {
                      std::get<capture::AcknackEvent>(c.events[k].content).missing = {
                          c.events[k].acknack()->missing.base + 5, 0, {}};
                    })},
          {"heartbeat_count_jumps",
           changing(is_heartbeat, has_counted_before,
                    [](Conversation& c, std::size_t k) { count_of(c.events[k]) += 5; })},
          {"heartbeat_count_starts_anew",
           changing(is_heartbeat, has_counted_before,
                    [](Conversation& c, std::size_t k) { count_of(c.events[k]) = 1; })},
          {"heartbeat_comes_again", changing(is_heartbeat, anyhow,
                                             [](Conversation& c, std::size_t k) {
                                               add(c, c.events[k], c.events[k].time_ns + 300 * us);
                                             })},
          {"heartbeat_announces_too_much",
           changing(is_heartbeat, anyhow,
                    [](Conversation& c, std::size_t k) {
                      std::get<capture::HeartbeatEvent>(c.events[k].content).last += 3;
                    })},
          {"heartbeat_hides_what_exists",
           changing(is_heartbeat, shows_more_before,
                    [](Conversation& c, std::size_t k) {
                      std::get<capture::HeartbeatEvent>(c.events[k].content).last = 1;
                    })},
          {"data_is_pushed_in_another_order",
           changing(is_data, has_a_next,
                    [](Conversation& c, std::size_t k) {
                      std::swap(c.events[k].content, c.events[next_push(c, k)].content);
                    })},
          {"data_is_left_out",
           changing(is_data, has_a_next, [](Conversation& c, std::size_t k) { drop(c, k); })},
          {"data_comes_unasked", changing(is_data, anyhow,
                                          [](Conversation& c, std::size_t k) {
                                            add(c, c.events[k], c.events[k].time_ns + 3 * ms);
                                          })},
          {"nobody_introduces_itself", remain_unintroduced, true}};
}

/// Two or three hosts with a participant each, whose endpoints come into being while they talk.
model::Scenario drawn(Dice& dice, bool may_lose) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(dice.count(2, 3), 1, dice.count(2, 4));
  std::int64_t start = 0;
  for (model::Participant& one : scenario.deployment.participants) {
    one.start = model::Nanoseconds{start += dice.between(2 * ms, 15 * ms)};
    one.endpoints_done = model::Nanoseconds{start + dice.between(10 * ms, 80 * ms)};
  }
  scenario.dds = profile("fastdds-2.6.11");
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = model::Nanoseconds{ms};
  for (std::uint64_t packet = 4; may_lose && packet < 150; ++packet) {
    if (dice.chance(15)) scenario.wireless.lost_packets.push_back(packet);
  }
  scenario.time_limit = model::Nanoseconds{4'000 * ms};
  scenario.run_until = model::RunUntil::time_limit;
  return scenario;
}

/// How many of `wanted` edits of the class are rejected; the seeds of the others.
std::size_t rejected(const History& history, std::size_t wanted, std::string& accepted) {
  std::size_t edited = 0;
  std::size_t count = 0;
  for (std::uint64_t seed = 1; edited < wanted && seed < 20 * wanted; ++seed) {
    Dice dice{seed};
    const bool may_lose = !history.no_loss && dice.chance(50);
    const model::Scenario scenario = drawn(dice, may_lose);
    Simulated run = simulated(scenario);
    Bounds bounds = exact_bounds(scenario, run);
    bounds.least_delay_ns = bounds.most_delay_ns = ms;
    bounds.most_send_lag_ns = 2 * us;
    const Conformance truth = conformance(run.conversation, scenario.dds, bounds);
    EXPECT_EQ(truth.verdict, Verdict::conforms) << "seed " << seed << ": " << description(truth);
    if (!history.edit(run.conversation, dice)) continue;
    ++edited;
    const Conformance lie = conformance(run.conversation, scenario.dds, bounds);
    count += lie.verdict == Verdict::does_not_conform ? 1U : 0U;
    if (lie.verdict != Verdict::does_not_conform) accepted += " " + std::to_string(seed);
  }
  EXPECT_EQ(edited, wanted) << "these captures have too little that it can change";
  return count;
}

class Histories : public ::testing::TestWithParam<History> {};
INSTANTIATE_TEST_SUITE_P(Impossible, Histories, ::testing::ValuesIn(histories()),
                         [](const auto& info) { return info.param.name; });

TEST_P(Histories, AreRejected) {
  std::string accepted;
  EXPECT_GE(rejected(GetParam(), 10, accepted), 9U) << "accepted with seeds" << accepted;
}

TEST_P(Histories, AreRejectedManyTimes) {
  std::string accepted;
  const std::size_t count = rejected(GetParam(), 100, accepted);
  EXPECT_GE(count, 90U) << "accepted with seeds" << accepted;
  RecordProperty("rejected", static_cast<int>(count));
}

}  // namespace histories_test
}  // namespace stormproof::conform::testing
