// What each setting of a Fast DDS file does to discovery, by its value: nothing, something that the
// model has not, or another system.
#include <string>

#include <gtest/gtest.h>

#include "tests/model/config/vendor/fastdds_document.hpp"

namespace stormproof::model::config::vendor {
namespace fastdds_effects_test {

struct Judged {
  std::string document, path;
  Effect effect;
};

class Effects : public testing::TestWithParam<Judged> {};

TEST_P(Effects, follow_the_value) {
  const VendorProfile profile = profile_of(GetParam().document);
  EXPECT_EQ(setting(profile, GetParam().path).effect, GetParam().effect)
      << setting(profile, GetParam().path).note;
}

const std::string peers =
    "<initialPeersList><locator><udpv4><address>10.0.0.2</address></udpv4></locator>"
    "</initialPeersList>";
const std::string peer_with_port =
    "<initialPeersList><locator><udpv4><address>10.0.0.2</address><port>7412</port></udpv4>"
    "</locator></initialPeersList>";
const std::string builtin = "rtps/builtin/";
const std::string config = "rtps/builtin/discovery_config/";

INSTANTIATE_TEST_SUITE_P(
    Fastdds, Effects,
    testing::Values(
        Judged{discovery("<discoveryProtocol>SIMPLE</discoveryProtocol>"),
               config + "discoveryProtocol", Effect::none},
        Judged{discovery("<discoveryProtocol>SERVER</discoveryProtocol>"),
               config + "discoveryProtocol", Effect::outside},
        Judged{discovery("<EDP>STATIC</EDP>"), config + "EDP", Effect::outside},
        Judged{discovery("<simpleEDP><PUBWRITER_SUBREADER>0</PUBWRITER_SUBREADER></simpleEDP>"),
               config + "simpleEDP/PUBWRITER_SUBREADER", Effect::outside},
        Judged{discovery("<simpleEDP><PUBREADER_SUBWRITER>1</PUBREADER_SUBWRITER></simpleEDP>"),
               config + "simpleEDP/PUBREADER_SUBWRITER", Effect::none},
        Judged{discovery("<ignoreParticipantFlags>FILTER_SAME_PROCESS</ignoreParticipantFlags>"),
               config + "ignoreParticipantFlags", Effect::unmodelled},
        Judged{discovery("<ignoreParticipantFlags>FILTER_SAME_PROCESS | FILTER_DIFFERENT_HOST"
                         "</ignoreParticipantFlags>"),
               config + "ignoreParticipantFlags", Effect::outside},
        Judged{discovery("<leaseDuration><sec>20</sec></leaseDuration>"), config + "leaseDuration",
               Effect::none},
        Judged{discovery("<leaseDuration><sec>60</sec></leaseDuration>"), config + "leaseDuration",
               Effect::knob},
        Judged{discovery("<leaseDuration><sec>5</sec></leaseDuration>"), config + "leaseDuration",
               Effect::knob},
        Judged{document("<builtin>" + peers + "</builtin>"), builtin + "initialPeersList",
               Effect::knob},
        Judged{document("<builtin>" + peer_with_port + "</builtin>"), builtin + "initialPeersList",
               Effect::unmodelled},
        Judged{document("<builtin><discovery_config><discoveryProtocol>CLIENT</discoveryProtocol>"
                        "</discovery_config>" +
                        peers + "</builtin>"),
               builtin + "initialPeersList", Effect::none},
        Judged{
            document("<builtin><avoid_builtin_multicast>true</avoid_builtin_multicast></builtin>"),
            builtin + "avoid_builtin_multicast", Effect::none},
        Judged{
            document("<builtin><avoid_builtin_multicast>false</avoid_builtin_multicast></builtin>"),
            builtin + "avoid_builtin_multicast", Effect::unmodelled},
        Judged{document("<builtin><use_WriterLivelinessProtocol>false"
                        "</use_WriterLivelinessProtocol></builtin>"),
               builtin + "use_WriterLivelinessProtocol", Effect::unmodelled},
        Judged{document("<builtin><readerHistoryMemoryPolicy>DYNAMIC</readerHistoryMemoryPolicy>"
                        "</builtin>"),
               builtin + "readerHistoryMemoryPolicy", Effect::none},
        Judged{document("<name>x</name>"), "rtps/name", Effect::none},
        Judged{document("<listenSocketBufferSize>70000</listenSocketBufferSize>"),
               "rtps/listenSocketBufferSize", Effect::unmodelled},
        Judged{document("<useBuiltinTransports>false</useBuiltinTransports>"),
               "rtps/useBuiltinTransports", Effect::outside},
        Judged{document("<builtinTransports>UDPv4</builtinTransports>"), "rtps/builtinTransports",
               Effect::none},
        Judged{document("<builtinTransports>LARGE_DATA</builtinTransports>"),
               "rtps/builtinTransports", Effect::outside},
        Judged{document("<builtinTransports>SHM</builtinTransports>"), "rtps/builtinTransports",
               Effect::outside},
        Judged{document("<builtinTransports>UDPv6</builtinTransports>"), "rtps/builtinTransports",
               Effect::unmodelled},
        Judged{document(only("t"), transport("t", "TCPv4", "")), "rtps/userTransports",
               Effect::outside},
        Judged{document(only("t"), transport("t", "UDPv6", "")), "rtps/userTransports",
               Effect::unmodelled},
        Judged{document(only("t"), transport("t", "UDPv4", "")), "rtps/userTransports",
               Effect::none},
        Judged{document(only("t"), transport("t", "UDPv4",
                                             "<non_blocking_send>true"
                                             "</non_blocking_send>")),
               "transport_descriptor[t]/non_blocking_send", Effect::unmodelled},
        Judged{document("", transport("t", "UDPv4",
                                      "<non_blocking_send>true"
                                      "</non_blocking_send>")),
               "transport_descriptor[t]/non_blocking_send", Effect::none},
        Judged{document(only("t"), transport("t", "UDPv4", "<TTL>0</TTL>")),
               "transport_descriptor[t]/TTL", Effect::outside},
        Judged{document("<builtin>" + peers + "</builtin>" + only("t"),
                        transport("t", "UDPv4", "<TTL>0</TTL>")),
               "transport_descriptor[t]/TTL", Effect::none},
        Judged{document(only("t"), transport("t", "UDPv4", "<TTL>9</TTL>")),
               "transport_descriptor[t]/TTL", Effect::none},
        Judged{document(only("t"), transport("t", "UDPv4",
                                             "<interfaceWhiteList><address>10.0.0.2"
                                             "</address></interfaceWhiteList>")),
               "transport_descriptor[t]/interfaceWhiteList", Effect::unmodelled},
        Judged{document(only("t"), transport("t", "UDPv4",
                                             "<interfaceWhiteList><address>127.0.0.1"
                                             "</address></interfaceWhiteList>")),
               "transport_descriptor[t]/interfaceWhiteList", Effect::outside},
        Judged{document("<builtin>" + peers + "</builtin>" + only("t"),
                        transport("t", "UDPv4", "<maxInitialPeersRange>9</maxInitialPeersRange>")),
               "transport_descriptor[t]/maxInitialPeersRange", Effect::knob},
        Judged{document("<builtin>" + peer_with_port + "</builtin>" + only("t"),
                        transport("t", "UDPv4", "<maxInitialPeersRange>9</maxInitialPeersRange>")),
               "transport_descriptor[t]/maxInitialPeersRange", Effect::unmodelled},
        Judged{document(only("t"),
                        transport("t", "UDPv4", "<maxInitialPeersRange>9</maxInitialPeersRange>")),
               "transport_descriptor[t]/maxInitialPeersRange", Effect::none}));

TEST(FastddsEffects, an_unknown_element_is_a_setting_of_unknown_effect) {
  const VendorProfile profile = profile_of(discovery("<leaseDurration>\n</leaseDurration>"));
  ASSERT_EQ(profile.settings.size(), 1U);
  EXPECT_EQ(profile.settings[0].effect, Effect::unknown);
  EXPECT_EQ(profile.settings[0].path, "rtps/builtin/discovery_config/leaseDurration");
}

}  // namespace fastdds_effects_test
}  // namespace stormproof::model::config::vendor
