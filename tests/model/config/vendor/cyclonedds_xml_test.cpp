// Cyclone DDS's XML: what each setting does to the profile, and which domain counts.
#include <fmt/ranges.h>

#include "model/config/vendor/cyclonedds_options.hpp"
#include "tests/model/config/vendor/cyclonedds_document.hpp"

namespace stormproof::model::config::vendor::cyclonedds_test {
namespace cyclonedds_xml_test {

TEST(CycloneXml, timers_and_sizes_become_knobs_at_their_places) {
  const VendorProfile p = read(
      domain("<Internal><HeartbeatInterval>250 ms</HeartbeatInterval><NackDelay>0.5s</NackDelay>\n"
             "<PreEmptiveAckDelay>30ms</PreEmptiveAckDelay></Internal>\n"
             "<General><MaxRexmitMessageSize>1 KiB</MaxRexmitMessageSize></General>"));
  EXPECT_EQ(change(p, "sedp", "heartbeat_interval"), "250ms@2:30");
  EXPECT_EQ(change(p, "sedp", "nack_delay"), "500ms@2:67");
  EXPECT_EQ(change(p, "sedp", "preemptive_ack_delay"), "30ms@3:21");
  EXPECT_EQ(change(p, "sedp", "max_rexmit_message_size"), "1024@4:32");
  EXPECT_EQ(p.changes.find("base")->text, "cyclonedds-0.10");
  EXPECT_EQ(setting(p, "Internal/NackDelay").effect, Effect::knob);
  EXPECT_EQ(setting(p, "Internal/NackDelay").knob, "sedp.nack_delay");
  EXPECT_EQ(setting(p, "Internal/NackDelay").value, "0.5s");
  EXPECT_EQ(remarks(p), Remarks{});
}

TEST(CycloneXml, resolves_to_the_preset_with_the_changes) {
  DdsProfile expected = preset();
  EXPECT_EQ(resolved("<CycloneDDS/>"), expected);
  expected.sedp.nack_delay = Nanoseconds{1'000'000'000};
  EXPECT_EQ(resolved(internal("<NackDelay>1 s</NackDelay>")), expected);
  EXPECT_NE(resolved(internal("<NackDelay>2 s</NackDelay>")), expected);
}

TEST(CycloneXml, every_unit_and_spelling_of_a_duration) {
  for (const char* text : {"1 min", "60s", "60000 ms", "60000000us", "60000000000 ns", "1.0 min",
                           "+60 s", "0.0166666666666666666 hr"}) {
    const VendorProfile p = read(internal(fmt::format("<NackDelay>{}</NackDelay>", text)));
    EXPECT_EQ(change(p, "sedp", "nack_delay"), "60s@2:22") << text;
  }
  EXPECT_EQ(change(read(internal("<NackDelay>0</NackDelay>")), "sedp", "nack_delay"), "0s@2:22");
}

TEST(CycloneXml, announcement_period_is_the_lesser_of_interval_and_lease) {
  const auto period = [](const std::string& settings) {
    return change(read(discovery(settings)), "spdp", "period");
  };
  EXPECT_EQ(period("<SPDPInterval>5 s</SPDPInterval>"), "5s@2:26");
  EXPECT_EQ(period("<SPDPInterval>1 min</SPDPInterval>"), "8s@2:26");
  EXPECT_EQ(period("<LeaseDuration>20 s</LeaseDuration>"), "18s@2:27");
  EXPECT_EQ(period("<LeaseDuration>5 s</LeaseDuration>"), "4s@2:27");
  EXPECT_EQ(period("<LeaseDuration>9.9 s</LeaseDuration>"), "7.92s@2:27");
  EXPECT_EQ(period("<LeaseDuration>10.5 s</LeaseDuration>"), "8.5s@2:27");
  EXPECT_EQ(period("<LeaseDuration>1 hr</LeaseDuration>"), "30s@2:27");
  EXPECT_EQ(period("<LeaseDuration>5 ms</LeaseDuration>"), "10ms@2:27");
  EXPECT_EQ(period("<SPDPInterval>20 s</SPDPInterval><LeaseDuration>60 s</LeaseDuration>"),
            "20s@2:26");
  EXPECT_EQ(period("<SPDPInterval>20 s</SPDPInterval><LeaseDuration>12 s</LeaseDuration>"),
            "10s@2:60");
  EXPECT_EQ(error(discovery("<SPDPInterval>0</SPDPInterval>")),
            "c.xml:2:26: Discovery/SPDPInterval: 0 s gives spdp.period 0 s; expected 1 ns to "
            "1000000s, which is what the model takes");
}

TEST(CycloneXml, minsched_holds_the_heartbeat_interval) {
  const VendorProfile held = read(internal("<HeartbeatInterval>10 ms</HeartbeatInterval>"));
  EXPECT_EQ(change(held, "sedp", "heartbeat_interval"), "20ms@2:30");
  EXPECT_EQ(remarks(held), Remarks{"warning cyclonedds.heartbeat-interval 2"});

  const VendorProfile free =
      read(internal("<HeartbeatInterval minsched=\"5 ms\">10 ms</HeartbeatInterval>"));
  EXPECT_EQ(change(free, "sedp", "heartbeat_interval"), "10ms@2:46");
  EXPECT_EQ(remarks(free), Remarks{});
  const VendorProfile raised = read(internal("<HeartbeatInterval minsched=\"1 s\"/>"));
  EXPECT_EQ(change(raised, "sedp", "heartbeat_interval"), "1s@2:11");
  EXPECT_EQ(error(internal("<HeartbeatInterval>inf</HeartbeatInterval>")),
            "c.xml:2:30: Internal/HeartbeatInterval: inf gives sedp.heartbeat_interval no end; "
            "expected 1 ns to 1000000s, which is what the model takes");
}

TEST(CycloneXml, a_preemptive_acknack_may_go_out_at_once) {
  const VendorProfile p = read(internal("<PreEmptiveAckDelay>0 s</PreEmptiveAckDelay>"));
  EXPECT_EQ(change(p, "sedp", "preemptive_ack_delay"), "0s@2:31");
}

TEST(CycloneXml, the_timers_and_limits_of_readers_and_repairs) {
  const VendorProfile p =
      read(internal("<AckDelay>5 ms</AckDelay><AutoReschedNackDelay>1 s</AutoReschedNackDelay>"
                    "<HeartbeatInterval max=\"4 s\">1 s</HeartbeatInterval>"
                    "<MaxQueuedRexmitMessages>50</MaxQueuedRexmitMessages>"));
  EXPECT_TRUE(change(p, "sedp", "ack_delay").starts_with("5ms@"));
  EXPECT_TRUE(change(p, "sedp", "auto_resched_nack_delay").starts_with("1s@"));
  EXPECT_TRUE(change(p, "sedp", "heartbeat_interval").starts_with("1s@"));
  EXPECT_TRUE(change(p, "sedp", "heartbeat_interval_max").starts_with("4s@"));
  EXPECT_TRUE(change(p, "sedp", "max_queued_rexmit_messages").starts_with("50@"));
  const VendorProfile never = read(internal("<AutoReschedNackDelay>inf</AutoReschedNackDelay>"));
  EXPECT_TRUE(change(never, "sedp", "auto_resched_nack_delay").starts_with("1000000s@"));
}

TEST(CycloneXml, what_the_model_has_not_replaces_the_presets_text) {
  const VendorProfile p =
      read(internal("<HeartbeatInterval minsched=\"30 ms\"/>"
                    "<RetransmitMerging>Adaptive</RetransmitMerging>"));
  EXPECT_TRUE(change(p, "unmodelled", "Internal/HeartbeatInterval[@minsched]")
                  .starts_with("30 ms; lower bound of the interval"));
  EXPECT_TRUE(change(p, "unmodelled", "Internal/RetransmitMerging").starts_with("adaptive; "));

  const DdsProfile before = preset();
  const DdsProfile after = resolved(internal("<HeartbeatInterval minsched=\"30 ms\"/>"));
  const std::string key = "Internal/HeartbeatInterval[@minsched]";
  EXPECT_EQ(after.unmodelled.size(), before.unmodelled.size());
  EXPECT_NE(after.unmodelled.at(key), before.unmodelled.at(key));
}

TEST(CycloneXml, defaults_written_out_are_the_preset) {
  std::string general, internals;
  for (const CycloneOption& option : cyclone_options(CycloneVersion::of_0_10)) {
    if (!option.always || option.path.ends_with("]")) continue;
    const std::size_t slash = option.path.find('/');
    const auto leaf = fmt::format("<{0}>{1}</{0}>", option.path.substr(slash + 1), option.usual);
    (option.path.starts_with("General") ? general : internals) += leaf;
  }
  internals += "<HeartbeatInterval max=\"8s\" minsched=\"20ms\">100ms</HeartbeatInterval>";
  const std::string text = domain("<General>" + general + "</General><Internal>" + internals +
                                  "</Internal><Discovery><LeaseDuration>10s</LeaseDuration>"
                                  "</Discovery>");
  EXPECT_EQ(resolved(text), preset()) << text;
  EXPECT_EQ(resolved(domain("<General><DontRoute>true</DontRoute></General>")), preset());
}

TEST(CycloneXml, decimals_are_rounded_and_kB_is_1024) {
  const VendorProfile p =
      read(domain("<Internal><NackDelay>1.9999 us</NackDelay><AckDelay>10ms</AckDelay></Internal>\n"
                  "<General><MaxRexmitMessageSize>2.0006 kB</MaxRexmitMessageSize></General>"));
  EXPECT_EQ(change(p, "sedp", "nack_delay"), "2us@2:22");
  EXPECT_EQ(change(p, "sedp", "max_rexmit_message_size"), "2049@3:32");
  EXPECT_EQ(setting(p, "Internal/AckDelay").effect, Effect::knob);
  EXPECT_TRUE(change(p, "sedp", "ack_delay").starts_with("10ms@"));
}

TEST(CycloneXml, multicast) {
  const auto effect = [](const char* words, const char* more = "") {
    const VendorProfile p = read(domain(fmt::format(
        "<General><AllowMulticast>{}</AllowMulticast></General><Discovery>{}</Discovery>", words,
        more)));
    std::string result = name_of(setting(p, "General/AllowMulticast").effect);
    for (const std::string& remark : remarks(p)) result += ", " + remark;
    return result;
  };
  EXPECT_EQ(effect("spdp"), "knob");
  EXPECT_EQ(effect("default"), "knob");
  EXPECT_EQ(effect("TRUE"), "knob");
  EXPECT_EQ(effect("spdp,asm"), "knob");
  const auto multicast_of = [](const char* words) {
    return resolved(
               domain(fmt::format("<General><AllowMulticast>{}</AllowMulticast></General>", words)))
        .allow_multicast;
  };
  EXPECT_EQ(multicast_of("true"), AllowMulticast::always);
  EXPECT_EQ(multicast_of("spdp,asm"), AllowMulticast::always);
  EXPECT_EQ(multicast_of("spdp"), AllowMulticast::spdp);
  EXPECT_EQ(multicast_of("default"), AllowMulticast::by_network);
  EXPECT_EQ(effect("false"), "outside, error cyclonedds.no-announcements 2");
  EXPECT_EQ(effect("ssm"), "outside, error cyclonedds.no-announcements 2");
  const char* peers = "<Peers><Peer Address=\"10.0.0.2\"/></Peers>";
  EXPECT_EQ(effect("false", peers), "knob, warning cyclonedds.participant-index 2");
  EXPECT_EQ(effect("false",
                   "<ParticipantIndex>auto</ParticipantIndex><Peers><Peer "
                   "address=\"10.0.0.2\"/></Peers>"),
            "knob, note cyclonedds.participant-limit 2");
}

/// Hosts without ports are announced to at as many as participants may have.
TEST(CycloneXml, peers_are_ports_of_other_hosts) {
  const std::string hosts = "<Peers><Peer Address=\"a\"/><Peer Address=\"192.0.2.1\"/></Peers>";
  const DdsProfile beside = resolved(discovery(hosts));
  EXPECT_EQ(beside.peers, 9U);
  EXPECT_EQ(beside.allow_multicast, preset().allow_multicast);
  const std::string most = "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>";
  EXPECT_EQ(resolved(discovery(most + hosts)).peers, 32U);
  const DdsProfile alone = resolved(domain(fmt::format(
      "<General><AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto"
      "</ParticipantIndex>{}</Discovery>",
      hosts)));
  EXPECT_EQ(alone.peers, 9U);
  EXPECT_EQ(alone.allow_multicast, AllowMulticast::never);
  EXPECT_EQ(alone.unmodelled, preset().unmodelled);
}

TEST(CycloneXml, peers_are_listed_together) {
  const VendorProfile p =
      read(discovery("<Peers><Peer Address=\"a\"/><Peer Address=\"b:7410\"/>"
                     "</Peers>"));
  EXPECT_EQ(change(p, "unmodelled", "Discovery/Peers/Peer[@Address]"),
            "a, b:7410; announcements go there by unicast, too@2:19");
  EXPECT_EQ(remarks(p), Remarks{});
}

TEST(CycloneXml, several_interfaces) {
  const auto text = [](const char* interfaces) {
    return domain(fmt::format("<General><Interfaces>{}</Interfaces></General>", interfaces));
  };
  const VendorProfile one = read(text("<NetworkInterface name=\"wlan0\" priority=\"default\"/>"));
  EXPECT_EQ(one.changes.find("unmodelled"), nullptr);
  const VendorProfile two =
      read(text("<NetworkInterface name=\"wlan0\"/><NetworkInterface name=\"eth0\"/>"));
  EXPECT_TRUE(change(two, "unmodelled", "General/Interfaces").starts_with("2 network interfaces"));
  const VendorProfile silent = read(text("<NetworkInterface name=\"wlan0\" multicast=\"false\"/>"));
  EXPECT_NE(change(silent, "unmodelled", "General/Interfaces/NetworkInterface[@multicast]"), "-");
}

/// 0.10 switches multicast off for all interfaces if one has none; nobody is found without peers.
TEST(CycloneXml, an_interface_without_multicast) {
  const auto text = [](const char* interfaces, const char* more = "") {
    return domain(
        fmt::format("<General><Interfaces>{}</Interfaces></General><Discovery>{}"
                    "</Discovery>",
                    interfaces, more));
  };
  const auto found = [](const VendorProfile& profile) {
    return fmt::format("{}", fmt::join(remarks(profile), ", "));
  };
  const char* silent = "<NetworkInterface name=\"wlan0\" multicast=\"false\"/>";
  const char* both =
      "<NetworkInterface name=\"eth0\"/><NetworkInterface name=\"wlan0\" multicast=\"false\"/>";
  const char* peers = "<Peers><Peer Address=\"192.0.2.10\"/></Peers>";
  for (const char* interfaces : {silent, both}) {
    EXPECT_NE(found(read(text(interfaces))).find("error cyclonedds.no-announcements 2"),
              std::string::npos);
    const VendorProfile reachable = read(text(interfaces, peers));
    EXPECT_EQ(found(reachable), "note cyclonedds.participant-limit 2") << interfaces;
    ASSERT_NE(reachable.changes.find("max_participants_per_host"), nullptr);
    EXPECT_EQ(reachable.changes.find("max_participants_per_host")->text, "9");
    EXPECT_EQ(reachable.changes.find("allow_multicast")->text, "false");
    EXPECT_EQ(reachable.changes.find("peers")->text, "9");
  }
  EXPECT_EQ(found(read(text("<NetworkInterface name=\"wlan0\" multicast=\"true\"/>"))), "");
}

/// From 11 on each interface has an AllowMulticast of its own.
TEST(CycloneXml, interfaces_of_11_announce_each_for_itself) {
  const auto of_11 = [](const char* interfaces) {
    const auto root = parse_xml(
        domain(fmt::format("<General><Interfaces>{}</Interfaces></General>", interfaces)), "c.xml");
    auto profile = read_cyclonedds_profile(*root, {"", "cyclonedds-11"});
    EXPECT_TRUE(profile);
    return fmt::format("{}", fmt::join(remarks(*profile), ", "));
  };
  const std::string error = "error cyclonedds.no-announcements 2";
  EXPECT_NE(of_11("<NetworkInterface name=\"a\" allow_multicast=\"asm\"/>").find(error),
            std::string::npos);
  EXPECT_EQ(of_11("<NetworkInterface name=\"a\" allow_multicast=\"spdp\"/>"), "");
  EXPECT_EQ(
      of_11("<NetworkInterface name=\"a\"/><NetworkInterface name=\"b\" multicast=\"false\"/>")
          .find(error),
      std::string::npos);
}

TEST(CycloneXml, addresses_of_peers_that_are_none) {
  const auto found = [](const char* index, const char* address, const char* multicast = "false") {
    return fmt::format(
        "{}",
        fmt::join(remarks(read(domain(fmt::format(
                      "<General><AllowMulticast>{}</AllowMulticast></General><Discovery>"
                      "<ParticipantIndex>{}</ParticipantIndex><Peers><Peer Address=\"{}\"/></Peers>"
                      "</Discovery>",
                      multicast, index, address)))),
                  ", "));
  };
  for (const char* address : {"", "[IP_ADDRESS]", "192.168.1.X", "YOUR_IP", "300.1.1.1", "a b"}) {
    const std::string alone = found("none", address);
    EXPECT_NE(alone.find("error cyclonedds.no-announcements"), std::string::npos) << address;
    EXPECT_NE(alone.find("warning cyclonedds.peer-address"), std::string::npos) << address;
    EXPECT_EQ(found("none", address, "spdp"), "warning cyclonedds.peer-address 2") << address;
  }
  for (const char* address :
       {"192.0.2.1", "192.0.2.1:7410", "robot", "robot.local", "192.0.2.1,a"}) {
    EXPECT_EQ(found("auto", address), "note cyclonedds.participant-limit 2") << address;
  }
  const auto of_11 = read_cyclonedds_profile(
      *parse_xml(discovery("<Peers><Peer Address=\"[IP]\"/></Peers>"), "c.xml"),
      {"", "cyclonedds-11"});
  ASSERT_TRUE(of_11);
  EXPECT_NE(
      fmt::format("{}", fmt::join(remarks(*of_11), ", ")).find("error cyclonedds.peer-address"),
      std::string::npos);
}

/// What a host can have at most stands in the profile.
TEST(CycloneXml, processes_of_a_host) {
  const auto most = [](const std::string& settings) {
    return resolved(discovery(settings)).max_participants_per_host;
  };
  EXPECT_EQ(most(""), 0U);
  EXPECT_EQ(most("<ParticipantIndex>auto</ParticipantIndex>"), 9U);
  EXPECT_EQ(most("<ParticipantIndex>auto</ParticipantIndex>"
                 "<MaxAutoParticipantIndex>30</MaxAutoParticipantIndex>"),
            30U);
  EXPECT_EQ(most("<ParticipantIndex>3</ParticipantIndex>"), 1U);
  EXPECT_EQ(remarks(read(discovery("<ParticipantIndex>auto</ParticipantIndex>"
                                   "<MaxAutoParticipantIndex>0</MaxAutoParticipantIndex>"))),
            Remarks{"error cyclonedds.participant-limit 2"});
}

TEST(CycloneXml, a_lease_is_a_value_of_the_profile) {
  EXPECT_EQ(resolved(discovery("<LeaseDuration>300s</LeaseDuration>")).spdp.lease,
            Nanoseconds{300'000'000'000});
}

TEST(CycloneXml, other_transports_are_outside) {
  for (const char* text :
       {"<General><Transport>tcp</Transport></General>", "<TCP><Enable>true</Enable></TCP>",
        "<Security/>", "<General><Transport>raweth</Transport></General>"}) {
    const VendorProfile p = read(domain(text));
    EXPECT_EQ(p.settings.at(0).effect, Effect::outside) << text;
    EXPECT_NE(fmt::format("{}", fmt::join(remarks(p), ", ")).find("error cyclonedds.outside 2"),
              std::string::npos)
        << text;
  }
  const VendorProfile p = read(domain("<General><Transport>udp6</Transport></General>"));
  EXPECT_EQ(p.settings.at(0).effect, Effect::unmodelled);
  const VendorProfile udp = read(domain("<General><Transport>udp</Transport></General>"));
  EXPECT_EQ(udp.settings.at(0).effect, Effect::none);
  EXPECT_EQ(udp.changes.find("unmodelled"), nullptr);
}

constexpr const char* two_domains =
    "<CycloneDDS><Domain Id=\"any\"><Internal><NackDelay>1 s</NackDelay></Internal></Domain>\n"
    "<Domain Id=\"0\"><Internal><AckDelay>1 s</AckDelay></Internal></Domain>\n"
    "<Domain><Id>7</Id><Internal><NackDelay>2 s</NackDelay></Internal></Domain></CycloneDDS>";

TEST(CycloneXml, a_domain_is_chosen_by_its_id) {
  const auto nack = [](const char* id) {
    return change(read(two_domains, id), "sedp", "nack_delay");
  };
  EXPECT_EQ(nack("0"), "1s@1:51");
  EXPECT_EQ(nack("7"), "2s@3:40");
  EXPECT_EQ(nack("42"), "1s@1:51");
  EXPECT_EQ(nack("any"), "1s@1:51");
  EXPECT_EQ(read(two_domains, "7").name, "7");
  EXPECT_EQ(change(read(two_domains, "7"), "sedp", "ack_delay"), "-");
  EXPECT_NE(change(read(two_domains, "0"), "sedp", "ack_delay"), "-");
  EXPECT_EQ(remarks(read(two_domains, "7")),
            (Remarks{"note cyclonedds.overridden 1", "note cyclonedds.other-domain 2"}));
}

TEST(CycloneXml, a_choice_that_is_not_there) {
  EXPECT_EQ(error(two_domains),
            "c.xml:1:1: settings for the domains 0, 7; expected one of them "
            "after the file's name, as in FILE#0");
  EXPECT_EQ(error(two_domains, "lidar"),
            "c.xml:1:1: no settings for domain 'lidar'; expected one of any, 0, 7");
  const std::string only = "<CycloneDDS><Domain Id=\"3\"/></CycloneDDS>";
  EXPECT_EQ(read(only).name, "3");
  const VendorProfile seven = read("<CycloneDDS><Domain/><Domain Id=\"7\"/></CycloneDDS>");
  EXPECT_EQ(seven.name, "7");
  EXPECT_EQ(remarks(seven), Remarks{"note cyclonedds.domain 1"});
  EXPECT_EQ(error(only, "4"), "c.xml:1:1: no settings for domain '4'; expected one of 3");
  EXPECT_EQ(error("<CycloneDDS><Domain Id=\"x\"/></CycloneDDS>"),
            "c.xml:1:13: Domain Id 'x'; expected any, or an integer from 0 to 4294967294");
}

TEST(CycloneXml, the_shipped_examples) {
  const std::string folder = std::string{STORMPROOF_SPECS_DIR} + "/vendor/cyclonedds/";
  const auto example = [&](const std::string& name) {
    const auto profile = read_dds_profile(folder + name, {}, source_specs());
    EXPECT_TRUE(profile) << to_string(profile.error());
    return profile ? *profile : DdsProfile{};
  };
  EXPECT_EQ(example("default.xml"), preset());
  DdsProfile slow = example("slow-link.xml");
  EXPECT_EQ(slow.spdp.period, Nanoseconds{20'000'000'000});
  EXPECT_EQ(slow.sedp.nack_delay, Nanoseconds{1'000'000'000});
  EXPECT_EQ(example("two-domains.xml#7").sedp.nack_delay, Nanoseconds{1'000'000'000});
  EXPECT_EQ(example("two-domains.xml#0").sedp.nack_delay, Nanoseconds{200'000'000});
  EXPECT_EQ(example("wifi.xml").sedp, preset().sedp);
}

}  // namespace cyclonedds_xml_test
}  // namespace stormproof::model::config::vendor::cyclonedds_test
