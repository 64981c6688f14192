// Where the parser of Fast DDS (XMLParser.cpp, XMLElementParser.cpp, XMLProfileManager.cpp) does
// something else than one would expect: which profiles it keeps, what it refuses, what it ignores.
#include "tests/model/config/vendor/fastdds_document.hpp"

namespace stormproof::model::config::vendor {
namespace fastdds_parser_test {

std::string participant(const std::string& name, const std::string& seconds) {
  return fmt::format(
      "<participant profile_name='{}' is_default_profile='true'><rtps><builtin><discovery_config>"
      "<leaseAnnouncement><sec>{}</sec></leaseAnnouncement>"
      "</discovery_config></builtin></rtps></participant>\n",
      name, seconds);
}

std::string period(const std::string& text) {
  const std::string shown = change(profile_of(text), "spdp", "period");
  return shown.substr(0, shown.find(' '));
}

std::vector<std::string> remarks_of(const std::string& text) { return remarks(profile_of(text)); }

using Remarks = std::vector<std::string>;

std::string properties(const std::string& inside) {
  return document("<propertiesPolicy>" + inside + "</propertiesPolicy>");
}

TEST(FastddsParser, only_the_first_profiles_are_kept) {
  const std::string later = "<dds><profiles>\n" + participant("a", "5") +
                            "</profiles><profiles>\n" + participant("b", "7") + "</profiles></dds>";
  EXPECT_EQ(period(later), "5s");
  EXPECT_EQ(remarks_of(later), Remarks{"warning fastdds.forgotten-profile 4:1"});
  const std::string direct = "<dds>\n" + participant("a", "5") + "</dds>";
  EXPECT_EQ(period(direct), "unchanged");
  EXPECT_EQ(remarks_of(direct), (Remarks{"warning fastdds.no-participant 1:1",
                                         "warning fastdds.forgotten-profile 2:1"}));
  EXPECT_EQ(error_of(direct, {"a", ""}),
            "f.xml:1:1: no participant profile 'a'; expected a file that has one");
  const std::string own = "<profiles>\n" + participant("a", "5") + "</profiles>";
  EXPECT_EQ(remarks_of(own), Remarks{});
}

TEST(FastddsParser, the_first_profile_of_a_name_is_kept_and_the_last_default) {
  const auto both = [](const std::string& second) {
    return "<profiles>\n" + participant("a", "5") + participant(second, "7") + "</profiles>";
  };
  EXPECT_EQ(period(both("a")), "5s");
  EXPECT_EQ(remarks_of(both("a")), Remarks{"error fastdds.repeated-profile 3:1"});
  EXPECT_EQ(period(both("b")), "7s");
  EXPECT_EQ(remarks_of(both("b")),
            (Remarks{"note fastdds.other-profile 2:1", "warning fastdds.several-defaults 3:1"}));
  EXPECT_EQ(period(both("")), "5s");
  EXPECT_EQ(remarks_of(both("")).front(), "error fastdds.missing-profile-name 3:1");
}

TEST(FastddsParser, another_profile_can_make_it_refuse_the_file) {
  const std::string text =
      "<profiles>\n" + participant("a", "5") +
      "<participant profile_name='b'><rtps>\n<leaseDuration/></rtps></participant></profiles>";
  EXPECT_EQ(remarks_of(text),
            (Remarks{"note fastdds.other-profile 3:1", "error fastdds.misplaced-element 4:1"}));
}

TEST(FastddsParser, a_log_stands_in_dds_only) {
  EXPECT_EQ(remarks_of(document("", "<log/>")), Remarks{"error fastdds.unknown-element 2:1"});
  EXPECT_EQ(remarks_of("<dds><log/><profiles>" + participant("a", "5") + "</profiles></dds>"),
            Remarks{});
}

TEST(FastddsParser, library_settings_need_their_one_element) {
  EXPECT_EQ(remarks_of(document("", "<library_settings/>")),
            Remarks{"error fastdds.library-settings 2:1"});
  const auto with = [](const std::string& word) {
    return document("", "<library_settings><intraprocess_delivery>" + word +
                            "</intraprocess_delivery></library_settings>");
  };
  EXPECT_EQ(error_of(with("OFF")), "accepted");
  EXPECT_EQ(error_of(with("off")),
            "f.xml:2:42: 'off' in <intraprocess_delivery>; expected OFF, USER_DATA_ONLY or FULL");
}

TEST(FastddsParser, properties_have_at_least_one_with_text) {
  EXPECT_EQ(error_of(properties("<properties/>")),
            "f.xml:4:19: no <property> in <properties>; expected one at least, or leave it out");
  EXPECT_EQ(error_of(properties("<binary_properties/>")),
            "f.xml:4:19: no <property> in <binary_properties>; expected one at least, or leave it "
            "out");
  EXPECT_EQ(error_of(properties("<properties><property><name>a</name><value/></property>"
                                "</properties>")),
            "f.xml:4:55: nothing in <value>; expected text, or leave <value> out");
  EXPECT_EQ(error_of(properties("<properties><property><name>a</name></property></properties>")),
            "accepted");
}

TEST(FastddsParser, flags_are_separated_by_bars_or_blanks) {
  const auto shown = [](const std::string& flags) {
    return setting(profile_of(
                       discovery("<ignoreParticipantFlags>" + flags + "</ignoreParticipantFlags>")),
                   "rtps/builtin/discovery_config/ignoreParticipantFlags")
        .value;
  };
  const std::string both = "FILTER_DIFFERENT_PROCESS | FILTER_SAME_PROCESS";
  EXPECT_EQ(shown(both), both);
  EXPECT_EQ(shown("FILTER_DIFFERENT_PROCESS FILTER_SAME_PROCESS"), both);
  EXPECT_EQ(shown("FILTER_DIFFERENT_PROCESS||FILTER_SAME_PROCESS|"), both);
  EXPECT_NE(error_of(discovery("<ignoreParticipantFlags/>")), "accepted");
}

TEST(FastddsParser, a_white_list_names_interfaces_since_2_14) {
  const std::string text = document(
      only("t"),
      transport("t", "UDPv4",
                "<interfaceWhiteList>\n<interface>wlan0</interface></interfaceWhiteList>"));
  EXPECT_EQ(remarks_of(text), Remarks{"error fastdds.later-version 3:1"});
  const VendorProfile later = profile_of(text, {"", "fastdds-2.14.5"});
  EXPECT_EQ(remarks(later), Remarks{});
  EXPECT_EQ(setting(later, "transport_descriptor[t]/interfaceWhiteList").value, "wlan0");
  const std::string other = document(
      only("t"),
      transport("t", "UDPv4", "<interfaceWhiteList>\n<ip>10.0.0.1</ip></interfaceWhiteList>"));
  EXPECT_EQ(remarks_of(other), Remarks{"error fastdds.unknown-element 3:1"});
}

TEST(FastddsParser, shared_memory_has_limits_of_its_own) {
  const auto shm = [](const std::string& rest) {
    return document("<userTransports><transport_id>t</transport_id></userTransports>",
                    transport("t", "SHM", rest));
  };
  EXPECT_EQ(remarks_of(shm("<maxMessageSize>524288</maxMessageSize>"
                           "<segment_size>1048576</segment_size>")),
            Remarks{});
  EXPECT_EQ(remarks_of(shm("<maxMessageSize>524289</maxMessageSize>")),
            Remarks{"error fastdds.message-size 2:108"});
  EXPECT_EQ(remarks_of(shm("<maxMessageSize>524289</maxMessageSize>"
                           "<segment_size>524288</segment_size>")),
            Remarks{"error fastdds.buffer-below-message 2:145"});
}

TEST(FastddsParser, external_addresses_of_the_participant_came_with_2_10) {
  const std::string text = document("<builtin><metatraffic_external_unicast_locators/></builtin>");
  EXPECT_EQ(remarks_of(text), Remarks{"error fastdds.later-version 4:10"});
  EXPECT_EQ(remarks(profile_of(text, {"", "fastdds-2.14.5"})), Remarks{});
}

TEST(FastddsParser, a_setting_without_effect_has_no_knob) {
  const std::string text = document(
      "<userTransports><transport_id>t</transport_id></userTransports>"
      "<sendSocketBufferSize>70000</sendSocketBufferSize>",
      transport("t", "UDPv4", "<sendBufferSize>200000</sendBufferSize>"));
  const VendorProfile profile = profile_of(text);
  EXPECT_EQ(setting(profile, "rtps/sendSocketBufferSize").knob, "sedp.piggyback_threshold_bytes");
  for (const Setting& one : profile.settings) {
    EXPECT_EQ(one.knob.empty(), one.effect != Effect::knob) << one.path;
  }
}

}  // namespace fastdds_parser_test
}  // namespace stormproof::model::config::vendor
