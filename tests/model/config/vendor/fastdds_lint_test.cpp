// Every remark about a Fast DDS file: a document that earns it, with the place, and one beside it
// that does not.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/model/config/vendor/fastdds_document.hpp"

namespace stormproof::model::config::vendor {
namespace fastdds_lint_test {

using Remarks = std::vector<std::string>;

struct Linted {
  std::string name;
  std::string document;
  Remarks remarks;
};
void PrintTo(const Linted& one, std::ostream* out) { *out << one.name; }

class Lint : public testing::TestWithParam<Linted> {};

TEST_P(Lint, says_what_does_not_do_what_it_seems) {
  const VendorProfile profile = profile_of(GetParam().document);
  EXPECT_EQ(remarks(profile), GetParam().remarks);
  for (const Remark& remark : profile.remarks) {
    EXPECT_FALSE(remark.message.empty()) << remark.rule;
    EXPECT_FALSE(remark.hint.starts_with(";")) << remark.hint;
  }
}

std::string property(const std::string& name, const std::string& value) {
  return document("<propertiesPolicy><properties><property><name>" + name + "</name><value>" +
                  value + "</value></property></properties></propertiesPolicy>");
}

std::string endpoints(const std::string& text) {
  return "<profiles><participant profile_name='p' is_default_profile='true'/>\n" + text +
         "</profiles>";
}

std::string udp(const std::string& rest) {
  return document(only("t"), transport("t", "UDPv4", rest));
}

const auto name_of_case = [](const auto& one) { return one.param.name; };

INSTANTIATE_TEST_SUITE_P(
    FastddsDiscovery, Lint,
    testing::Values(
        Linted{"lease_is_not_longer",
               discovery("<leaseDuration><sec>4</sec></leaseDuration>\n<leaseAnnouncement><sec>4"
                         "</sec></leaseAnnouncement>"),
               {"error fastdds.lease-announcement 5:1"}},
        Linted{"lease_is_longer",
               discovery("<leaseDuration><sec>4</sec><nanosec>1</nanosec></leaseDuration>\n"
                         "<leaseAnnouncement><sec>4</sec></leaseAnnouncement>"),
               {}},
        Linted{"lease_below_the_default_period",
               discovery("<leaseDuration><sec>3</sec></leaseDuration>"),
               {"error fastdds.lease-announcement 4:28"}},
        Linted{"period_above_the_default_lease",
               discovery("<leaseAnnouncement><sec>30</sec></leaseAnnouncement>"),
               {"error fastdds.lease-announcement 4:28"}},
        Linted{"unused_startup_period",
               discovery("<initialAnnouncements><count>0</count><period><sec>1</sec></period>"
                         "</initialAnnouncements>"),
               {"note fastdds.unused-startup-period 4:66"}},
        Linted{"server_settings_with_simple",
               discovery("<clientAnnouncementPeriod><sec>1</sec></clientAnnouncementPeriod>\n"
                         "<discoveryServersList><RemoteServer/></discoveryServersList>"),
               {"warning fastdds.discovery-server-setting 4:28",
                "warning fastdds.discovery-server-setting 5:1"}},
        Linted{"server_settings_of_a_client",
               discovery("<discoveryProtocol>CLIENT</discoveryProtocol>\n<clientAnnouncementPeriod>"
                         "<sec>1</sec></clientAnnouncementPeriod>"),
               {"error fastdds.outside 4:47"}},
        Linted{"static_file_without_static",
               discovery("<staticEndpointXMLFilename>x.xml</staticEndpointXMLFilename>"),
               {"warning fastdds.static-edp-file 4:55"}},
        Linted{"static_file",
               discovery("<EDP>STATIC</EDP>\n<static_edp_xml_config>file://x.xml"
                         "</static_edp_xml_config>"),
               {"error fastdds.outside 4:33"}},
        Linted{"throughput_controller",
               document("<throughputController><bytesPerPeriod>9000</bytesPerPeriod>"
                        "<periodMillisecs>10</periodMillisecs></throughputController>"),
               {"warning fastdds.throughput-controller 4:39"}},
        Linted{"number_with_a_unit",
               discovery("<leaseAnnouncement><sec>5s</sec></leaseAnnouncement>"),
               {"warning fastdds.number-tail 4:52"}},
        Linted{
            "number_with_a_fraction",
            discovery("<leaseAnnouncement><sec>0.5</sec><nanosec>1</nanosec></leaseAnnouncement>"),
            {"warning fastdds.number-tail 4:52"}},
        Linted{"too_many_nanoseconds",
               discovery("<leaseAnnouncement><nanosec>1000000000</nanosec></leaseAnnouncement>"),
               {"warning fastdds.nanosec-range 4:56"}},
        Linted{"almost_too_many_nanoseconds",
               discovery("<leaseAnnouncement><nanosec>999999999</nanosec></leaseAnnouncement>"),
               {}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    FastddsElements, Lint,
    testing::Values(
        Linted{"misspelt", discovery("<leaseDurration/>"), {"error fastdds.unknown-element 4:28"}},
        Linted{"wrong_case", discovery("<LeaseDuration/>"), {"error fastdds.wrong-case 4:28"}},
        Linted{
            "wrong_parent", document("<leaseDuration/>"), {"error fastdds.misplaced-element 4:1"}},
        Linted{"wrong_parent_in_profiles",
               document("", "<leaseDuration/>"),
               {"error fastdds.misplaced-element 2:1"}},
        Linted{"unknown_profile",
               document("", "<particpant/>"),
               {"error fastdds.unknown-element 2:1"}},
        Linted{"of_a_later_version",
               document("<timed_events_thread/>"),
               {"error fastdds.later-version 4:1"}},
        Linted{"twice_in_rtps",
               document("<name>a</name>\n<name>b</name>"),
               {"error fastdds.repeated-element 5:1"}},
        Linted{"twice_below",
               discovery("<leaseAnnouncement><sec>2</sec></leaseAnnouncement>\n"
                         "<leaseAnnouncement><sec>1</sec></leaseAnnouncement>"),
               {"warning fastdds.repeated-element 5:1"}},
        Linted{"ignored_in_a_list",
               document(only("t"), "<transport_descriptors><transport/></transport_descriptors>" +
                                       transport("t", "UDPv4", "")),
               {"warning fastdds.ignored-element 2:24"}},
        Linted{"root_participant",
               "<participant profile_name='p' is_default_profile='true'/>",
               {"error fastdds.root 1:1"}},
        Linted{"no_participant",
               "<profiles><topic profile_name='t'/></profiles>",
               {"warning fastdds.no-participant 1:1"}},
        Linted{"not_default",
               "<profiles><participant profile_name='p'/></profiles>",
               {"warning fastdds.not-default 1:11"}},
        Linted{"no_name",
               "<profiles><participant is_default_profile='true'/></profiles>",
               {"error fastdds.missing-profile-name 1:11"}},
        Linted{"default_is_one",
               "<profiles><participant profile_name='p' is_default_profile='1'/></profiles>",
               {"warning fastdds.default-profile-value 1:11", "warning fastdds.not-default 1:11"}},
        Linted{"foreign_attribute",
               "<profiles><participant profile_name='p' is_default_profile='true' domain='3'/>"
               "</profiles>",
               {"warning fastdds.ignored-attribute 1:11"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    FastddsTransports, Lint,
    testing::Values(
        Linted{"participant_send_buffer",
               document("<sendSocketBufferSize>70000</sendSocketBufferSize>" + only("t"),
                        transport("t", "UDPv4", "")),
               {"warning fastdds.participant-send-buffer 4:23"}},
        Linted{"participant_send_buffer_of_builtin",
               document("<sendSocketBufferSize>70000</sendSocketBufferSize>"),
               {}},
        Linted{"builtin_is_less",
               document("<userTransports><transport_id>t</transport_id></userTransports>",
                        transport("t", "UDPv4", "<sendBufferSize>200000</sendBufferSize>")),
               {"warning fastdds.send-buffer-not-least 2:110"}},
        Linted{"more_than_linux_allows",
               udp("<sendBufferSize>212993</sendBufferSize>"),
               {"note fastdds.wmem-max 2:110"}},
        Linted{"as_much_as_linux_allows", udp("<sendBufferSize>212992</sendBufferSize>"), {}},
        Linted{"buffer_below_a_message",
               udp("<sendBufferSize>65499</sendBufferSize>"),
               {"error fastdds.buffer-below-message 2:110"}},
        Linted{"buffer_above_a_small_message",
               udp("<sendBufferSize>65499</sendBufferSize><maxMessageSize>1472</maxMessageSize>"),
               {}},
        Linted{"receive_buffer_below_a_message",
               udp("<receiveBufferSize>1000</receiveBufferSize>"),
               {"error fastdds.buffer-below-message 2:113"}},
        Linted{"builtin_buffer_below_a_message",
               document("<listenSocketBufferSize>1000</listenSocketBufferSize>"),
               {"error fastdds.buffer-below-message 4:25"}},
        Linted{"buffer_beyond_an_integer",
               udp("<sendBufferSize>2147483648</sendBufferSize>"),
               {"error fastdds.buffer-size 2:110"}},
        Linted{"message_beyond_udp",
               udp("<maxMessageSize>65501</maxMessageSize>"),
               {"error fastdds.message-size 2:110"}},
        Linted{"unused",
               document("", transport("t", "UDPv4", "")),
               {"warning fastdds.unused-transport 2:24"}},
        Linted{"undefined", document(only("t")), {"error fastdds.unknown-transport 4:1"}},
        Linted{"defined_too_late",
               "<profiles><participant profile_name='p' is_default_profile='true'><rtps>\n" +
                   only("t") + "</rtps></participant>\n" + transport("t", "UDPv4", "") +
                   "</profiles>",
               {"error fastdds.transport-order 2:1"}},
        Linted{"defined_twice",
               document(only("t"), transport("t", "UDPv4", "") + "\n" + transport("t", "SHM", "")),
               {"error fastdds.repeated-transport 3:24"}},
        Linted{"tcp_setting_of_udp", udp("<tls/>"), {"warning fastdds.wrong-transport-type 2:94"}},
        Linted{"udp_setting_of_shm",
               document("<userTransports><transport_id>t</transport_id></userTransports>",
                        transport("t", "SHM", "<sendBufferSize>1</sendBufferSize>")),
               {"error fastdds.wrong-transport-type 2:92"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    FastddsProperties, Lint,
    testing::Values(
        Linted{"small_messages",
               property("fastdds.max_message_size", "499"),
               {"warning fastdds.small-message 4:85"}},
        Linted{"messages_of_one_descriptor", property("fastdds.max_message_size", "500"), {}},
        Linted{"messages_below_an_announcement",
               property("fastdds.max_message_size", "251"),
               {"error fastdds.outside 4:85"}},
        Linted{"messages_beyond_udp",
               property("fastdds.max_message_size", "70000"),
               {"warning fastdds.max-message-size 4:85"}},
        Linted{"messages_without_a_number",
               property("fastdds.max_message_size", "small"),
               {"warning fastdds.max-message-size 4:85"}},
        Linted{"messages_with_a_unit",
               property("fastdds.max_message_size", "1472 B"),
               {"warning fastdds.number-tail 4:85"}},
        Linted{"transport_allows_less",
               document("<propertiesPolicy><properties><property><name>fastdds.max_message_size"
                        "</name><value>9000</value></property></properties></propertiesPolicy>" +
                            only("t"),
                        transport("t", "UDPv4", "<maxMessageSize>1472</maxMessageSize>")),
               {"warning fastdds.message-size-not-least 4:85"}},
        Linted{"misspelt",
               property("fastdds.max_mesage_size", "1472"),
               {"warning fastdds.unknown-property 4:31"}},
        Linted{"of_the_user", property("my.team", "blue"), {}},
        Linted{"type_propagation_before_3",
               property("fastdds.type_propagation", "registration_only"),
               {"warning fastdds.later-property 4:31"}},
        Linted{"optional_qos_before_3_2",
               property("fastdds.serialize_optional_qos", "true"),
               {"warning fastdds.later-property 4:31"}},
        Linted{"push_mode",
               property("fastdds.push_mode", "false"),
               {"warning fastdds.push-mode 4:78"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    FastddsEndpoints, Lint,
    testing::Values(
        Linted{"writer_times",
               endpoints("<data_writer profile_name='w'><times><heartbeatPeriod><sec>9</sec>"
                         "</heartbeatPeriod></times></data_writer>"),
               {"warning fastdds.writer-times 2:31"}},
        Linted{"publisher_times",
               endpoints("<publisher profile_name='w'><times/></publisher>"),
               {"warning fastdds.writer-times 2:29"}},
        Linted{"reader_times",
               endpoints("<data_reader profile_name='r'><times><heartbeatResponseDelay><sec>9</sec>"
                         "</heartbeatResponseDelay></times></data_reader>"),
               {"warning fastdds.reader-times 2:31"}},
        Linted{"writer_controller",
               endpoints("<data_writer profile_name='w'><throughputController/></data_writer>"),
               {"warning fastdds.throughput-controller 2:31"}},
        Linted{"writer_piggyback",
               endpoints("<data_writer profile_name='w'><qos><disable_heartbeat_piggyback>true"
                         "</disable_heartbeat_piggyback></qos></data_writer>"),
               {"warning fastdds.heartbeat-piggyback 2:36"}},
        Linted{"writer_mode",
               endpoints("<data_writer profile_name='w'><qos><publishMode><kind>ASYNCHRONOUS</kind>"
                         "</publishMode></qos></data_writer>"),
               {"note fastdds.publish-mode 2:36"}},
        Linted{
            "writer_push_mode",
            endpoints("<data_writer profile_name='w'><propertiesPolicy><properties><property>"
                      "<name>fastdds.push_mode</name><value>false</value></property></properties>"
                      "</propertiesPolicy></data_writer>"),
            {"warning fastdds.push-mode 2:61"}},
        Linted{"reader_times_of_a_writer",
               endpoints("<data_writer profile_name='w'><times><heartbeatResponseDelay/></times>"
                         "</data_writer>"),
               {"warning fastdds.writer-times 2:31", "error fastdds.misplaced-element 2:38"}},
        Linted{"plain_writer",
               endpoints("<data_writer profile_name='w'><historyMemoryPolicy>DYNAMIC"
                         "</historyMemoryPolicy></data_writer>"),
               {}}),
    name_of_case);

std::string peer(const std::string& locator) {
  return document("<builtin><initialPeersList><locator>" + locator +
                  "</locator></initialPeersList></builtin>");
}

TEST(FastddsLint, limits_that_users_run_into) {
  const auto has = [](const std::string& text, const std::string& rule) {
    const VendorProfile profile = profile_of(text);
    return std::ranges::find(profile.remarks, rule, &Remark::rule) != profile.remarks.end();
  };
  const std::string ports = "fastdds.peer-ports";
  EXPECT_TRUE(has(peer("<udpv4><address>10.0.0.7</address></udpv4>"), ports));
  EXPECT_TRUE(has(peer("<udpv4><address>10.0.0.7</address><port>0</port></udpv4>"), ports));
  EXPECT_FALSE(has(peer("<udpv4><address>10.0.0.7</address><port>7412</port></udpv4>"), ports));
  EXPECT_FALSE(has(peer("<udpv4><address>239.255.0.1</address></udpv4>"), ports));
  const std::string super = "fastdds.super-client";
  const std::string client = "<discoveryProtocol>SUPER_CLIENT</discoveryProtocol>";
  const auto everybody = [&](const char* is_default) {
    return "<profiles><participant profile_name='p' is_default_profile='" +
           std::string{is_default} + "'><rtps><builtin><discovery_config>" + client +
           "</discovery_config></builtin></rtps></participant></profiles>";
  };
  EXPECT_TRUE(has(everybody("true"), super));
  EXPECT_FALSE(has(everybody("false"), super));
}

TEST(FastddsLint, messages_name_the_thing_and_hints_the_way_out) {
  const auto first = [](const std::string& text) { return profile_of(text).remarks.at(0); };
  EXPECT_EQ(first(discovery("<leaseDurration/>")).message,
            "Fast DDS 2.6 has no <leaseDurration> in <discovery_config> and refuses the file");
  EXPECT_EQ(first(discovery("<leaseDurration/>")).hint, "did you mean 'leaseDuration'?");
  EXPECT_EQ(first(discovery("<LeaseDuration/>")).hint, "case counts: <leaseDuration>");
  EXPECT_EQ(first(document("<leaseDuration/>")).hint,
            "it belongs at participant/rtps/builtin/discovery_config/leaseDuration");
  EXPECT_EQ(first(document("<timed_events_thread/>")).message,
            "Fast DDS 2.6 has no <timed_events_thread> in <rtps> and refuses the file; it is there "
            "since 2.13");
  EXPECT_EQ(first(property("fastdds.max_mesage_size", "1")).hint,
            "did you mean 'fastdds.max_message_size'?");
}

}  // namespace fastdds_lint_test
}  // namespace stormproof::model::config::vendor
