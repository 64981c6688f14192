// The law of the XML writer: what it writes, read on top of the same preset, is the profile that it
// was given, for all that a user can set; and nothing else can be written.
#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/vendor/vendor_knobs.hpp"
#include "model/scenario.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config::vendor {
namespace write_xml_test {

DdsProfile preset(const std::string& name) {
  const auto profile = read_dds_profile(name, {}, source_specs());
  EXPECT_TRUE(profile) << to_string(profile.error());
  return profile ? *profile : DdsProfile{};
}

DdsProfile with(DdsProfile profile, std::string_view key, std::int64_t value) {
  Scenario scenario;
  scenario.dds = std::move(profile);
  EXPECT_TRUE(set_numeric_knob(scenario, "dds." + std::string{key}, value)) << key;
  return scenario.dds;
}

std::string write(const std::string& name, const DdsProfile& profile,
                  const std::string& comment = "a test") {
  const auto xml = write_vendor_xml(*vendor_of_preset(name), name, preset(name), profile, comment);
  EXPECT_TRUE(xml) << to_string(xml.error());
  return xml ? *xml : "";
}

std::string refusal(const std::string& name, const DdsProfile& profile) {
  const auto xml = write_vendor_xml(*vendor_of_preset(name), name, preset(name), profile, "");
  EXPECT_FALSE(xml);
  return xml ? "" : to_string(xml.error());
}

/// What `xml` says on top of the preset.
DdsProfile read_back(const std::string& name, const std::string& xml) {
  const TestFiles files{};
  const std::string path = files.write("p.xml", xml);
  auto profile = read_dds_profile(path + "@" + name, {}, source_specs());
  EXPECT_TRUE(profile) << to_string(profile.error()) << "\n" << xml;
  // A longer period of Cyclone DDS needs a longer lease, which nobody asked for.
  if (profile && profile->implementation == ImplementationKind::cyclone) {
    profile->spdp.lease.reset();
  }
  return profile ? *profile : DdsProfile{};
}

const std::vector<std::string> names = {
    "fastdds-2.6.11",          "fastdds-2.14.5",        "fastdds-3.6",
    "fastdds-2.6.11-sndbuf4M", "fastdds-2.9.1",         "cyclonedds-0.10",
    "fastdds-server-2.6.11",   "fastdds-server-2.14.5", "fastdds-static-2.6.11",
    "fastdds-server-3.2",      "fastdds-server-3.6"};

/// Whether a user can set this number of the preset.
bool is_settable(const std::string& name, const VendorKnob& knob) {
  return !knob.setting.empty() && !knob.is_choice() &&
         numeric_knob(preset(name), knob.key).has_value();
}

TEST(WriteXml, both_ends_of_every_range_come_back) {
  for (const std::string& name : names) {
    for (const VendorKnob& knob : vendor_knobs(*vendor_of_preset(name))) {
      if (!is_settable(name, knob)) continue;
      for (const std::int64_t value : {knob.minimum, knob.maximum}) {
        const DdsProfile profile = with(preset(name), knob.key, value);
        const std::string xml = write(name, profile);
        EXPECT_EQ(read_back(name, xml), profile) << name << " " << knob.key << "\n" << xml;
      }
    }
  }
}

/// Any settable knobs, with any values in their ranges.
RC_GTEST_PROP(WriteXml, any_change_of_settable_knobs_comes_back, ()) {
  const std::string name = *rc::gen::elementOf(names);
  DdsProfile profile = preset(name);
  for (const VendorKnob& knob : vendor_knobs(*vendor_of_preset(name))) {
    if (!is_settable(name, knob) || !*rc::gen::arbitrary<bool>()) continue;
    const auto value = *rc::gen::inRange(knob.minimum, knob.maximum + 1);
    profile = with(profile, knob.key, value);
  }
  if (profile.spdp.startup_announcements == 0) {  // then it does nothing, and is not written
    profile.spdp.startup_period = preset(name).spdp.startup_period;
  }
  const std::string xml = write(name, profile);
  RC_LOG() << xml;
  RC_ASSERT(read_back(name, xml) == profile);
}

TEST(WriteXml, a_choice_comes_back) {
  DdsProfile profile = preset("cyclonedds-0.10");
  profile.allow_multicast = AllowMulticast::always;
  const std::string xml = write("cyclonedds-0.10", profile);
  EXPECT_NE(xml.find("<AllowMulticast>true</AllowMulticast>"), std::string::npos);
  DdsProfile read = read_back("cyclonedds-0.10", xml);
  read.unmodelled = profile.unmodelled;  // where the file says what it has chosen
  EXPECT_EQ(read, profile);
}

TEST(WriteXml, whether_types_are_looked_up_comes_back) {
  DdsProfile profile = preset("fastdds-3.6");
  profile.version.type_lookup = Whether::no;
  const std::string xml = write("fastdds-3.6", profile);
  EXPECT_NE(xml.find("<value>registration_only</value>"), std::string::npos) << xml;
  EXPECT_EQ(read_back("fastdds-3.6", xml), profile) << xml;
}

TEST(WriteXml, a_server_of_version_3_has_no_prefix) {
  for (const std::string name : {"fastdds-2.14.5", "fastdds-3.2"}) {
    DdsProfile profile = preset(name);
    profile.discovery = Discovery::server;
    const std::string xml = write(name, profile);
    EXPECT_EQ(xml.find("RemoteServer") == std::string::npos, name == "fastdds-3.2") << xml;
    EXPECT_NE(xml.find("<port>11811</port>"), std::string::npos) << xml;
  }
}

TEST(WriteXml, another_way_to_discover_comes_back) {
  const auto with_way = [](Discovery way) {
    DdsProfile profile = preset("fastdds-2.14.5");
    profile.discovery = way;
    if (way != Discovery::static_peers) {  // of its server
      profile.server.relay = Relay::once;
      profile.server.rejoin = Rejoin::known;
    }
    return profile;
  };
  for (const Discovery way :
       {Discovery::server, Discovery::super_client, Discovery::static_peers}) {
    DdsProfile profile = with_way(way);
    EXPECT_EQ(read_back("fastdds-2.14.5", write("fastdds-2.14.5", profile)), profile);
    profile.server.server_routine_period = Nanoseconds{50'000'000};
    profile.peer_ports = 32;
    const DdsProfile again = read_back("fastdds-2.14.5", write("fastdds-2.14.5", profile));
    const bool is_static = way == Discovery::static_peers;
    EXPECT_EQ(again.peer_ports, is_static ? 32U : 4U);
    EXPECT_EQ(again.server.server_routine_period,
              Nanoseconds{is_static ? 450'000'000 : 50'000'000});
  }
  DdsProfile back = preset("fastdds-server-2.6.11");
  back.discovery = Discovery::simple;
  EXPECT_NE(refusal("fastdds-server-2.6.11", back).find("discovery"), std::string::npos);
}

TEST(WriteXml, no_change_is_an_empty_profile) {
  for (const std::string& name : names) {
    EXPECT_EQ(read_back(name, write(name, preset(name))), preset(name));
  }
}

TEST(WriteXml, nobody_can_set_a_constant) {
  DdsProfile fast = preset("fastdds-2.6.11");
  fast.sedp.nack_suppression_duration = Nanoseconds{10'000'000};
  EXPECT_EQ(refusal("fastdds-2.6.11", fast),
            "XML for fastdds-2.6.11: sedp.nack_suppression_duration \"10ms\": no user of Fast DDS "
            "can set it (constant in the library, EDPSimple.cpp:56)");
  DdsProfile cyclone = preset("cyclonedds-0.10");
  cyclone.sedp.merge_queued_rexmit = MergeQueued::no;
  EXPECT_EQ(refusal("cyclonedds-0.10", cyclone),
            "XML for cyclonedds-0.10: sedp.merge_queued_rexmit false: no user of Cyclone DDS can "
            "set it (rule of the library, q_xmsg.c:808-890)");
  cyclone = preset("cyclonedds-0.10");
  cyclone.unmodelled.clear();
  EXPECT_NE(refusal("cyclonedds-0.10", cyclone).find("unmodelled"), std::string::npos);
}

TEST(WriteXml, every_knob_that_is_not_settable_is_refused) {
  for (const std::string& name : names) {
    Scenario scenario;
    scenario.dds = preset(name);
    for (const NumericKnob& number : numeric_knobs(scenario)) {
      if (!number.key.starts_with("dds.")) continue;
      const auto knobs = vendor_knobs(*vendor_of_preset(name));
      const auto knob = std::ranges::find_if(knobs, [&](const VendorKnob& one) {
        return (number.key + ".").starts_with("dds." + std::string{one.key} + ".");
      });
      ASSERT_NE(knob, knobs.end()) << number.key;
      if (!knob->setting.empty()) continue;
      const DdsProfile changed = with(scenario.dds, number.key.substr(4), number.value + 1);
      EXPECT_NE(refusal(name, changed).find(std::string{knob->key}), std::string::npos)
          << number.key;
    }
  }
}

TEST(WriteXml, a_startup_period_without_announcements_is_refused) {
  DdsProfile profile = preset("fastdds-2.6.11");
  profile.spdp.startup_announcements = 0;
  EXPECT_EQ(read_back("fastdds-2.6.11", write("fastdds-2.6.11", profile)), profile);
  profile.spdp.startup_period = Nanoseconds{1'000'000};
  EXPECT_EQ(refusal("fastdds-2.6.11", profile),
            "XML for fastdds-2.6.11: spdp.startup_period \"1ms\": does nothing without startup "
            "announcements; expected \"100ms\", as the preset has it");
}

TEST(WriteXml, values_out_of_range_are_refused) {
  for (const std::string& name : names) {
    for (const VendorKnob& knob : vendor_knobs(*vendor_of_preset(name))) {
      if (!is_settable(name, knob)) continue;
      const DdsProfile profile = with(preset(name), knob.key, knob.maximum + 1);
      EXPECT_NE(refusal(name, profile).find("expected"), std::string::npos) << knob.key;
    }
  }
}

TEST(WriteXml, the_vendor_has_to_fit_the_preset) {
  const DdsProfile paper;
  EXPECT_FALSE(write_vendor_xml(Vendor::fastdds, "paper", paper, paper, ""));
  EXPECT_FALSE(write_vendor_xml(Vendor::cyclonedds, "fastdds-2.6.11", paper, paper, ""));
}

TEST(WriteXml, a_send_buffer_brings_its_own_transport) {
  const std::string xml =
      write("fastdds-2.6.11",
            with(preset("fastdds-2.6.11"), "sedp.piggyback_threshold_bytes", 4'000'000));
  EXPECT_NE(xml.find("<sendBufferSize>4000000</sendBufferSize>"), std::string::npos);
  EXPECT_NE(xml.find("<useBuiltinTransports>false</useBuiltinTransports>"), std::string::npos);
  EXPECT_NE(xml.find("XMLSchemas/fastRTPS_Profiles"), std::string::npos);
  const std::string other =
      write("fastdds-2.6.11", with(preset("fastdds-2.6.11"), "spdp.period", 5'000'000'000));
  EXPECT_EQ(other.find("useBuiltinTransports"), std::string::npos);
}

TEST(WriteXml, comments_cannot_break_the_document) {
  for (const std::string& comment :
       {std::string{"a -- b"}, std::string{"---"}, std::string{"-->"}, std::string{"x\x01y<&>"}}) {
    EXPECT_EQ(
        read_back("cyclonedds-0.10", write("cyclonedds-0.10", preset("cyclonedds-0.10"), comment)),
        preset("cyclonedds-0.10"));
  }
}

}  // namespace write_xml_test
}  // namespace stormproof::model::config::vendor
