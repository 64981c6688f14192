// What the settings of a Fast DDS file become: knobs with the places of their text, settings that
// the model has not, systems that it cannot describe; and which values are refused.
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/config/profile_files.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/quantities.hpp"
#include "tests/model/config/test_files.hpp"
#include "tests/model/config/vendor/fastdds_document.hpp"

namespace stormproof::model::config::vendor {
namespace fastdds_xml_test {

TEST(FastddsXml, an_empty_participant_changes_nothing) {
  const VendorProfile profile = profile_of(document(""));
  EXPECT_EQ(profile.vendor, Vendor::fastdds);
  EXPECT_EQ(profile.name, "p");
  EXPECT_EQ(profile.version_base, "fastdds-2.6.11");
  ASSERT_EQ(profile.changes.members.size(), 1U);
  EXPECT_EQ(profile.changes.find("base")->text, "fastdds-2.6.11");
  EXPECT_TRUE(profile.settings.empty());
  EXPECT_TRUE(profile.remarks.empty());
}

TEST(FastddsXml, announcements_become_knobs) {
  const VendorProfile profile = profile_of(
      discovery("<initialAnnouncements><count>7</count>\n<period><sec>1</sec><nanosec>500000000"
                "</nanosec></period></initialAnnouncements>\n<leaseAnnouncement><sec> 2 </sec>"
                "</leaseAnnouncement>"));
  EXPECT_EQ(change(profile, "spdp", "startup_announcements"), "7 at 4:57");
  EXPECT_EQ(change(profile, "spdp", "startup_period"), "1.5s at 5:1");
  EXPECT_EQ(change(profile, "spdp", "period"), "2s at 6:1");
  EXPECT_TRUE(profile.remarks.empty());

  const Setting count =
      setting(profile, "rtps/builtin/discovery_config/initialAnnouncements/count");
  EXPECT_EQ(count.effect, Effect::knob);
  EXPECT_EQ(count.knob, "spdp.startup_announcements");
  EXPECT_EQ(count.value, "7");
  EXPECT_EQ(count.place.to_string(), "f.xml:4:57");
}

/// The list of one server, as 2.x has it.
const std::string one_server =
    "<discoveryServersList><RemoteServer prefix=\"44.53.00.5f.45.50.52.4f.53.49.4d.41\">"
    "<metatrafficUnicastLocatorList><locator><udpv4><address>192.0.2.5</address><port>11811</port>"
    "</udpv4></locator></metatrafficUnicastLocatorList></RemoteServer></discoveryServersList>";

TEST(FastddsXml, clients_of_a_discovery_server_are_described) {
  for (const auto& [word, way] :
       {std::pair{"CLIENT", "server"}, {"SUPER_CLIENT", "super_client"}}) {
    const VendorProfile profile =
        profile_of(discovery("<discoveryProtocol>" + std::string{word} +
                             "</discoveryProtocol><clientAnnouncementPeriod><sec>1</sec>"
                             "</clientAnnouncementPeriod>" +
                             one_server));
    EXPECT_EQ(setting(profile, "rtps/builtin/discovery_config/discoveryProtocol").knob,
              "discovery");
    ASSERT_NE(profile.changes.find("discovery"), nullptr);
    EXPECT_EQ(profile.changes.find("discovery")->text, way);
    ASSERT_NE(profile.changes.find("client_sync_period"), nullptr);
    EXPECT_EQ(profile.changes.find("client_sync_period")->text, "1s");
    for (const std::string& remark : remarks(profile)) {
      EXPECT_EQ(remark.find("error"), std::string::npos) << remark;
    }
  }
}

TEST(FastddsXml, an_infinite_announcement_period_outlasts_every_run) {
  const VendorProfile profile =
      profile_of(discovery("<leaseDuration>DURATION_INFINITY</leaseDuration><leaseAnnouncement>"
                           "<sec>DURATION_INFINITE_SEC</sec></leaseAnnouncement>"));
  EXPECT_EQ(change(profile, "spdp", "period"), "1000000s at 4:76");
  EXPECT_TRUE(profile.remarks.empty());
}

TEST(FastddsXml, a_startup_period_that_is_not_positive_is_one_of_1_ms) {
  for (const std::string sec : {"0", "-1"}) {
    const VendorProfile profile = profile_of(discovery("<initialAnnouncements><period><sec>" + sec +
                                                       "</sec></period></initialAnnouncements>"));
    EXPECT_EQ(change(profile, "spdp", "startup_period"), "1ms at 4:50");
    EXPECT_EQ(remarks(profile), std::vector<std::string>{"warning fastdds.startup-period 4:50"});
  }
}

struct Threshold {
  std::string name, document, change;
};

class SendBuffers : public testing::TestWithParam<Threshold> {};

TEST_P(SendBuffers, the_least_of_the_transports_in_use_is_the_threshold) {
  const VendorProfile profile = profile_of(GetParam().document);
  EXPECT_EQ(change(profile, "sedp", "piggyback_threshold_bytes"), GetParam().change);
}

const std::string four_megabytes = "<sendBufferSize>4000000</sendBufferSize>";

INSTANTIATE_TEST_SUITE_P(
    FastddsXml, SendBuffers,
    testing::Values(
        Threshold{"builtin", document("<sendSocketBufferSize>300000</sendSocketBufferSize>"),
                  "300000 at 4:23"},
        Threshold{"zero_is_the_default", document("<sendSocketBufferSize>0</sendSocketBufferSize>"),
                  "unchanged"},
        Threshold{"udp_alone", document(only("t"), transport("t", "UDPv4", four_megabytes)),
                  "4000000 at 2:110"},
        Threshold{"builtin_beside_it",
                  document("<userTransports><transport_id>t</transport_id></userTransports>",
                           transport("t", "UDPv4", four_megabytes)),
                  "unchanged"},
        Threshold{"both_set",
                  document("<sendSocketBufferSize>5000000</sendSocketBufferSize><userTransports>"
                           "<transport_id>t</transport_id></userTransports>",
                           transport("t", "UDPv4", four_megabytes)),
                  "4000000 at 2:110"},
        Threshold{"participant_without_builtin",
                  document("<sendSocketBufferSize>300000</sendSocketBufferSize>" + only("t"),
                           transport("t", "UDPv4", "")),
                  "unchanged"},
        Threshold{"unused_transport", document("", transport("t", "UDPv4", four_megabytes)),
                  "unchanged"},
        Threshold{"shared_memory_is_less",
                  document("<userTransports><transport_id>u</transport_id><transport_id>s"
                           "</transport_id></userTransports><useBuiltinTransports>false"
                           "</useBuiltinTransports>",
                           transport("u", "UDPv4", four_megabytes) +
                               transport("s", "SHM", "<segment_size>70000</segment_size>")),
                  "70000 at 2:286"},
        Threshold{"default_of_shared_memory_is_less",
                  document("<userTransports><transport_id>u</transport_id><transport_id>s"
                           "</transport_id></userTransports><useBuiltinTransports>false"
                           "</useBuiltinTransports>",
                           transport("u", "UDPv4", four_megabytes) + transport("s", "SHM", "")),
                  "unchanged"}),
    [](const auto& one) { return one.param.name; });

TEST(FastddsXml, the_least_message_size_is_the_limit) {
  const std::string property =
      "<propertiesPolicy><properties><property><name>fastdds.max_message_size</name><value>1472"
      "</value></property></properties></propertiesPolicy>";
  EXPECT_EQ(change(profile_of(document(property)), "sedp", "grouping_limit_bytes"), "1472 at 4:85");
  EXPECT_EQ(
      change(profile_of(document(property + only("t"),
                                 transport("t", "UDPv4", "<maxMessageSize>1400</maxMessageSize>"))),
             "sedp", "grouping_limit_bytes"),
      "1400 at 2:110");
  EXPECT_EQ(
      change(profile_of(document(property + only("t"),
                                 transport("t", "UDPv4", "<maxMessageSize>9000</maxMessageSize>"))),
             "sedp", "grouping_limit_bytes"),
      "1472 at 4:85");
}

const std::string peers =
    "<initialPeersList><locator><udpv4><address>10.0.0.2</address><port>7412</port></udpv4>"
    "</locator></initialPeersList>";

TEST(FastddsXml, hosts_without_ports_are_static_peers) {
  const std::string hosts =
      "<initialPeersList><locator><udpv4><address>10.0.0.2</address></udpv4></locator>"
      "</initialPeersList>";
  const VendorProfile usual = profile_of(document("<builtin>" + hosts + "</builtin>"));
  ASSERT_NE(usual.changes.find("discovery"), nullptr);
  EXPECT_EQ(usual.changes.find("discovery")->text, "static");
  EXPECT_EQ(usual.changes.find("peer_ports"), nullptr);
  const VendorProfile more = profile_of(
      document("<builtin>" + hosts + "</builtin>" + only("t"),
               transport("t", "UDPv4", "<maxInitialPeersRange>32</maxInitialPeersRange>")));
  ASSERT_NE(more.changes.find("peer_ports"), nullptr);
  EXPECT_EQ(more.changes.find("peer_ports")->text, "32");
  EXPECT_EQ(more.changes.find("unmodelled"), nullptr);
}

TEST(FastddsXml, a_server_beside_its_clients_says_how_often_it_looks) {
  const auto participant = [](const char* name, const char* protocol, const char* more) {
    return fmt::format(
        "<participant profile_name='{}'{}><rtps><builtin><discovery_config><discoveryProtocol>{}"
        "</discoveryProtocol><clientAnnouncementPeriod><nanosec>50000000</nanosec>"
        "</clientAnnouncementPeriod>{}</discovery_config></builtin></rtps></participant>",
        name, more, protocol, one_server);
  };
  const VendorProfile profile =
      profile_of("<profiles>" + participant("s", "SERVER", "") +
                 participant("c", "CLIENT", " is_default_profile='true'") + "</profiles>");
  EXPECT_EQ(profile.changes.find("discovery")->text, "server");
  EXPECT_EQ(profile.changes.find("client_sync_period")->text, "50ms");
  ASSERT_NE(profile.changes.find("server_routine_period"), nullptr);
  EXPECT_EQ(profile.changes.find("server_routine_period")->text, "50ms");
}

TEST(FastddsXml, what_the_model_has_not_is_listed_with_its_value) {
  const VendorProfile profile = profile_of(document("<builtin>\n" + peers + "</builtin>"));
  const Node* unmodelled = profile.changes.find("unmodelled");
  ASSERT_NE(unmodelled, nullptr);
  const Node* text = unmodelled->find("initialPeersList");
  ASSERT_NE(text, nullptr);
  EXPECT_TRUE(text->text.starts_with("udpv4 10.0.0.2:7412: announcements go to these addresses"));
  EXPECT_EQ(text->place.to_string(), "f.xml:5:1");
}

TEST(FastddsXml, the_profile_is_chosen_by_name_default_or_number) {
  const auto participant = [](const std::string& name, const std::string& rest) {
    return fmt::format(
        "<participant profile_name='{}'{}><rtps><builtin><discovery_config><leaseAnnouncement>"
        "<sec>{}</sec></leaseAnnouncement></discovery_config></builtin></rtps></participant>\n",
        name, rest, name.size());
  };
  const std::string both = "<profiles>\n" + participant("a", "") +
                           participant("bb", " is_default_profile='true'") + "</profiles>";
  EXPECT_EQ(profile_of(both).name, "bb");
  EXPECT_EQ(change(profile_of(both), "spdp", "period"), "2s at 3:91");
  EXPECT_EQ(profile_of(both, {.profile = "a", .base = ""}).name, "a");
  EXPECT_EQ(error_of(both, {.profile = "b", .base = ""}),
            "f.xml:1:1: no participant profile 'b'; did you mean 'bb'?; expected one of 'a' (line "
            "2), 'bb' (line 3)");
  EXPECT_EQ(error_of("<profiles>\n" + participant("a", "") + participant("bb", "") + "</profiles>"),
            "f.xml:3:1: several participant profiles and none with is_default_profile=\"true\"; "
            "expected the name of one of 'a' (line 2), 'bb' (line 3)");
  EXPECT_EQ(profile_of("<dds><profiles>" + participant("a", "") + "</profiles></dds>").name, "a");
}

TEST(FastddsXml, other_roots_are_refused) {
  EXPECT_EQ(error_of("<types/>"),
            "f.xml:1:1: root element <types>; expected <dds>, <profiles> or <participant> of Fast "
            "DDS, or <CycloneDDS>");
}

TEST(FastddsXml, a_later_base_knows_later_elements) {
  const std::string text =
      document("<ignore_non_matching_locators>false</ignore_non_matching_locators>");
  EXPECT_EQ(remarks(profile_of(text)), std::vector<std::string>{"error fastdds.later-version 4:1"});
  const VendorProfile later = profile_of(text, {.profile = "", .base = "fastdds-2.14.5"});
  EXPECT_TRUE(later.remarks.empty());
  EXPECT_EQ(later.version_base, "fastdds-2.14.5");
  EXPECT_EQ(later.changes.find("base")->text, "fastdds-2.14.5");
}

TEST(FastddsXml, who_does_not_propagate_types_does_not_look_them_up) {
  const auto text = [](const std::string& value) {
    return document(
        "<propertiesPolicy><properties><property><name>fastdds.type_propagation</name>"
        "<value>" +
        value + "</value></property></properties></propertiesPolicy>");
  };
  const Selection of_3{.profile = "", .base = "fastdds-3.2"};
  for (const std::string off : {"disabled", "registration_only"}) {
    EXPECT_EQ(profile_of(text(off), of_3).changes.find("type_lookup")->text, "false") << off;
  }
  EXPECT_EQ(profile_of(text("enabled"), of_3).changes.find("type_lookup")->text, "true");
  EXPECT_EQ(profile_of(text("disabled")).changes.find("type_lookup"), nullptr);
  EXPECT_NE(error_of(text("off"), of_3).find("expected disabled, enabled"), std::string::npos);
}

TEST(FastddsXml, a_version_reads_the_properties_that_it_has) {
  const std::string text = document(
      "<propertiesPolicy><properties>"
      "<property><name>fastdds.type_propagation</name><value>disabled</value></property>"
      "<property><name>fastdds.serialize_optional_qos</name><value>true</value></property>"
      "</properties></propertiesPolicy>");
  const VendorProfile before = profile_of(text);
  ASSERT_EQ(before.remarks.size(), 2U);
  EXPECT_EQ(before.remarks.front().message,
            "property 'fastdds.type_propagation' is not read by Fast DDS 2.6; it is there since "
            "3.0");
  const VendorProfile later = profile_of(text, {.profile = "", .base = "fastdds-3.6"});
  EXPECT_TRUE(later.remarks.empty());
  EXPECT_EQ(later.changes.find("type_lookup")->text, "false");
}

TEST(FastddsXml, builtin_writers_have_a_flow_controller_since_3_2) {
  const std::string text =
      document("<builtin><flow_controller_name>slow</flow_controller_name></builtin>");
  EXPECT_EQ(remarks(profile_of(text, {.profile = "", .base = "fastdds-2.14.5"})),
            std::vector<std::string>{"error fastdds.later-version 4:10"});
  const VendorProfile later = profile_of(text, {.profile = "", .base = "fastdds-3.2"});
  EXPECT_TRUE(later.remarks.empty());
}

/// Before 3.0 a server has a prefix, since then it is known by its address.
TEST(FastddsXml, each_version_lists_servers_in_its_own_way) {
  const auto client = [](const std::string& server) {
    return document(
        "<builtin><discovery_config><discoveryProtocol>CLIENT</discoveryProtocol>"
        "<discoveryServersList>" +
        server + "</discoveryServersList></discovery_config></builtin>");
  };
  const std::string locator =
      "<locator><udpv4><address>192.0.2.5</address><port>11811</port></udpv4></locator>";
  const std::string remote =
      "<RemoteServer prefix=\"44.53.00.5f.45.50.52.4f.53.49.4d.41\">"
      "<metatrafficUnicastLocatorList>" +
      locator + "</metatrafficUnicastLocatorList></RemoteServer>";
  const Selection of_2{.profile = "", .base = "fastdds-2.14.5"};
  const Selection of_3{.profile = "", .base = "fastdds-3.2"};
  EXPECT_TRUE(profile_of(client(remote), of_2).remarks.empty());
  EXPECT_TRUE(profile_of(client(locator), of_3).remarks.empty());
  EXPECT_EQ(remarks(profile_of(client(locator), of_2)).front().substr(0, 27),
            "error fastdds.later-version");
  EXPECT_EQ(remarks(profile_of(client(remote), of_3)).front().substr(0, 29),
            "error fastdds.earlier-version");
}

/// A client without the address of a server finds nobody; so do those of one that the model has
/// not.
TEST(FastddsXml, clients_need_a_server_that_can_be_reached) {
  const auto found = [](const std::string& servers, const std::string& base = "fastdds-2.6.11") {
    return fmt::format(
        "{}", fmt::join(remarks(profile_of(
                            discovery("<discoveryProtocol>CLIENT</discoveryProtocol>" + servers),
                            {.profile = "", .base = base})),
                        ", "));
  };
  const auto locator = [](const std::string& inside) {
    return "<discoveryServersList><locator>" + inside + "</locator></discoveryServersList>";
  };
  const std::string outside = "error fastdds.outside";
  EXPECT_EQ(found(one_server), "");
  EXPECT_NE(found("").find(outside), std::string::npos);
  EXPECT_NE(found("<discoveryServersList/>").find(outside), std::string::npos);
  EXPECT_NE(found("", "fastdds-3.6").find(outside), std::string::npos);
  const std::string udp = "<udpv4><address>192.0.2.5</address><port>11811</port></udpv4>";
  EXPECT_EQ(found(locator(udp), "fastdds-3.6"), "");
  EXPECT_NE(found(locator("<udpv4><port>11811</port></udpv4>"), "fastdds-3.6").find(outside),
            std::string::npos);
  EXPECT_NE(
      found(locator("<tcpv4><address>192.0.2.5</address></tcpv4>"), "fastdds-3.6").find(outside),
      std::string::npos);
  EXPECT_NE(found(locator("<udpv4><address>[IP_ADDRESS]</address></udpv4>"), "fastdds-3.6")
                .find("error fastdds.address"),
            std::string::npos);
  EXPECT_NE(found("<discoveryServersList><RemoteServer/></discoveryServersList>")
                .find("error fastdds.remote-server"),
            std::string::npos);
  const std::string super = discovery("<discoveryProtocol>SUPER_CLIENT</discoveryProtocol>");
  EXPECT_NE(fmt::format("{}", fmt::join(remarks(profile_of(super)), ", ")).find(outside),
            std::string::npos);
}

/// Since 3.5 every client is told everything (Fast DDS #6272).
TEST(FastddsXml, every_client_is_a_super_client_since_3_5) {
  const std::string text = discovery(
      "<discoveryProtocol>CLIENT</discoveryProtocol><discoveryServersList><locator><udpv4><address>"
      "192.0.2.5</address></udpv4></locator></discoveryServersList>");
  const auto way = [&](const char* base) {
    return profile_of(text, {.profile = "", .base = base}).changes.find("discovery")->text;
  };
  EXPECT_EQ(way("fastdds-3.6"), "super_client");
  EXPECT_EQ(way("fastdds-3.2"), "server");
}

TEST(FastddsXml, addresses_that_are_none_are_refused) {
  const auto found = [](const std::string& address) {
    const std::string peers = "<builtin><initialPeersList><locator><udpv4><address>" + address +
                              "</address></udpv4></locator></initialPeersList></builtin>";
    return fmt::format("{}", fmt::join(remarks(profile_of(document(peers))), ", "));
  };
  for (const char* address : {"", "[IP_ADDRESS]", "192.168.0.x", "ROBOT_IP", "1.2.3", "::one"}) {
    EXPECT_NE(found(address).find("error fastdds.address"), std::string::npos) << address;
  }
  for (const char* address : {"192.0.2.1", "robot", "discovery_server", "zip-code.local"}) {
    EXPECT_EQ(found(address).find("error"), std::string::npos) << address;
  }
}

TEST(FastddsXml, a_lease_and_ports_are_values_of_the_profile) {
  const VendorProfile lease =
      profile_of(discovery("<leaseDuration><sec>300</sec></leaseDuration>"));
  EXPECT_TRUE(change(lease, "spdp", "lease").starts_with("300s"));
  const VendorProfile tries =
      profile_of(document("<builtin><mutation_tries>3</mutation_tries></builtin>"));
  ASSERT_NE(tries.changes.find("max_participants_per_host"), nullptr);
  EXPECT_EQ(tries.changes.find("max_participants_per_host")->text, "4");
}

struct Refused {
  std::string document, error;
};

class RefusedValues : public testing::TestWithParam<Refused> {};

TEST_P(RefusedValues, have_a_place_and_an_expectation) {
  EXPECT_EQ(error_of(GetParam().document), GetParam().error);
}

std::string announcing(const std::string& count) {
  return discovery("<initialAnnouncements><count>" + count + "</count></initialAnnouncements>");
}
std::string leasing(const std::string& duration) {
  return discovery("<leaseAnnouncement>" + duration + "</leaseAnnouncement>");
}

INSTANTIATE_TEST_SUITE_P(
    FastddsXml, RefusedValues,
    testing::Values(
        Refused{announcing("many"), "f.xml:4:57: 'many' in <count>; expected a whole number"},
        Refused{announcing(""), "f.xml:4:50: nothing in <count>; expected a whole number"},
        Refused{announcing("-1"), "f.xml:4:57: '-1' in <count>; expected 0 to 4294967295"},
        Refused{announcing("99999999999999999999"),
                "f.xml:4:57: '99999999999999999999' in <count>; expected 0 to 4294967295"},
        Refused{announcing("1000001"),
                "f.xml:4:57: 1000001 in <count>; expected 1000000 announcements at most"},
        Refused{leasing(""),
                "f.xml:4:28: nothing in <leaseAnnouncement>; expected <sec> and "
                "<nanosec> or DURATION_INFINITY"},
        Refused{leasing("3s"),
                "f.xml:4:47: '3s' in <leaseAnnouncement>; expected <sec> and "
                "<nanosec> or DURATION_INFINITY"},
        Refused{leasing("<ms>3</ms>"),
                "f.xml:4:47: <ms> in <leaseAnnouncement>; expected <sec> and "
                "<nanosec> or DURATION_INFINITY"},
        Refused{leasing("<sec>0</sec>"),
                "f.xml:4:28: 0s in <leaseAnnouncement>; expected more than 0"},
        Refused{leasing("<nanosec>-5</nanosec>"),
                "f.xml:4:56: '-5' in <nanosec>; expected 0 to 4294967295"},
        Refused{discovery("<discoveryProtocol>SIMPEL</discoveryProtocol>"),
                "f.xml:4:47: 'SIMPEL' in <discoveryProtocol>; expected SIMPLE, NONE, CLIENT, "
                "SUPER_CLIENT, SERVER, BACKUP; did you mean 'SIMPLE'?"},
        Refused{document("<useBuiltinTransports>yes</useBuiltinTransports>"),
                "f.xml:4:23: 'yes' in <useBuiltinTransports>; expected true or false"},
        Refused{document("<builtin><initialPeersList><locator><udp/></locator></initialPeersList>"
                         "</builtin>"),
                "f.xml:4:28: <locator>; expected one of <udpv4>, <udpv6>, <tcpv4>, <tcpv6> in it"},
        Refused{document("",
                         "<transport_descriptors><transport_descriptor><type>UDPv4</type>"
                         "</transport_descriptor></transport_descriptors>"),
                "f.xml:2:24: a transport descriptor without <transport_id>"},
        Refused{document("", transport("t", "UDP", "")),
                "f.xml:2:82: 'UDP' in <type>; expected UDPv4, UDPv6, TCPv4, TCPv6, SHM; did you "
                "mean 'UDPv4'?"},
        Refused{document("<userTransports/>"),
                "f.xml:4:1: no <transport_id> in <userTransports>; expected one at least, or leave "
                "it out"},
        Refused{document("<propertiesPolicy><properties><property><value>1</value></property>"
                         "</properties></propertiesPolicy>"),
                "f.xml:4:31: <property> in <properties>; expected <property> with a <name>"}));

TEST(FastddsXml, changes_merge_like_a_profile_file) {
  VendorProfile profile = profile_of(
      document("<builtin><discovery_config><leaseAnnouncement><sec>1</sec></leaseAnnouncement>"
               "</discovery_config>" +
                   peers + "</builtin>" + only("t"),
               transport("t", "UDPv4", four_megabytes + "<maxMessageSize>1472</maxMessageSize>")));
  const auto resolved = resolve_profile(profile.changes, SpecKind::dds, source_specs());
  ASSERT_TRUE(resolved) << to_string(resolved.error());
  EXPECT_EQ(resolved->tree.find("spdp")->find("period")->text, "1s");
  EXPECT_EQ(resolved->tree.find("spdp")->find("startup_period")->text, "100ms");
  EXPECT_EQ(resolved->tree.find("sedp")->find("piggyback_threshold_bytes")->text, "4000000");
  EXPECT_EQ(resolved->tree.find("sedp")->find("grouping_limit_bytes")->text, "1472");
  EXPECT_EQ(resolved->tree.find("unmodelled")->members.size(), 1U);
}

TEST(FastddsXml, the_shipped_examples_are_what_they_say) {
  const auto shipped = [](const std::string& name) {
    const auto root = load_xml(std::string{STORMPROOF_SPECS_DIR} + "/vendor/fastdds/" + name);
    EXPECT_TRUE(root) << (root ? "" : to_string(root.error()));
    const auto profile = read_fastdds_profile(root->roots.front(), {});
    EXPECT_TRUE(profile) << (profile ? "" : to_string(profile.error()));
    return *profile;
  };
  const VendorProfile standard = shipped("humble-default.xml");
  EXPECT_TRUE(standard.remarks.empty());
  EXPECT_EQ(change(standard, "spdp", "period").substr(0, 2), "3s");
  EXPECT_EQ(standard.changes.find("sedp"), nullptr);
  EXPECT_EQ(change(shipped("large-send-buffer.xml"), "sedp", "piggyback_threshold_bytes"),
            "4000000 at 10:25");
  EXPECT_EQ(change(shipped("small-messages.xml"), "sedp", "grouping_limit_bytes"), "1472 at 23:22");
  EXPECT_NE(shipped("initial-peers.xml").changes.find("unmodelled"), nullptr);

  const VendorProfile idle = shipped("without-effect.xml");
  EXPECT_EQ(idle.changes.find("sedp"), nullptr);
  EXPECT_EQ(idle.changes.find("spdp"), nullptr);
  EXPECT_EQ(idle.remarks.size(), 7U);
}

RC_GTEST_PROP(FastddsXml, every_duration_is_read_exactly, ()) {
  const auto sec = *rc::gen::inRange<std::int64_t>(0, 999'999);
  const auto nanosec = *rc::gen::inRange<std::int64_t>(1, 1'000'000'000);
  const VendorProfile profile = profile_of(discovery(fmt::format(
      "<leaseDuration>DURATION_INFINITY</leaseDuration><leaseAnnouncement><sec>{}</sec><nanosec>{}"
      "</nanosec></leaseAnnouncement>",
      sec, nanosec)));
  const std::string text = change(profile, "spdp", "period");
  const auto read = parse_duration(text.substr(0, text.find(' ')));
  RC_ASSERT(read && read->count() == sec * 1'000'000'000 + nanosec);
}

}  // namespace fastdds_xml_test
}  // namespace stormproof::model::config::vendor
