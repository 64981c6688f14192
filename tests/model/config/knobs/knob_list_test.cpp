// The list of knobs is complete, has no duplicates, and its keys are those that `--set` takes.
#include "tests/model/config/knobs/knob_list.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace knob_list_test {

TEST(KnobList, every_knob_is_there_once_with_its_documentation) {
  std::set<std::string> keys;
  for (const KnobInfo& knob : scenario_knob_list()) {
    EXPECT_TRUE(keys.insert(knob.key).second) << knob.key;
    EXPECT_FALSE(knob.doc.empty()) << knob.key;
    const auto says = [&](const char* words) {
      return knob.expected.find(words) != std::string::npos;
    };
    EXPECT_TRUE(says(" from ") || says(" at most ") || says("one of ") || says("text")) << knob.key;
  }
  for (const char* key :
       {"time_limit", "deployment.hosts", "deployment.participants.*.start",
        "deployment.participants.*.endpoints_done", "deployment.loopback_delay",
        "deployment.schedule.start", "deployment.schedule.seed", "dds.implementation",
        "dds.sedp.heartbeat_period", "dds.sedp.adaptive.epsilon", "dds.descriptors.default_bytes",
        "wireless.source_queue_bytes", "wireless.stages.*.rate_multicast", "run_until",
        "wireless.packet_delays.*.leaves_after"}) {
    EXPECT_TRUE(keys.contains(key)) << key;
  }
}

/// The keys of `one` that the other implementation has not.
std::set<std::string> keys_beyond(ImplementationKind one, ImplementationKind other) {
  const auto own = scenario_knob_list(one);
  const auto others = scenario_knob_list(other);
  EXPECT_EQ(own.size(), others.size());
  std::set<std::string> keys;
  for (std::size_t k = 0; k < own.size(); ++k) {
    EXPECT_EQ(own[k].key, others[k].key);
    const bool has = own[k].presence != Presence::of_others;
    if (has && others[k].presence == Presence::of_others) keys.insert(own[k].key);
  }
  return keys;
}

TEST(KnobList, cyclone_dds_has_the_settings_of_its_configuration) {
  const std::set<std::string> own{"dds.allow_multicast",
                                  "dds.peers",
                                  "dds.spdp.initial_prune_delay",
                                  "dds.spdp.discovered_prune_delay",
                                  "dds.spdp.directed_replies",
                                  "dds.spdp.directed_reply_interval",
                                  "dds.sedp.heartbeat_interval",
                                  "dds.sedp.heartbeat_interval_max",
                                  "dds.sedp.match_heartbeat_delay",
                                  "dds.sedp.ack_delay",
                                  "dds.sedp.nack_delay",
                                  "dds.sedp.auto_resched_nack_delay",
                                  "dds.sedp.preemptive_ack_delay",
                                  "dds.sedp.max_message_size",
                                  "dds.sedp.max_rexmit_message_size",
                                  "dds.sedp.max_queued_rexmit_messages",
                                  "dds.sedp.merge_queued_rexmit",
                                  "dds.sedp.notification"};
  EXPECT_EQ(keys_beyond(ImplementationKind::cyclone, ImplementationKind::fastdds), own);
  std::set<std::string> of_programs = own;  // with what the paper's model knows nothing of
  of_programs.insert({"dds.max_participants_per_host", "dds.spdp.lease"});
  EXPECT_EQ(keys_beyond(ImplementationKind::cyclone, ImplementationKind::paper), of_programs);
  std::set<std::string> sections;
  for (const KnobInfo& knob : scenario_knob_list(ImplementationKind::cyclone)) {
    if (knob.presence != Presence::of_others) sections.insert(knob.key);
  }
  EXPECT_TRUE(sections.contains("dds.spdp.period"));
  EXPECT_TRUE(sections.contains("dds.spdp.startup_period"));
  EXPECT_FALSE(sections.contains("dds.spdp.resend"));
}

