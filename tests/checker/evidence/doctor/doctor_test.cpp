// The diagnosis of every shipped capture against its sidecar and its name, and of captures that
// were made for one symptom.
#include "checker/evidence/doctor/doctor.hpp"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "checker/evidence/doctor/advise.hpp"
#include "checker/presentation/document/render.hpp"
#include "tests/checker/evidence/capture/sidecar.hpp"
#include "tests/checker/evidence/conform/captures.hpp"

namespace stormproof::doctor {
namespace doctor_test {

using conform::testing::shipped;

struct Shown {
  capture::Conversation conversation;
  Report report;
};

Report diagnosed(const capture::Conversation& conversation, bool advise = false) {
  Request request;
  request.advise = advise;
  request.budget = 50;
  auto report = diagnose(conversation, request);
  EXPECT_TRUE(report) << to_string(report.error());
  return *std::move(report);
}

const Cause* find(const Report& report, std::string_view id) {
  const auto found = std::ranges::find(report.causes, id, &Cause::id);
  return found == report.causes.end() ? nullptr : &*found;
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& file : std::filesystem::directory_iterator{STORMPROOF_SPECS_DIR "/captures"}) {
    const std::string name = file.path().filename().string();
    if (name.ends_with(".pcap.xz")) all.push_back(name.substr(0, name.find('.')));
  }
  std::ranges::sort(all);
  return all;
}

TEST(Doctor, KnowsVendorVersionAndStormOfEveryShippedCapture) {
  ASSERT_GT(names().size(), 15U);
  std::size_t storms = 0, others = 0;
  for (const std::string& name : names()) {
    const capture::Conversation conversation = shipped(name);
    const Report report = diagnosed(conversation);
    ASSERT_EQ(report.products.size(), 1U) << name;
    const bool is_fastdds = name.starts_with("fastdds");
    EXPECT_EQ(report.products[0].vendor, is_fastdds ? "Fast DDS" : "Cyclone DDS") << name;
    EXPECT_EQ(report.products[0].version, is_fastdds ? "2.x before 2.12" : "0.10.2") << name;
    EXPECT_EQ(report.missing, 0U) << name;
    EXPECT_TRUE(report.complete()) << name;
    const std::uint64_t sent = report.counting.counts.total() - report.later_announcements;
    std::int64_t last_start_ns = 0;
    for (const capture::Participant& one : conversation.topology.participants) {
      last_start_ns = std::max(last_start_ns, one.first_ns);
    }
    // Shipped captures are cut where their sidecars say that discovery was complete.
    const std::int64_t took_ns = conversation.last_ns - last_start_ns;
    const bool is_storm = sent >= 3 * report.failure_free.total() && took_ns > 1'000'000'000;
    (is_storm ? storms : others) += 1;
    EXPECT_EQ(report.health == Health::storm, is_storm)
        << name << ": " << sent << " of " << report.failure_free.total() << ", " << took_ns;
    EXPECT_EQ(report.health == Health::healthy, report.health != Health::storm) << name;
    if (is_fastdds) {
      const std::string version =
          name.starts_with("fastdds291") ? "fastdds-2.9.1" : "fastdds-2.6.11";
      EXPECT_NE(std::ranges::find(report.presets, version), report.presets.end()) << name;
    }
  }
  EXPECT_GT(storms, 0U);
  EXPECT_GT(others, 0U);
}

TEST(Doctor, NamesWhatMadeTheStorm) {
  const auto piggyback = shipped("fastdds2611_ap150_np6_ne30_r0");
  const Report storm = diagnosed(piggyback);
  EXPECT_EQ(storm.causes.front().id, "piggyback");
  ASSERT_NE(find(storm, "needless_repairs"), nullptr);
  EXPECT_EQ(find(storm, "needless_repairs")->messages, storm.counting.counts.repair_data)
      << "nothing was lost";
  EXPECT_EQ(find(storm, "loss"), nullptr);

  const auto lossy = shipped("fastdds2611_ap150_loss5_np3_ne20_r0");
  const Report with_loss = diagnosed(lossy);
  ASSERT_NE(find(with_loss, "loss"), nullptr);
  EXPECT_GT(find(with_loss, "loss")->messages, 10U);
}

/// The same fleet at once has none.
TEST(Doctor, NamesStartsThatAreSpread) {
  model::Scenario scenario = conform::testing::scenario("fleet-4x2x20");
  const Report spread = diagnosed(conform::testing::simulated(scenario).conversation);
  EXPECT_EQ(spread.health, Health::storm);
  EXPECT_EQ(spread.causes.front().id, "spread_starts");
  const Cause* cause = find(spread, "spread_starts");
  ASSERT_NE(cause, nullptr);
  EXPECT_NE(cause->sentence.find("participants announced themselves when others"),
            std::string::npos)
      << cause->sentence;
  EXPECT_NE(cause->sentence.find("the last one 700.0 ms after the first"), std::string::npos)
      << cause->sentence;
  const Cause* others = find(spread, "piggyback");
  EXPECT_LE(cause->messages + (others == nullptr ? 0 : others->messages),
            spread.counting.counts.heartbeat)
      << "a HEARTBEAT has one cause";
  for (model::Participant& one : scenario.deployment.participants) {
    one.endpoints_done -= one.start;
    one.start = {};
  }
  const Report at_once = diagnosed(conform::testing::simulated(scenario).conversation);
  EXPECT_EQ(find(at_once, "spread_starts"), nullptr);
  EXPECT_NE(find(at_once, "piggyback"), nullptr);
}

TEST(Doctor, AHealthyDiscoveryHasNothingToChange) {
  const auto conversation = shipped("fastdds2611_ap150_np1_ne2_r0");
  const Report report = diagnosed(conversation, true);
  EXPECT_EQ(report.health, Health::healthy);
  EXPECT_TRUE(report.advice.empty());
  EXPECT_EQ(report.no_advice, "nothing has to change");
}

TEST(Doctor, AdvisesFilesThatShortenDiscovery) {
  const auto conversation = shipped("fastdds2611_ap150_np3_ne30_r0");
  const Report report = diagnosed(conversation, true);
  EXPECT_EQ(report.health, Health::healthy) << "over after half a second";
  EXPECT_TRUE(report.amplified);
  ASSERT_FALSE(report.advice.empty()) << report.no_advice;
  ASSERT_TRUE(report.basis);
  for (const Advice& one : report.advice) {
    ASSERT_TRUE(one.after.completion_ns && one.before.completion_ns);
    EXPECT_LT(*one.after.completion_ns, *one.before.completion_ns) << one.settings;
    EXPECT_NE(one.xml.find("<participant"), std::string::npos) << one.xml;
  }
}

/// Two participants, each with twelve types that the other one does not have.
TEST(Doctor, SaysThatLookupsPrevailAndHowToSwitchThemOff) {
  const auto conversation = shipped("fastdds-3/fastdds362_ap150_simple_xtypes_unknown_np1_ne2_r1");
  const Report report = diagnosed(conversation, true);
  EXPECT_EQ(report.health, Health::healthy) << "over after 145 ms";
  EXPECT_TRUE(report.lookups_prevail);
  EXPECT_FALSE(report.lookup_storm());
  EXPECT_TRUE(report.types.can_be_looked_up);
  EXPECT_EQ(report.types.most_of_a_participant, 12U);
  // 4 N (N - 1) U N_P
  EXPECT_EQ(report.types.lookups, 4U * 2 * 1 * 12 * 1);
  EXPECT_EQ(report.counting.counts.lookup, report.types.lookups);
  ASSERT_NE(find(report, "type_lookups"), nullptr);
  EXPECT_EQ(find(report, "type_lookups")->messages, 104U);
  ASSERT_TRUE(report.without_lookups);
  const Advice& without = *report.without_lookups;
  ASSERT_TRUE(without.before.completion_ns && without.after.completion_ns);
  EXPECT_LT(*without.after.completion_ns, *without.before.completion_ns);
  EXPECT_LE(*without.after.messages + 96, *without.before.messages);
}

/// The same twenty times as slow is a storm, which it would not be without lookups.
TEST(Doctor, NamesALookupStorm) {
  auto conversation = shipped("fastdds-3/fastdds362_ap150_simple_xtypes_unknown_np1_ne2_r1");
  const auto slow = [first = conversation.first_ns](std::int64_t& time_ns) {
    time_ns = first + (time_ns - first) * 20;
  };
  for (capture::Event& event : conversation.events) slow(event.time_ns);
  for (capture::DatagramRecord& one : conversation.datagrams) slow(one.time_ns);
  slow(conversation.last_ns);
  const Report report = diagnosed(conversation, true);
  EXPECT_EQ(report.health, Health::storm);
  EXPECT_TRUE(report.lookup_storm());
  EXPECT_EQ(report.causes.front().id, "type_lookups");
  ASSERT_TRUE(report.without_lookups);
  EXPECT_NE(report.without_lookups->xml.find("<value>registration_only</value>"), std::string::npos)
      << report.without_lookups->xml;
  EXPECT_NE(report.without_lookups->xml.find("fastdds-3.6"), std::string::npos) << "its version";
  Request request;
  const std::string page = report::to_text(document_of(report, request));
  EXPECT_NE(page.find("LOOKUP STORM"), std::string::npos) << page;
  std::erase_if(conversation.events, [](const capture::Event& event) {
    return event.traffic() == capture::Traffic::type_lookup;
  });
  EXPECT_FALSE(diagnosed(conversation).storm);
}

TEST(Doctor, TypesThatAllKnowAreNoStorm) {
  const auto conversation = shipped("fastdds-3/fastdds362_ap150_simple_xtypes_np3_ne20_r2");
  const Report report = diagnosed(conversation);
  EXPECT_EQ(report.health, Health::healthy);
  EXPECT_FALSE(report.lookups_prevail);
  EXPECT_EQ(report.types.lookups, 0U);
  EXPECT_GT(report.counting.counts.lookup, 0U) << "asked for before they were known";
}

TEST(Doctor, SeesThatHostsSayTheyAreOneMachine) {
  const auto conversation = shipped("fastdds-3/fastdds362_same_machine_id_np2_ne10_r0");
  const Report report = diagnosed(conversation, true);
  EXPECT_EQ(report.health, Health::incomplete);
  ASSERT_EQ(report.machines.size(), 1U);
  EXPECT_EQ(report.machines.front().identity, "3d1219c7c4c5404aaa1f6d2a48adfda4");
  EXPECT_EQ(report.machines.front().hosts, (std::set<std::size_t>{0, 1}));
  EXPECT_EQ(profiles_of(report.products.front()),
            (std::vector<std::string>{"fastdds-3.2", "fastdds-3.6", "fastdds-server-3.2",
                                      "fastdds-server-3.6"}));
  ASSERT_EQ(report.reasons.size(), 1U) << "no firewall is needed to explain it";
  EXPECT_EQ(report.what_keeps_apart(), &report.reasons.front());
  EXPECT_EQ(report.reasons.front().id, "same_machine_id");
  EXPECT_NE(report.reasons.front().sentence.find("10.88.0.1, 10.88.0.2"), std::string::npos);
  EXPECT_NE(document_of(report, {}).answer.plain().find("on one machine"), std::string::npos);
  EXPECT_TRUE(diagnosed(shipped("fastdds-3/fastdds362_ap150_simple_np1_ne2_r0")).machines.empty());
}

/// The events of `conversation` from `first` to `last`.
capture::Conversation cut(capture::Conversation conversation, std::int64_t from_ns,
                          std::int64_t to_ns) {
  std::erase_if(conversation.events, [&](const capture::Event& event) {
    return event.time_ns < from_ns || event.time_ns > to_ns;
  });
  // Counting walks datagrams and their events together.
  std::vector<std::uint32_t> number(conversation.datagrams.size());
  std::deque<capture::DatagramRecord> kept;
  for (std::size_t k = 0; k < conversation.datagrams.size(); ++k) {
    const std::int64_t at = conversation.datagrams[k].time_ns;
    number[k] = static_cast<std::uint32_t>(kept.size());
    if (at >= from_ns && at <= to_ns) kept.push_back(conversation.datagrams[k]);
  }
  for (capture::Event& event : conversation.events) event.datagram = number[event.datagram];
  conversation.datagrams = std::move(kept);
  return conversation;
}

TEST(Doctor, SeesThatACaptureEndsTooEarly) {
  const auto whole = shipped("fastdds2611_ap150_np2_ne20_r0");
  const auto half =
      cut(whole, whole.first_ns, whole.first_ns + (whole.last_ns - whole.first_ns) / 2);
  const Report report = diagnosed(half);
  EXPECT_GT(report.missing, 0U);
  EXPECT_FALSE(report.complete());
  EXPECT_EQ(report.health, Health::incomplete);
}

/// What is sent again and again while something is missing is a storm, and what is missing comes
/// first.
TEST(Doctor, IncompleteComesBeforeStorm) {
  EXPECT_FALSE(diagnosed(shipped("fastdds2611like_pre_ap_np3_ne20_r0")).storm)
      << "over after a fifth of a second";
  std::size_t both = 0;
  for (const std::string& name : names()) {
    const auto whole = shipped(name);
    if (!examine(whole).storm) continue;
    const capture::Counting counting = capture::count(whole, INT64_MAX);
    ASSERT_TRUE(counting.last_initial_ns) << name;
    const auto most = cut(whole, whole.first_ns, *counting.last_initial_ns - 1);
    const Report report = examine(most);
    EXPECT_GT(report.missing, 0U) << name;
    EXPECT_EQ(report.health, Health::incomplete) << name;
    if (report.storm) ++both;
  }
  EXPECT_GT(both, 0U);
}

TEST(Doctor, ACaptureThatBeganTooLateIsNoVerdict) {
  const auto whole = shipped("fastdds2611_ap150_np2_ne20_r0");
  const capture::Counting counting = capture::count(whole, INT64_MAX);
  ASSERT_TRUE(counting.last_initial_ns);
  const Report late = diagnosed(cut(whole, *counting.last_initial_ns - 1'000'000, whole.last_ns));
  EXPECT_EQ(late.health, Health::unknown) << name_of(late.health);
  ASSERT_FALSE(late.reasons.empty());
  EXPECT_EQ(late.reasons.back().id, "began_late");
  EXPECT_FALSE(late.reasons.back().keeps_apart);
  EXPECT_EQ(late.why_unknown, late.reasons.back().sentence);
}

/// A storm is what the user says it is.
TEST(Doctor, HoldsAStormAgainstTheLimitsThatAreGiven) {
  const auto conversation = shipped("fastdds2611_ap150_np6_ne30_r0");
  Request request;
  request.advise = false;
  const auto health_with = [&](const model::Limits& limits) {
    request.limits = limits;
    const auto report = diagnose(conversation, request);
    EXPECT_TRUE(report);
    const std::string text = report::to_text(document_of(*report, request));
    return std::pair{report->health, text};
  };
  EXPECT_EQ(health_with({}).first, Health::storm);
  model::Limits patient;
  patient.late = model::Nanoseconds{1'000'000'000'000};
  EXPECT_EQ(health_with(patient).first, Health::healthy);
  model::Limits generous;
  generous.needless = model::Ratio{1'000, 1};
  EXPECT_EQ(health_with(generous).first, Health::healthy);
  model::Limits strict;
  strict.late = model::Nanoseconds{1'000'000};
  strict.needless = model::Ratio{1, 10};
  const auto [health, text] = health_with(strict);
  EXPECT_EQ(health, Health::storm);
  EXPECT_NE(text.find("1.000 ms"), std::string::npos) << text;
}

TEST(Doctor, KnowsClientsOfADiscoveryServer) {
  const std::string file = std::string{STORMPROOF_SPECS_DIR} +
                           "/captures/discovery-server/fastdds291_ap150_client_np1_ne2_r0.pcap.xz";
  const auto conversation = capture::read_conversation({{file}}, {});
  ASSERT_TRUE(conversation) << to_string(conversation.error());
  const Report report = diagnosed(*conversation, true);
  EXPECT_TRUE(report.has_server);
  EXPECT_NE(report.health, Health::incomplete);
  EXPECT_TRUE(report.advice.empty());
  EXPECT_FALSE(report.no_advice.empty());
  EXPECT_FALSE(diagnosed(shipped("fastdds291_ap_np1_ne2_r0")).has_server);
}

TEST(Doctor, SaysWhoHeardWhom) {
  const std::string file =
      std::string{STORMPROOF_SPECS_DIR} + "/captures/fastdds291_ap_np1_ne2_r0.pcap.xz";
  Request request;
  request.advise = false;
  request.files = {file, file};
  const auto conversation = capture::read_conversation(request.files, {});
  ASSERT_TRUE(conversation);
  const auto report = diagnose(*conversation, request);
  ASSERT_TRUE(report);
  ASSERT_EQ(report->heard.size(), 2U);
  for (const Heard& one : report->heard) {
    ASSERT_EQ(one.hosts.size(), 2U);
    for (const Heard::From& from : one.hosts) {
      EXPECT_GT(from.sent, 0U);
      EXPECT_EQ(from.datagrams, from.sent) << "both captures hold everything";
    }
  }
}

/// `watch` while a storm goes on: a glance counts what the second before it has, and a glance long
/// after it nothing.
TEST(Doctor, AGlanceCountsTheLastSecond) {
  const capture::Conversation conversation = shipped("fastdds2611_ap150_np6_ne30_r0");
  const Report report = examine(conversation);
  EXPECT_EQ(report.health, Health::storm);
  EXPECT_FALSE(report.looked_for_presets);
  const auto last_second = [&](std::int64_t now_ns) {
    const std::string text = to_text(glance_at(report, now_ns));
    const auto row = text.find("\ntotal");
    EXPECT_NE(row, std::string::npos) << text;
    std::string number;
    for (auto at = text.find_first_of("0123456789", row); text[at] != ' '; ++at) {
      if (text[at] != ',') number += text[at];
    }
    return std::stoull(number);
  };
  const std::int64_t now_ns = conversation.first_ns + 600'000'000;
  std::uint64_t expected = 0;
  for (std::size_t k = 0; k < report.counting.classes.size(); ++k) {
    if (report.counting.classes[k] && conversation.events[k].time_ns <= now_ns) ++expected;
  }
  ASSERT_GT(expected, 0U);
  EXPECT_EQ(last_second(now_ns), expected);
  EXPECT_EQ(last_second(conversation.first_ns + 3'600'000'000'000), 0U);
  EXPECT_EQ(to_text(glance_at(report, now_ns)).find("behaves as"), std::string::npos);
}

}  // namespace doctor_test
}  // namespace stormproof::doctor
