// For every change of one knob that can matter there is a small scenario that shows it, and what is
// said of it is so. The runs are looked at here with a probe of their own.
#include "checker/experiments/diff/telling_apart.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "checker/experiments/diff/first_difference.hpp"
#include "checker/experiments/diff/normal_form.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/engine/packet.hpp"
#include "model/simulator.hpp"
#include "props/generators/knob_access.hpp"

namespace stormproof::diff {
namespace telling_apart_test {

using model::Bytes;
using model::DdsProfile;
using model::Deployment;
using model::Nanoseconds;
using model::Scenario;

DdsProfile preset(const std::string& name) {
  const model::config::SpecPath specs{{STORMPROOF_SPECS_DIR}};
  const auto profile = model::config::read_dds_profile(name, {}, specs);
  EXPECT_TRUE(profile) << name;
  return profile ? *profile : DdsProfile{};
}

Scenario usual_start() {
  Scenario start;
  start.deployment = Deployment::homogeneous(2, 2, 4);
  return start;
}

TellingApart told(const DdsProfile& base, const DdsProfile& candidate) {
  return tell_apart(usual_start(), base, candidate, {});
}

/// What is on the way, in the order of emission: time, source, kind, size, contents.
class Wire final : public model::Probe {
 public:
  void event_started(const model::Event& event) override { now_ = event.time; }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    times.push_back(now_);
    std::string text = std::to_string(now_.count()) + ' ' + std::to_string(source) + ' ' +
                       name_of(packet.kind) + std::to_string(packet.payload_bytes) + ' ' +
                       std::to_string(packet.descriptors.count()) + name_of(packet.stream);
    for (const std::uint32_t to : destinations) text += ' ' + std::to_string(to);
    packets.push_back(std::move(text));
  }

  std::vector<Nanoseconds> times;
  std::vector<std::string> packets;

