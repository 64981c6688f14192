// Cyclone DDS's XML: what the library or the model refuses, and what does not do what it seems to.
#include "model/config/vendor/cyclonedds_options.hpp"
#include "tests/model/config/vendor/cyclonedds_document.hpp"

namespace stormproof::model::config::vendor::cyclonedds_test {
namespace cyclonedds_lint_test {

TEST(CycloneLint, refuses_values_with_place_and_expectation) {
  const std::string range =
      "; expected a duration with its unit (ns, us, ms, s, min, hr, day) from "
      "0 s to 1 hr";
  const auto nack = [](const char* text) {
    return error(internal(fmt::format("<NackDelay>{}</NackDelay>", text)));
  };
  EXPECT_EQ(nack("100"), "c.xml:2:22: Internal/NackDelay: '100' has no unit" + range);
  EXPECT_EQ(nack("fast"), "c.xml:2:22: Internal/NackDelay: 'fast' is not a number" + range);
  EXPECT_EQ(nack("1 h"),
            "c.xml:2:22: Internal/NackDelay: '1 h' has the unit 'h', which does not "
            "exist" +
                range);
  EXPECT_EQ(nack("2 hr"), "c.xml:2:22: Internal/NackDelay: '2 hr' is out of range" + range);
  EXPECT_EQ(nack("-1 s"), "c.xml:2:22: Internal/NackDelay: '-1 s' is out of range" + range);
  EXPECT_EQ(nack("1 MS"),
            "c.xml:2:22: Internal/NackDelay: '1 MS' has the unit 'MS', which does "
            "not exist" +
                range);
  EXPECT_EQ(nack("99999999999999999999 s"),
            "c.xml:2:22: Internal/NackDelay: '99999999999999999999 s' is out of range" + range);
  EXPECT_EQ(nack("inf"), "c.xml:2:22: Internal/NackDelay: 'inf' is not a number" + range);
  EXPECT_EQ(nack("${DELAY:-soon}"),
            "c.xml:2:22: Internal/NackDelay: 'soon' is not a number" + range);
  EXPECT_EQ(nack("${DELAY"), "c.xml:2:22: Internal/NackDelay: '${DELAY': ${ without its }");
}

TEST(CycloneLint, refuses_wrong_words_integers_and_sizes) {
  EXPECT_EQ(error(domain("<General><DontRoute>yes</DontRoute></General>")),
            "c.xml:2:21: General/DontRoute: 'yes' is neither; expected true or false");
  EXPECT_EQ(error(domain("<General><AllowMulticast>spdp,all</AllowMulticast></General>")),
            "c.xml:2:26: General/AllowMulticast: 'spdp,all' has the word 'all'; expected a list, "
            "with commas, of default, false, spdp, asm, ssm, true");
  EXPECT_EQ(error(discovery("<ParticipantIndex>121</ParticipantIndex>")),
            "c.xml:2:30: Discovery/ParticipantIndex: '121' is out of range; expected an integer "
            "from 0 to 120, or auto, none");
  EXPECT_EQ(error(discovery("<MaxAutoParticipantIndex>1.5</MaxAutoParticipantIndex>")),
            "c.xml:2:37: Discovery/MaxAutoParticipantIndex: '1.5' is not an integer; expected an "
            "integer from 0 to 2147483647");
  EXPECT_EQ(error(domain("<General><FragmentSize>64 KiB</FragmentSize></General>")),
            "c.xml:2:24: General/FragmentSize: '64 KiB' is out of range; expected a size with its "
            "unit (B, KiB, kB, MiB, MB, GiB, GB) from 0 B to 65535 B");
}

TEST(CycloneLint, an_interval_without_effect_is_remarked) {
  const VendorProfile p = read(discovery("<SPDPInterval>20 s</SPDPInterval>"));
  EXPECT_EQ(remarks(p), Remarks{"warning cyclonedds.spdp-interval 2"});
  EXPECT_EQ(p.remarks[0].message,
            "SPDPInterval 20 s has no effect: with LeaseDuration 10 s announcements go out every "
            "8 s");
  EXPECT_EQ(setting(p, "Discovery/SPDPInterval").effect, Effect::none);
  EXPECT_EQ(remarks(read(discovery("<SPDPInterval>8 s</SPDPInterval>"))), Remarks{});
  EXPECT_EQ(remarks(read(discovery("<SPDPInterval>30 s</SPDPInterval>"))),
            Remarks{"note cyclonedds.spdp-interval 2"});
}

TEST(CycloneLint, unknown_names_are_errors_with_a_suggestion) {
  const VendorProfile p = read(internal("<NackDelai>1 s</NackDelai>"));
  ASSERT_EQ(remarks(p), Remarks{"error cyclonedds.unknown-element 2"});
  EXPECT_EQ(p.remarks[0].message,
            "Cyclone DDS 0.10 has no element 'NackDelai' in Internal and refuses the file; did you "
            "mean 'NackDelay'?");
  EXPECT_EQ(setting(p, "Internal/NackDelai").effect, Effect::unknown);
  EXPECT_EQ(p.remarks[0].hint, "");
  const VendorProfile wrong_group = read(domain("<General><NackDelay>1 s</NackDelay></General>"));
  EXPECT_EQ(wrong_group.remarks.at(0).hint, "it belongs in Internal");
  EXPECT_EQ(read(domain("<SharedMemory><Size/></SharedMemory>")).remarks.at(0).hint,
            "expected one of Enable, Locator, LogLevel, Prefix");
  EXPECT_EQ(remarks(read(domain("<Networking/>"))), Remarks{"error cyclonedds.unknown-element 2"});
  EXPECT_EQ(remarks(read(internal("<HeartbeatInterval mx=\"1 s\"/>"))),
            Remarks{"error cyclonedds.unknown-attribute 2"});
  EXPECT_EQ(remarks(read("<CycloneDDS><Domain name=\"x\"/></CycloneDDS>")),
            Remarks{"error cyclonedds.unknown-attribute 1"});
}

TEST(CycloneLint, names_of_other_versions_say_so) {
  const VendorProfile later =
      read(discovery("<InitialLocatorPruneDelay>5 s</InitialLocatorPruneDelay>"));
  EXPECT_EQ(remarks(later), Remarks{"error cyclonedds.other-version 2"});
  EXPECT_NE(later.remarks[0].message.find("11.0 and later"), std::string::npos);
  const VendorProfile earlier =
      read(internal("<SuppressSPDPMulticast>true</SuppressSPDPMulticast>"));
  EXPECT_NE(earlier.remarks.at(0).message.find("before 0.10"), std::string::npos);
}

/// What 11.0 reads otherwise than 0.10.
TEST(CycloneLint, the_base_decides_which_version_reads) {
  const auto of_11 = [](const std::string& text) {
    const auto root = parse_xml(text, "c.xml");
    EXPECT_TRUE(root);
    auto profile = read_vendor_profile(*root, {"", "cyclonedds-11"});
    EXPECT_TRUE(profile) << (profile ? "" : to_string(profile.error()));
    return profile ? *std::move(profile) : VendorProfile{};
  };
  const std::string peers = discovery(
      "<Peers AddLocalhost=\"false\"><Peer Address=\"192.0.2.10\" PruneDelay=\"inf\"/>"
      "</Peers>");
  EXPECT_EQ(remarks(read(peers)),
            (Remarks{"error cyclonedds.other-version 2", "error cyclonedds.other-version 2"}));
  EXPECT_EQ(remarks(of_11(peers)), Remarks{});
  const VendorProfile reachable = of_11(peers);
  ASSERT_NE(reachable.changes.find("peers"), nullptr);
  EXPECT_EQ(reachable.changes.find("peers")->text, "100");
  // How long addresses at which nobody is known are announced to, of each peer or of all.
  EXPECT_TRUE(change(of_11(peers), "spdp", "initial_prune_delay").starts_with("1000000s@"));
  EXPECT_TRUE(change(of_11(discovery("<InitialLocatorPruneDelay>5 s</InitialLocatorPruneDelay>")),
                     "spdp", "initial_prune_delay")
                  .starts_with("5s@"));
  EXPECT_TRUE(
      change(of_11(discovery("<DiscoveredLocatorPruneDelay>inf</DiscoveredLocatorPruneDelay>")),
             "spdp", "discovered_prune_delay")
          .starts_with("1000000s@"));
  const VendorProfile differing =
      of_11(discovery("<Peers><Peer Address=\"192.0.2.10\" PruneDelay=\"inf\"/>"
                      "<Peer Address=\"192.0.2.11\" PruneDelay=\"5 s\"/></Peers>"));
  EXPECT_NE(change(differing, "unmodelled", "Discovery/Peers/Peer[@PruneDelay]"), "-");
  // An interval that is set counts, whatever the lease.
  const std::string interval = discovery("<SPDPInterval>60s</SPDPInterval>");
  EXPECT_TRUE(change(of_11(interval), "spdp", "period").starts_with("60s@"));
  EXPECT_EQ(remarks(of_11(interval)), Remarks{});
  EXPECT_TRUE(change(read(interval), "spdp", "period").starts_with("8s@"));
  const std::string usual =
      discovery("<SPDPInterval>default</SPDPInterval><LeaseDuration>20 s</LeaseDuration>");
  EXPECT_TRUE(change(of_11(usual), "spdp", "period").starts_with("18s@"));
  EXPECT_NE(error(usual), "");
  // Indices are automatic where somebody has to guess them.
  const std::string most = discovery("<MaxAutoParticipantIndex>30</MaxAutoParticipantIndex>");
  EXPECT_EQ(remarks(of_11(most)), Remarks{"warning cyclonedds.no-effect 2"});
  const VendorProfile with_peers =
      of_11(discovery("<MaxAutoParticipantIndex>30</MaxAutoParticipantIndex>"
                      "<Peers><Peer Address=\"192.0.2.10\"/></Peers>"));
  EXPECT_EQ(remarks(with_peers), Remarks{"note cyclonedds.participant-limit 2"});
  const VendorProfile usual_limit = of_11(discovery("<ParticipantIndex>auto</ParticipantIndex>"));
  EXPECT_TRUE(usual_limit.remarks.front().message.starts_with("a host can have 99 processes"));
  const std::string gone =
      internal("<UnicastResponseToSPDPMessages>false</UnicastResponseToSPDPMessages>");
  EXPECT_EQ(remarks(read(gone)), Remarks{});
  EXPECT_EQ(remarks(of_11(gone)), Remarks{"error cyclonedds.other-version 2"});
  for (const CycloneOption& option : cyclone_options(CycloneVersion::of_11)) {
    if (option.usual.empty()) continue;
    EXPECT_TRUE(parse_cyclone(option.type, option.usual)) << option.path;
  }
}

TEST(CycloneLint, old_names_still_work) {
  const VendorProfile p = read(
      "<CycloneDDS><General><NetworkInterfaceAddress>auto</NetworkInterfaceAddress></General>\n"
      "<Unsupported><LeaseDuration>20 s</LeaseDuration></Unsupported></CycloneDDS>");
  EXPECT_EQ(change(p, "spdp", "period"), "18s@2:29");
  EXPECT_EQ(remarks(p),
            (Remarks{"warning cyclonedds.no-domain 1", "warning cyclonedds.deprecated 1",
                     "warning cyclonedds.deprecated 2", "warning cyclonedds.deprecated 2"}));
  const VendorProfile buffer =
      read(internal("<MinimumSocketSendBufferSize>1 MB</MinimumSocketSendBufferSize>"));
  EXPECT_TRUE(change(buffer, "unmodelled", "Internal/SocketSendBufferSize[@min]")
                  .starts_with("1048576 B; "));
}

TEST(CycloneLint, names_have_no_case) {
  const VendorProfile p = read(
      "<CYCLONEDDS><domain ID=\"ANY\"><internal><nackdelay>1 s</nackdelay></internal></domain>"
      "</CYCLONEDDS>");
  EXPECT_EQ(change(p, "sedp", "nack_delay"), "1s@1:51");
  EXPECT_EQ(setting(p, "Internal/NackDelay").value, "1 s");
}

TEST(CycloneLint, sizes_without_unit_are_bytes_with_a_warning) {
  const VendorProfile p =
      read(domain("<General><MaxRexmitMessageSize>1400</MaxRexmitMessageSize></General>"));
  EXPECT_EQ(change(p, "sedp", "max_rexmit_message_size"), "1400@2:32");
  EXPECT_EQ(remarks(p), Remarks{"warning cyclonedds.missing-unit 2"});
}

TEST(CycloneLint, twice_in_one_domain_is_refused) {
  EXPECT_EQ(error(internal("<NackDelay>1 s</NackDelay><nackDelay>2 s</nackDelay>")),
            "c.xml:2:48: Internal/NackDelay stands twice in one Domain; expected it once");
  EXPECT_EQ(error(internal("much")), "c.xml:2:11: 'much' in Internal; expected elements only");
}

TEST(CycloneLint, contradictions) {
  const auto found = [](const std::string& text) { return remarks(read(text)); };
  EXPECT_EQ(found(internal("<HeartbeatInterval max=\"50 ms\">100 ms</HeartbeatInterval>")),
            Remarks{"warning cyclonedds.contradiction 2"});
  EXPECT_EQ(found(internal("<NackDelay>5 s</NackDelay>")),
            Remarks{"warning cyclonedds.contradiction 2"});
  EXPECT_EQ(found(internal("<NackDelay>5 s</NackDelay><AutoReschedNackDelay>inf"
                           "</AutoReschedNackDelay>")),
            Remarks{});
  EXPECT_EQ(found(internal("<SocketSendBufferSize min=\"2 MB\" max=\"1 MB\"/>")),
            Remarks{"warning cyclonedds.contradiction 2"});
  EXPECT_EQ(found(internal("<RetransmitMergingPeriod>9 ms</RetransmitMergingPeriod>")),
            Remarks{"warning cyclonedds.no-effect 2"});
  EXPECT_EQ(found(discovery("<MaxAutoParticipantIndex>30</MaxAutoParticipantIndex>")),
            Remarks{"warning cyclonedds.no-effect 2"});
}

TEST(CycloneLint, limits_that_users_run_into) {
  const auto found = [](const std::string& text) { return remarks(read(text)); };
  EXPECT_EQ(found(discovery("<ParticipantIndex>auto</ParticipantIndex>")),
            Remarks{"note cyclonedds.participant-limit 2"});
  const VendorProfile raised =
      read(discovery("<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>30"
                     "</MaxAutoParticipantIndex>"));
  EXPECT_TRUE(raised.remarks.front().message.starts_with("a host can have 30 processes"));
  EXPECT_EQ(found(discovery("<ParticipantIndex>3</ParticipantIndex>")),
            Remarks{"note cyclonedds.participant-limit 2"});
  EXPECT_EQ(found(internal("<SocketReceiveBufferSize min=\"10 MB\"/>")),
            Remarks{"warning cyclonedds.kernel-buffer 2"});
  EXPECT_EQ(found(internal("<SocketReceiveBufferSize min=\"100 kB\"/>")), Remarks{});
}

TEST(CycloneLint, message_sizes_that_do_not_fit) {
  const auto limit = [](const char* size) {
    return remarks(read(
        domain(fmt::format("<General><MaxMessageSize>{0}</MaxMessageSize><MaxRexmitMessageSize>{0}"
                           "</MaxRexmitMessageSize></General>",
                           size))));
  };
  EXPECT_EQ(limit("1472 B"), Remarks{});
  EXPECT_EQ(limit("1473 B"), Remarks{"note cyclonedds.message-size 2"});
  EXPECT_EQ(limit("65508 B"),
            (Remarks{"warning cyclonedds.message-size 2", "warning cyclonedds.message-size 2"}));
}

TEST(CycloneLint, any_value_of_any_setting_is_read_or_refused_at_its_place) {
  const std::vector<std::string> values = {"0",
                                           "-1",
                                           "1",
                                           "1 ms",
                                           "1.5 kB",
                                           "inf",
                                           "default",
                                           "true",
                                           "none",
                                           "x",
                                           "+",
                                           "- 1 s",
                                           "1 s s",
                                           "9223372036854775807 ns",
                                           "9223372036854775807 day",
                                           "18446744073709551616",
                                           "....",
                                           "5-3 s",
                                           "1.7976931348623157e308 s",
                                           "auto",
                                           ",",
                                           "spdp,",
                                           "\xc3\xa4"};
  std::size_t read_count = 0, refused = 0;
  for (const CycloneOption& option : cyclone_options(CycloneVersion::of_0_10)) {
    if (option.path.ends_with("]")) continue;
    std::string open, close;
    for (std::string_view rest = option.path; !rest.empty();) {
      const std::string name{rest.substr(0, rest.find('/'))};
      open += "<" + name + ">";
      close = "</" + name + ">" + close;
      rest.remove_prefix(std::min(name.size() + 1, rest.size()));
    }
    for (const std::string& value : values) {
      const auto profile = parse(domain(open + value + close));
      if (profile) {
        EXPECT_EQ(profile->settings.size(), 1U);
      } else {
        EXPECT_TRUE(profile.error().where.starts_with("c.xml:2:")) << profile.error().where;
      }
      ++(profile ? read_count : refused);
    }
  }
  EXPECT_GT(read_count, 300U);
  EXPECT_GT(refused, 800U);
}

TEST(CycloneLint, the_table_reads_its_own_defaults) {
  for (const CycloneOption& option : cyclone_options(CycloneVersion::of_0_10)) {
    if (option.usual.empty()) continue;
    EXPECT_TRUE(parse_cyclone(option.type, option.usual)) << option.path;
    EXPECT_EQ(option.effect == Effect::knob, !option.knob.empty() && !option.always) << option.path;
    EXPECT_FALSE(option.note.empty()) << option.path;
  }
}

TEST(CycloneLint, a_loopback_interface_alone_is_another_system) {
  const auto interfaces = [](const std::string& inside) {
    return remarks(read(domain("<General><Interfaces>" + inside + "</Interfaces></General>")));
  };
  const std::string loopback = "<NetworkInterface name='lo'/>";
  const std::string wireless = "<NetworkInterface name='wlan0'/>";
  EXPECT_EQ(interfaces(loopback), Remarks{"error cyclonedds.outside 2"});
  EXPECT_EQ(interfaces("<NetworkInterface address='127.0.0.1'/>"),
            Remarks{"error cyclonedds.outside 2"});
  EXPECT_EQ(interfaces(wireless), Remarks{});
  EXPECT_EQ(interfaces(wireless + loopback), Remarks{});
  const std::string old = "<General><NetworkInterfaceAddress>127.0.0.1</NetworkInterfaceAddress>";
  EXPECT_EQ(remarks(read(domain(old + "</General>"))).back(), "error cyclonedds.outside 2");
}

TEST(CycloneLint, a_root_is_found_in_any_case) {
  const auto root = parse_xml("<cYCLONEdds/>", "c.xml");
  ASSERT_TRUE(root);
  EXPECT_EQ(vendor_of(*root), Vendor::cyclonedds);
  EXPECT_TRUE(read_vendor_profile(*root, {}));
}

TEST(CycloneLint, a_long_list_of_domains_is_cut) {
  std::string text;
  for (int id = 0; id < 20'000; ++id) text += fmt::format("<Domain Id='{}'/>", id);
  EXPECT_EQ(error("<CycloneDDS>" + text + "</CycloneDDS>"),
            "c.xml:1:1: settings for the domains 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, …; expected one of "
            "them after the file's name, as in FILE#0");
}

TEST(CycloneLint, a_setting_without_effect_has_no_knob) {
  const VendorProfile profile =
      read(discovery("<SPDPInterval>30 s</SPDPInterval><LeaseDuration>10 s</LeaseDuration>"));
  EXPECT_EQ(setting(profile, "Discovery/LeaseDuration").knob, "spdp.period");
  EXPECT_EQ(setting(profile, "Discovery/SPDPInterval").effect, Effect::none);
  EXPECT_EQ(setting(profile, "Discovery/SPDPInterval").knob, "");
}

TEST(CycloneLint, the_shipped_examples_have_no_warnings) {
  for (const char* name : {"default.xml", "slow-link.xml", "two-domains.xml", "wifi.xml"}) {
    const auto root = load_xml(std::string{STORMPROOF_SPECS_DIR} + "/vendor/cyclonedds/" + name);
    ASSERT_TRUE(root) << to_string(root.error());
    const auto profile = read_cyclonedds_profile(root->roots.front(), {"7", ""});
    ASSERT_TRUE(profile) << to_string(profile.error());
    for (const Remark& remark : profile->remarks) {
      EXPECT_EQ(remark.severity, Severity::note) << remark.message;
    }
  }
}

}  // namespace cyclonedds_lint_test
}  // namespace stormproof::model::config::vendor::cyclonedds_test
