// Mistakes in the transition tables and in the rules show in captures: runs with a mistake do not
// conform to the profile without it. Not every mistake can: some change only what a capture does
// not show.
#include "checker/verification/mutate/mutants.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/checker/evidence/conform/captures.hpp"

namespace stormproof::conform::testing {
namespace mutants_test {

constexpr std::int64_t ms = 1'000'000;

model::Scenario base(std::uint32_t participants, std::vector<std::uint64_t> lost) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(participants, 1, 3);
  std::int64_t start = 0;
  for (model::Participant& one : scenario.deployment.participants) {
    one.start = model::Nanoseconds{start += 3 * ms};
    one.endpoints_done = model::Nanoseconds{start + 15 * ms};
  }
  scenario.dds = profile("fastdds-2.6.11");
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = model::Nanoseconds{ms};
  scenario.wireless.lost_packets = std::move(lost);
  scenario.time_limit = model::Nanoseconds{5'000 * ms};
  scenario.run_until = model::RunUntil::time_limit;
  return scenario;
}

/// Two and three hosts, without losses and with some, and DATA that carries HEARTBEATs.
std::vector<model::Scenario> scenarios() {
  std::vector<model::Scenario> list{base(2, {}), base(2, {4, 10, 25}), base(3, {})};
  std::vector<std::uint64_t> many;
  for (std::uint64_t k = 5; k < 120; k += 4) many.push_back(k);
  list.push_back(base(2, many));
  list.push_back(base(3, many));
  list.back().dds.sedp.piggyback_threshold_bytes = model::Bytes{3'000};
  return list;
}

/// Whether a run of `scenario` with the mistake does not conform to the profile without it. If
/// nothing is lost, every packet takes 1 ms.
bool is_noticed(const model::Scenario& scenario, const checker::Mutant& mutant,
                std::uint64_t max_events = 50'000) {
  model::Scenario mistaken = scenario;
  if (mutant.knobs) mutant.knobs(mistaken);
  model::RunOptions options;
  options.mutation = &mutant.rules;
  options.max_events = max_events;
  const Simulated run = simulated(mistaken, options);
  if (run.is_empty || run.conversation.topology.hosts < 2) return false;
  Bounds bounds = exact_bounds(scenario, run);
  if (scenario.wireless.lost_packets.empty()) bounds.least_delay_ns = bounds.most_delay_ns = ms;
  return conformance(run.conversation, scenario.dds, bounds).verdict == Verdict::does_not_conform;
}

/// The interval of initial ACKNACKs is a knob of their machine.
std::string machine_of(const checker::Mutant& mutant) {
  if (mutant.id == "attempts-mistake-interval") return "InitialAckNack";
  return mutant.rules.tables.empty() ? "rules" : mutant.rules.tables.front().machine;
}

/// Mistakes that these captures do not show, and why.
const std::map<std::string, std::string>& unseen() {
  const std::string silence = "something is not sent, as if a loss had prevented its cause";
  const std::string channel = "it is about the channel, which a capture at the source ends before";
  const std::string order = "it is about the order of events within an instant";
  const std::string resolution = "it is shorter than what captures resolve";
  const std::string no_effect = "no packet of a run depends on it";
  static const std::map<std::string, std::string> list{
      {"base-inverted", silence},
      {"change-assumed-delivered", silence},
      {"change-stays-suppressed", silence},
      {"initial-acknack-keeps-state", silence},
      {"suppression-end-forgotten", silence},
      {"initial-acknack-not-sent", silence},
      {"attempts-end-unseen", silence},
      {"expiry-not-handled", silence},
      {"attempts-never-end", no_effect},
      {"single-shot-doubled", no_effect},
      {"adaptive-cycle-never-ends", "the profile's HEARTBEATs are periodic"},
      {"serialized-not-suppressed", "no request of these runs arrives within 10 µs of its DATA"},
      {"suppression-zero", "no request of these runs arrives within 10 µs of its DATA"},
      {"acknack-a-nanosecond-early", resolution},
      {"suppression-a-nanosecond-short", resolution},
      {"acknack-before-reception", order},
      {"order-pairwise", order},
      {"order-without-class", order},
      {"order-without-insertion", order},
      {"dispatch-first", channel},
      {"queue-twice-as-large", channel},
      {"service-after-decision", channel}};
  return list;
}

TEST(Mutants, CorrectRunsAreNotTakenForMistakes) {
  for (const model::Scenario& scenario : scenarios()) EXPECT_FALSE(is_noticed(scenario, {}));
}

TEST(Mutants, OfEveryMachineThatTakesPartAreNoticed) {
  const std::vector<model::Scenario> grounds = scenarios();
  std::map<std::string, std::size_t> noticed;
  std::size_t all = 0;
  for (const mutate::CatalogueEntry& entry : mutate::mutants()) {
    const bool shows = std::ranges::find(entry.concerns, model::ImplementationKind::fastdds) !=
                       entry.concerns.end();
    if (!shows) continue;
    // Of effects there are too many, most of which no captured packet shows.
    if (entry.kind == mutate::Kind::effect) continue;
    // Machines that no captured event of discovery goes through.
    const std::string machine = machine_of(entry.mutant);
    if (machine == "Channel" || machine == "ControlReader" || machine == "ControlWriter") {
      continue;
    }
    ++all;
    const std::string& id = entry.mutant.id;
    const bool is_found = std::any_of(
        grounds.begin(), grounds.end(),
        [&](const model::Scenario& scenario) { return is_noticed(scenario, entry.mutant); });
    if (is_found) {
      ++noticed[machine];
      ++noticed["all"];
    } else {
      EXPECT_TRUE(unseen().contains(id)) << id << ": " << entry.mutant.description;
    }
  }
  for (const char* one : {"Announcer", "ChangeForReader", "DiscoveryReader", "HeartbeatTimer",
                          "InitialAckNack", "SingleShot", "rules"}) {
    EXPECT_GE(noticed[one], 1U) << one;
  }
  EXPECT_GE(2 * noticed["all"], all) << noticed["all"] << " of " << all;
}

/// When what was sent of discovery itself; at liveliness and user endpoints nobody looks.
std::vector<std::tuple<std::int64_t, std::uint32_t, std::uint32_t>> sent_in(const Simulated& run) {
  std::vector<std::tuple<std::int64_t, std::uint32_t, std::uint32_t>> all;
  for (const capture::Event& event : run.conversation.events) {
    const capture::Traffic traffic = event.traffic();
    if (traffic != capture::Traffic::spdp && traffic != capture::Traffic::sedp) continue;
    all.emplace_back(event.time_ns - run.conversation.first_ns, event.writer, event.bytes);
  }
  return all;
}

/// Mistakes in what connects the machines. A mistake that changes what is sent may still be one
/// that causes on the own host explain as well, or one by which nothing is sent that was owed to
/// nobody; the properties `ConformsWhateverTheKnobs` are the other direction.
TEST(Mutants, OfEffectsThatChangeWhatIsSentAreMostlyNoticed) {
  // Nothing is lost: losses of packets by number would hit others when one more is sent.
  std::vector<model::Scenario> grounds{base(2, {}), base(3, {}), base(3, {})};
  grounds.back().dds.sedp.piggyback_threshold_bytes = model::Bytes{3'000};
  std::vector<std::vector<std::tuple<std::int64_t, std::uint32_t, std::uint32_t>>> correct;
  for (const model::Scenario& scenario : grounds) correct.push_back(sent_in(simulated(scenario)));
  constexpr std::uint64_t most_events = 10'000;
  std::size_t visible = 0;
  std::size_t noticed = 0;
  std::string left;
  for (const mutate::CatalogueEntry& entry : mutate::mutants()) {
    if (entry.kind != mutate::Kind::effect ||
        entry.concerns == mutate::Concerns{model::ImplementationKind::paper}) {
      continue;
    }
    bool is_visible = false;
    bool is_found = false;
    for (std::size_t k = 0; k < grounds.size() && !is_found; ++k) {
      model::Scenario mistaken = grounds[k];
      if (entry.mutant.knobs) entry.mutant.knobs(mistaken);
      model::RunOptions options;
      options.mutation = &entry.mutant.rules;
      options.max_events = most_events;
      const Simulated run = simulated(mistaken, options);
      if (run.is_empty || sent_in(run) == correct[k]) continue;
      is_visible = true;
      is_found = is_noticed(grounds[k], entry.mutant, most_events);
    }
    visible += is_visible ? 1 : 0;
    noticed += is_found ? 1 : 0;
    if (is_visible && !is_found) left += "\n" + entry.mutant.id + ": " + entry.mutant.description;
  }
  EXPECT_GT(visible, 100U);
  EXPECT_GE(10 * noticed, 7 * visible) << noticed << " of " << visible << left;
  RecordProperty("visible", static_cast<int>(visible));
  RecordProperty("noticed", static_cast<int>(noticed));
}

}  // namespace mutants_test
}  // namespace stormproof::conform::testing