TEST(KnobList, fast_dds_has_the_same_list_with_the_keys_of_the_paper_marked) {
  auto of_paper = keys_beyond(ImplementationKind::paper, ImplementationKind::fastdds);
  const auto is_amendment = [](const std::string& key) {
    return key.starts_with("dds.amendments.");
  };
  EXPECT_GT(std::erase_if(of_paper, is_amendment), 0U);
  EXPECT_EQ(
      keys_beyond(ImplementationKind::fastdds, ImplementationKind::paper),
      (std::set<std::string>{
          "dds.discovery", "dds.max_participants_per_host", "dds.spdp.lease", "dds.match_order",
          "dds.builtin_response_delay", "dds.type_lookup", "dds.typelookup_heartbeat_period",
          "dds.typelookup_filter", "dds.typelookup_unit", "dds.type_object_bytes", "dds.sizes",
          "dds.descriptor_extra_bytes", "dds.statistics_bytes", "dds.max_data_per_message"}));
  EXPECT_EQ(of_paper,
            (std::set<std::string>{
                "dds.spdp.payload_bytes", "dds.sedp.relation_opening", "dds.sedp.initial_data",
                "dds.sedp.unmatched", "dds.sedp.initial_acknack", "dds.sedp.acknowledge",
                "dds.sedp.heartbeat_timer", "dds.sedp.heartbeat_recipients", "dds.sedp.grouping",
                "dds.sedp.heartbeat_bytes", "dds.sedp.acknack_bytes",
                "dds.sedp.piggyback_heartbeat_bytes", "dds.sedp.shared_header_bytes",
                "dds.descriptors.default_publications", "dds.descriptors.default_subscriptions",
                "dds.descriptors.default_bytes", "dds.descriptors.user_bytes"}));
}

TEST(KnobList, the_keys_of_others_are_refused_with_fast_dds) {
  for (const KnobInfo& knob : scenario_knob_list(ImplementationKind::fastdds)) {
    if (!knob.key.starts_with("dds.") || knob.default_value.is_null()) continue;
    const std::vector<std::string> overrides{knob.key + "=" + knob.default_value.dump()};
    const auto scenario = read_scenario("live-5x20", overrides, source_specs());
    if (knob.presence != Presence::of_others) {
      EXPECT_TRUE(scenario) << to_string(scenario.error());
      continue;
    }
    ASSERT_FALSE(scenario) << knob.key;
    EXPECT_EQ(scenario.error().where, "--set " + overrides[0]);
    const bool of_paper = scenario.error().message.find(
                              "only implementation: paper has this key") != std::string::npos;
    const bool of_cyclone = scenario.error().message.find(
                                "only implementation: cyclone has this key") != std::string::npos;
    const bool of_discovery =
        scenario.error().message.find("only discovery: ") != std::string::npos;
    EXPECT_TRUE(of_paper || of_cyclone || of_discovery) << scenario.error().message;
  }
}

TEST(KnobList, defaults_ranges_and_choices_can_be_set) {
  for (const KnobInfo& knob : scenario_knob_list()) {
    if (knob.key.starts_with("deployment.") || knob.key == "dds.implementation") continue;
    if (knob.key.starts_with("wireless.packet_delays.")) continue;  // no list to reach into
    // Tables that may be absent, and have required keys.
    if (knob.key.starts_with("wireless.loss.") || knob.key.starts_with("hosts.")) continue;
    if (knob.presence == Presence::of_others) continue;
    if (knob.key == "wireless.service") continue;  // each has other keys
    const bool needs_receptions = knob.key == "wireless.sender" || knob.key == "wireless.count_at";
    const char* name = needs_receptions ? "live-5x20" : "wifi-5x20";
    std::string key = knob.key;
    if (const auto star = key.find('*'); star != std::string::npos) key.replace(star, 1, "0");
    std::vector<std::string> values = knob.choices;
    if (!knob.default_value.is_null() && !knob.expected.starts_with("text"))
      values.push_back(knob.default_value.dump());
    for (const std::string& value : values) {
      std::vector<std::string> overrides{key + "=" + value};
      // HEARTBEATs that ride in DATA have no number that an ACKNACK could answer.
      if (key == "dds.amendments.stale_acknack") overrides.push_back("dds.sedp.piggyback=off");
      // What Fast DDS has is refused with the paper's writer.
      const bool is_of_fast_dds = key == "dds.sedp.piggyback" && value == "group";
      const auto scenario =
          read_scenario(is_of_fast_dds ? "live-5x20" : name, overrides, source_specs());
      EXPECT_TRUE(scenario) << to_string(scenario.error());
    }
  }
}

}  // namespace knob_list_test
}  // namespace stormproof::model::config