 private:
  Nanoseconds now_;
};

Wire wire_of(const Scenario& scenario) {
  Wire wire;
  model::RunOptions options;
  options.probe = &wire;
  static_cast<void>(model::simulate(scenario, options));
  return wire;
}

/// The runs part where the answer says.
void expect_true(const TellingApart& apart) {
  const Wire base = wire_of(apart.base_run.scenario);
  const Wire candidate = wire_of(apart.candidate_run.scenario);
  const auto [a, b] = std::ranges::mismatch(base.packets, candidate.packets);
  const auto place = static_cast<std::size_t>(a - base.packets.begin());
  ASSERT_FALSE(a == base.packets.end() && b == candidate.packets.end()) << "the runs are equal";
  // One of the two does there what the other does not.
  const bool of_base = a != base.packets.end() && base.times[place] == apart.base_run.time;
  const bool of_candidate =
      b != candidate.packets.end() && candidate.times[place] == apart.candidate_run.time;
  EXPECT_TRUE(of_base || of_candidate) << apart.difference;
  EXPECT_EQ(apart.base_run.scenario, apart.scenario);
  EXPECT_EQ(apart.candidate_run.scenario.deployment, apart.scenario.deployment);
  EXPECT_EQ(apart.candidate_run.scenario.wireless, apart.scenario.wireless);
  EXPECT_EQ(apart.candidate_run.scenario.dds, apart.candidate);
  EXPECT_TRUE(model::config::is_valid(apart.base_run.scenario));
  EXPECT_TRUE(model::config::is_valid(apart.candidate_run.scenario));
}

struct Change {
  std::string name;
  DdsProfile candidate;
};

/// Every numeric knob that many times as large, and every other choice.
std::vector<Change> single_changes(const DdsProfile& base, const std::vector<double>& factors) {
  Scenario scenario = usual_start();
  scenario.dds = base;
  std::vector<Change> changes;
  const auto add = [&](const std::string& name, const Scenario& changed) {
    if (!model::config::is_valid(changed)) return;
    if (normal_form(changed.dds) != normal_form(base)) changes.push_back({name, changed.dds});
  };
  for (const auto& knob : model::config::numeric_knobs(scenario)) {
    if (!knob.key.starts_with("dds.")) continue;
    for (const double factor : factors) {
      const auto value = static_cast<std::int64_t>(static_cast<double>(knob.value) * factor);
      Scenario changed = scenario;
      if (!model::config::set_numeric_knob(changed, knob.key, value)) continue;
      add(knob.key + " = " + std::to_string(value), changed);
    }
  }
  const std::size_t count = props::knobs_of(scenario, scenario).size();
  for (std::size_t k = 0; k < count; ++k) {
    for (std::int64_t value = 0; value < 4; ++value) {
      Scenario changed = scenario;
      props::Knob knob = props::knobs_of(changed, scenario)[k];
      if (knob.kind != props::Knob::Kind::choice || knob.base > 3) continue;
      knob.set(value);
      add("choice " + std::to_string(k) + " = " + std::to_string(value), changed);
    }
  }
  return changes;
}

void expect_all_told(const DdsProfile& base, const std::vector<double>& factors) {
  const std::vector<Change> changes = single_changes(base, factors);
  EXPECT_GT(changes.size(), 15U);
  for (const Change& change : changes) {
    SCOPED_TRACE(change.name);
    const TellingApart apart = told(base, change.candidate);
    EXPECT_TRUE(apart.found) << apart.how;
    if (!apart.found) continue;
    EXPECT_TRUE(apart.finished);
    EXPECT_LE(apart.scenario.deployment.size(), 3U);
    expect_true(apart);
  }
}

TEST(TellApart, EveryKnobOfThePaperByUpToThreeParticipants) {
  expect_all_told(preset("paper"), {2, 0.5});
}

TEST(TellApart, EveryKnobOfFastDdsByUpToThreeParticipants) {
  expect_all_told(preset("fastdds-2.6.11"), {0.5});
}

TEST(TellApart, EveryTwoPresetsByTwoParticipants) {
  const std::vector<std::string> names{"paper",         "fastdds-2.6.11", "fastdds-2.6.11-sndbuf4M",
                                       "fastdds-2.9.1", "fastdds-2.14.5", "fastdds-3.2"};
  for (const std::string& one : names) {
    for (const std::string& other : names) {
      if (one == other) continue;
      SCOPED_TRACE(one);
      SCOPED_TRACE(other);
      const TellingApart apart = told(preset(one), preset(other));
      ASSERT_TRUE(apart.found) << apart.how;
      EXPECT_EQ(apart.scenario.deployment.size(), 2U);
      expect_true(apart);
    }
  }
}

TEST(TellApart, OneNanosecondIsEnough) {
  const DdsProfile base;
  for (const auto knob :
       {&model::SedpProfile::heartbeat_period, &model::SedpProfile::heartbeat_response_delay,
        &model::SedpProfile::nack_response_delay, &model::SedpProfile::nack_suppression_duration,
        &model::SedpProfile::initial_acknack_delay}) {
    DdsProfile candidate = base;
    candidate.sedp.*knob += Nanoseconds{1};
    const TellingApart apart = told(base, candidate);
    ASSERT_TRUE(apart.found) << apart.how;
    EXPECT_EQ(apart.scenario.deployment.size(), 2U);
    expect_true(apart);
  }
}

TEST(TellApart, SaysWhatOneDoesAndTheOtherDoesNot) {
  DdsProfile slow;
  slow.sedp.heartbeat_response_delay = Nanoseconds{10'000'000};
  const TellingApart apart = told({}, slow);
  EXPECT_EQ(apart.difference,
            "At 6.583343 ms participant 1 sends an ACKNACK to participant 0 (pub) in the base; in "
            "the candidate the next such packet is sent 9.99 ms later, at 16.573343 ms.");
  EXPECT_EQ(apart.base_run.property, "diff.first-difference");
  EXPECT_EQ(apart.base_run.time, Nanoseconds{6'583'343});
  EXPECT_EQ(apart.candidate_run.time, Nanoseconds{16'573'343});
  EXPECT_EQ(apart.event, apart.base_run.event);
  // Turned around, the other one comes first.
  const TellingApart turned = told(slow, {});
  EXPECT_EQ(turned.difference,
            "At 6.583343 ms participant 1 sends an ACKNACK to participant 0 (pub) in the "
            "candidate; in the base the next such packet is sent 9.99 ms later, at 16.573343 ms.");
}

TEST(TellApart, NothingSimplerDoes) {
  DdsProfile candidate;
  candidate.sedp.grouping_limit_bytes = Bytes{32'750};
  const TellingApart apart = told({}, candidate);
  ASSERT_TRUE(apart.found);
  EXPECT_TRUE(apart.finished);
  std::uint64_t events = 0;
  EXPECT_NE(compare_runs(apart.scenario, candidate, 0, events, {}).kind, Parting::Kind::none);
  Scenario fewer = apart.scenario;
  for (model::Participant& p : fewer.deployment.participants) {
    p.publications -= std::min(p.publications, 1U);
    p.subscriptions -= std::min(p.subscriptions, 1U);
  }
  EXPECT_EQ(compare_runs(fewer, candidate, 0, events, {}).kind, Parting::Kind::none);
}

TEST(TellApart, LargeStartsAreShrunk) {
  DdsProfile base;
  base.sedp.grouping_limit_bytes = Bytes{300'000};
  DdsProfile candidate = base;
  candidate.sedp.grouping_limit_bytes = Bytes{310'000};
  Scenario start = usual_start();
  start.deployment = Deployment::homogeneous(2, 2, 3'000);
  start.wireless.kind = model::ServiceKind::constant_delay;
  const TellingApart apart = tell_apart(start, base, candidate, {});
  ASSERT_TRUE(apart.found) << apart.how;
  EXPECT_EQ(apart.scenario.deployment.size(), 2U);
  EXPECT_FALSE(apart.scenario.limits);
  expect_true(apart);
}

TEST(TellApart, UnreadKnobsCannotBeTold) {
  DdsProfile candidate;
  candidate.sedp.adaptive.max_period = Nanoseconds{9'000'000'000};
  candidate.unmodelled["peers"] = "unicast discovery";
  const TellingApart apart = told({}, candidate);
  EXPECT_FALSE(apart.found);
  EXPECT_TRUE(apart.finished);
  EXPECT_EQ(apart.tried, 0U);
  EXPECT_NE(apart.how.find("no rule reads"), std::string::npos);
}

TEST(TellApart, AnInterruptedSearchSaysSo) {
  DdsProfile candidate;
  candidate.sedp.grouping_limit_bytes = Bytes{65'501};
  int asked = 0;
  const TellingApart apart =
      tell_apart(usual_start(), {}, candidate, [&asked] { return ++asked < 50; });
  EXPECT_FALSE(apart.found);
  EXPECT_FALSE(apart.finished);
  EXPECT_GT(apart.tried, 0U);
  EXPECT_LT(apart.tried, 100U);
  EXPECT_NE(apart.how.find("before all of them were tried"), std::string::npos) << apart.how;
}

TEST(FirstDifference, EqualProfilesHaveNone) {
  std::uint64_t events = 0;
  const Parting parting = compare_runs(usual_start(), {}, 0, events, {});
  EXPECT_EQ(parting.kind, Parting::Kind::none);
  EXPECT_TRUE(parting.followed_to_the_end);
  EXPECT_GT(events, 1'000U);
}

TEST(FirstDifference, ATimerThatChangesNoPacketIsInside) {
  // All is acknowledged long before the HEARTBEAT timer expires: it finds nothing to send.
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 1, 0);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.run_until = model::RunUntil::time_limit;
  scenario.time_limit = Nanoseconds{1'500'000'000};
  DdsProfile candidate;
  candidate.sedp.heartbeat_period = Nanoseconds{1'100'000'000};
  std::uint64_t events = 0;
  const Parting parting = compare_runs(scenario, candidate, 0, events, {});
  ASSERT_EQ(parting.kind, Parting::Kind::inside);
  const FirstDifference difference = describe_parting(scenario, candidate, parting);
  EXPECT_EQ(difference.text.rfind("No packet differs; in the base HEARTBEAT expiry", 0), 0U)
      << difference.text;
  EXPECT_EQ(difference.base.event, parting.position);
  // Cut before it, the runs are equal as far as they go.
  const Parting cut = compare_runs(scenario, candidate, 20, events, {});
  EXPECT_EQ(cut.kind, Parting::Kind::none);
  EXPECT_FALSE(cut.followed_to_the_end);
}

}  // namespace telling_apart_test
}  // namespace stormproof::diff
