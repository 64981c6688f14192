// Why participants do not see each other: small captures that were made for one reason each, and
// the shipped ones, of whose good ones none is said.
#include "checker/evidence/doctor/reasons/reasons.hpp"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "checker/evidence/capture/write/simulated_capture.hpp"
#include "checker/evidence/doctor/doctor.hpp"
#include "checker/presentation/document/render.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::doctor {
namespace reasons_test {

using namespace capture::testing;
using capture::Address;
using capture::Conversation;
using capture::UdpEnd;
namespace entity = capture::entity;

constexpr capture::EntityId pub = entity::publications_writer;
constexpr capture::EntityId sub = entity::subscriptions_writer;
constexpr std::int64_t second = 1'000'000;  // in microseconds

/// A capture under construction: participant k is on host k, at port 7410.
class Built {
 public:
  Built& announce(std::uint8_t who, std::int64_t at_us, std::uint16_t group_port = 7400) {
    const UdpEnd group{multicast().address, group_port};
    return send(at_us, {home(who), group}, Message{prefix(who)}.announcement({home(who)}));
  }
  /// From another address than it announces.
  Built& announce_from(const UdpEnd& from, std::uint8_t who, std::int64_t at_us,
                       const UdpEnd& locator) {
    return send(at_us, {from, multicast()}, Message{prefix(who)}.announcement({locator}));
  }
  Built& announce_to(std::uint8_t who, const UdpEnd& peer, std::int64_t at_us) {
    return send(at_us, {home(who), peer}, Message{prefix(who)}.announcement({home(who)}));
  }
  /// Two descriptors of each stream, and a HEARTBEAT for each.
  Built& tell(std::uint8_t from, std::uint8_t to, std::int64_t at_us) {
    for (const capture::EntityId writer : {pub, sub}) {
      send(at_us, {home(from), home(to)},
           Message{prefix(from)}.to(prefix(to)).descriptor(writer, 1).descriptor(writer, 2));
      send(at_us + 1, {home(from), home(to)},
           Message{prefix(from)}.to(prefix(to)).heartbeat(writer, 1, 2, 1));
    }
    return *this;
  }
  Built& acknowledge(std::uint8_t from, std::uint8_t to, std::int64_t at_us) {
    return acknowledge_up_to(from, to, 3, at_us);
  }
  /// Everything below `base`.
  Built& acknowledge_up_to(std::uint8_t from, std::uint8_t to, std::int64_t base,
                           std::int64_t at_us) {
    for (const capture::EntityId writer : {pub, sub}) {
      send(at_us, {home(from), home(to)},
           Message{prefix(from)}.to(prefix(to)).acknack(writer, base, 0, 0, true));
    }
    return *this;
  }
  /// Both discover each other.
  Built& discover(std::uint8_t one, std::uint8_t other, std::int64_t at_us) {
    return tell(one, other, at_us)
        .tell(other, one, at_us + 10)
        .acknowledge(one, other, at_us + 20)
        .acknowledge(other, one, at_us + 30);
  }

  /// A reader whose state is new asks from the beginning.
  Built& begin_anew(std::uint8_t from, std::uint8_t to, std::int64_t at_us) {
    for (const capture::EntityId writer : {pub, sub}) {
      send(at_us, {home(from), home(to)},
           Message{prefix(from)}.to(prefix(to)).acknack(writer, 1, 2, 0b11, true));
    }
    return *this;
  }
  /// HEARTBEATs of both streams.
  Built& ask(std::uint8_t from, std::uint8_t to, std::int64_t at_us, std::int64_t last = 2,
             std::uint32_t count = 2) {
    for (const capture::EntityId writer : {pub, sub}) {
      send(at_us, {home(from), home(to)},
           Message{prefix(from)}.to(prefix(to)).heartbeat(writer, 1, last, count));
    }
    return *this;
  }

  Built& igmp(std::uint8_t who, std::uint8_t type, std::int64_t at_us) {
    file_.frame(at_us, ethernet(igmp_message(who, type)));
    return *this;
  }

  [[nodiscard]] static UdpEnd home(std::uint8_t who) { return at(who, 7410); }
  [[nodiscard]] Conversation conversation() const { return conversation_of({file_.buffer()}); }
  [[nodiscard]] const PcapFile& file() const { return file_; }

 private:
  Built& send(std::int64_t at_us, Route route, const Message& message) {
    route.id = ++id_;
    file_.message(at_us, route, message);
    return *this;
  }

  PcapFile file_;
  std::uint32_t id_ = 0;
};

const Reason* find(const Report& report, std::string_view id) {
  const auto found = std::ranges::find(report.reasons, id, &Reason::id);
  return found == report.reasons.end() ? nullptr : &*found;
}
std::string list(const Report& report) {
  std::string all;
  for (const Reason& one : report.reasons) all += one.id + ": " + one.sentence + "\n";
  return all;
}

TEST(Reasons, OfTwoThatDiscoverEachOtherThereIsNone) {
  const Conversation conversation =
      Built{}.announce(1, 0).announce(2, 5).discover(1, 2, 100).conversation();
  const Report report = examine(conversation);
  EXPECT_TRUE(report.reasons.empty()) << list(report);
  EXPECT_EQ(report.health, Health::healthy);
}

TEST(Reasons, DifferentDomains) {
  const Conversation conversation = Built{}
                                        .announce(1, 0)
                                        .announce(2, 5, 7650)
                                        .announce(1, 100)
                                        .announce(2, 105, 7650)
                                        .conversation();
  const Report report = examine(conversation);
  ASSERT_NE(report.what_keeps_apart(), nullptr) << list(report);
  EXPECT_EQ(report.what_keeps_apart()->id, "domains");
  EXPECT_NE(report.what_keeps_apart()->sentence.find("host 1 (10.0.0.2) is in domain 1"),
            std::string::npos)
      << list(report);
  EXPECT_EQ(report.health, Health::incomplete);
  EXPECT_EQ(find(report, "no_answers"), nullptr) << "nobody could answer";
  const std::string page = report::to_text(document_of(report, {}));
  EXPECT_NE(page.find("INCOMPLETE: host 0 (10.0.0.1) is in domain 0"), std::string::npos) << page;
  EXPECT_NE(page.find("ROS_DOMAIN_ID"), std::string::npos) << page;
}

TEST(Reasons, TwoDomainsThatHaveTwoHostsEachAreOnPurpose) {
  const Conversation conversation = Built{}
                                        .announce(1, 0)
                                        .announce(2, 1)
                                        .announce(3, 2, 7650)
                                        .announce(4, 3, 7650)
                                        .discover(1, 2, 100)
                                        .discover(3, 4, 200)
                                        .conversation();
  EXPECT_EQ(find(examine(conversation), "domains"), nullptr);
}

TEST(Reasons, AnnouncementsAndNoAnswers) {
  const Conversation conversation =
      Built{}.announce(1, 0).announce(2, 5).announce(1, 100).announce(2, 105).conversation();
  const Report report = examine(conversation);
  ASSERT_NE(report.what_keeps_apart(), nullptr);
  EXPECT_EQ(report.what_keeps_apart()->id, "no_answers");
  EXPECT_GT(report.what_keeps_apart()->probability, 0.8) << "they start in the capture";
  EXPECT_EQ(report.health, Health::incomplete);
  // With nothing but periodic announcements the capture may have begun late.
  const Conversation later = Built{}
                                 .announce(1, 0)
                                 .announce(2, 5)
                                 .announce(1, 3 * second)
                                 .announce(2, 3 * second + 5)
                                 .conversation();
  const Report unsure = examine(later);
  ASSERT_NE(find(unsure, "no_answers"), nullptr);
  EXPECT_LT(find(unsure, "no_answers")->probability, 0.6);
  EXPECT_NE(find(unsure, "no_answers")->sentence.find("when the capture began"), std::string::npos);
}

TEST(Reasons, AHostWhoseAnswersNeverCome) {
  const Conversation conversation = Built{}
                                        .announce(1, 0)
                                        .announce(2, 1)
                                        .announce(3, 2)
                                        .discover(1, 2, 100)
                                        .tell(1, 3, 200)
                                        .tell(2, 3, 300)
                                        .conversation();
  const Report report = examine(conversation);
  ASSERT_NE(report.what_keeps_apart(), nullptr) << list(report);
  EXPECT_EQ(report.what_keeps_apart()->id, "silent_host");
  EXPECT_NE(report.what_keeps_apart()->sentence.find("host 2 (10.0.0.3)"), std::string::npos);
  EXPECT_EQ(report.health, Health::incomplete) << "everybody was told everything, and yet";
}

TEST(Reasons, OneDirectionThatFails) {
  const Conversation conversation = Built{}
                                        .announce(1, 0)
                                        .announce(2, 1)
                                        .announce(3, 2)
                                        .discover(1, 2, 100)
                                        .discover(1, 3, 200)
                                        .tell(2, 3, 300)
                                        .conversation();
  const Report report = examine(conversation);
  ASSERT_NE(report.what_keeps_apart(), nullptr) << list(report);
  EXPECT_EQ(report.what_keeps_apart()->id, "one_way");
  EXPECT_EQ(find(report, "silent_host"), nullptr);
}

TEST(Reasons, OnlyOneHostIsHeard) {
  const Conversation one = Built{}.announce(1, 0).announce(1, 100).conversation();
  const Report report = examine(one);
  ASSERT_NE(report.what_keeps_apart(), nullptr);
  EXPECT_EQ(report.what_keeps_apart()->id, "one_host");
  EXPECT_NE(report.what_keeps_apart()->remedy.find("multicast"), std::string::npos);
  // It answers somebody whose packets are not there.
  const Conversation answering = Built{}.announce(1, 0).tell(1, 2, 100).conversation();
  const Report heard = examine(answering);
  ASSERT_NE(heard.what_keeps_apart(), nullptr);
  EXPECT_EQ(heard.what_keeps_apart()->id, "one_direction");
}

TEST(Reasons, IgmpTellsThatSomebodyListensAndWhetherAnybodyAsks) {
  constexpr std::uint8_t query = 0x11;
  constexpr std::uint8_t joins = 0x16;
  const auto said = [](const Built& built) {
    const Conversation conversation = built.conversation();
    const Report report = examine(conversation);
    const Reason* reason = find(report, "one_host");
    return reason == nullptr ? Reason{} : *reason;
  };
  const Reason alone = said(Built{}.announce(1, 0).igmp(1, joins, 50).announce(1, 100));
  EXPECT_EQ(alone.sentence.find("IGMP)"), std::string::npos) << alone.sentence;
  const Reason joined = said(Built{}.announce(1, 0).igmp(2, joins, 50).announce(1, 100));
  EXPECT_NE(joined.sentence.find("10.0.0.2 has joined 239.255.0.1"), std::string::npos)
      << joined.sentence;
  EXPECT_EQ(joined.sentence.find("nothing else runs"), std::string::npos) << joined.sentence;
  EXPECT_GT(joined.probability, alone.probability);
  const Reason asked = said(Built{}.announce(1, 0).igmp(9, query, 50).announce(1, 300 * second));
  EXPECT_NE(asked.sentence.find("10.0.0.9 asks who listens"), std::string::npos) << asked.sentence;
  const Reason never = said(Built{}.announce(1, 0).announce(1, 300 * second));
  EXPECT_NE(never.sentence.find("nobody asked who listens (IGMP) within 300 seconds"),
            std::string::npos)
      << never.sentence;
}

TEST(Reasons, CapturesOfTwoHostsTellThatMulticastIsFiltered) {
  const Built here = Built{}.announce(1, 0).announce(1, 100);
  const Built there = Built{}.announce(2, 5).announce(2, 105);
  const Conversation conversation = conversation_of({here.file().buffer(), there.file().buffer()});
  const Report report = examine(conversation);
  ASSERT_NE(report.what_keeps_apart(), nullptr) << list(report);
  EXPECT_EQ(report.what_keeps_apart()->id, "multicast_filtered");
}

UdpEnd end_of(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
  return {Address::from(Buffer{a, b, c, d}), 7410};
}

TEST(Reasons, AddressesThatNobodyReaches) {
  for (const auto& [locator, word] :
       {std::pair{end_of(172, 17, 0, 2), "container"}, std::pair{end_of(127, 0, 0, 1), "loopback"},
        std::pair{end_of(192, 168, 5, 2), "another network"}}) {
    const Conversation conversation = Built{}
                                          .announce(1, 0)
                                          .announce_from(at(2, 7410), 2, 5, locator)
                                          .tell(1, 2, 100)
                                          .conversation();
    const Report report = examine(conversation);
    ASSERT_NE(find(report, "unreachable"), nullptr) << word << "\n" << list(report);
    EXPECT_NE(find(report, "unreachable")->sentence.find(word), std::string::npos) << list(report);
  }
}

TEST(Reasons, LocalhostOnly) {
  const UdpEnd loopback = end_of(127, 0, 0, 1);
  const Conversation conversation =
      Built{}.announce(1, 0).announce_from(loopback, 2, 5, loopback).conversation();
  EXPECT_NE(find(examine(conversation), "localhost_only"), nullptr);
  Conversation range = Built{}.announce(1, 0).announce(2, 5).conversation();
  EXPECT_EQ(find(examine(range), "localhost_only"), nullptr);
  for (capture::DatagramRecord& one : range.datagrams) one.time_to_live = 0;
  EXPECT_NE(find(examine(range), "localhost_only"), nullptr);
}

TEST(Reasons, SeveralProductsWhereDescriptorsAreMissingBetweenThem) {
  Conversation conversation = Built{}
                                  .announce(1, 0)
                                  .announce(2, 1)
                                  .announce(3, 2)
                                  .discover(1, 2, 100)
                                  .tell(1, 3, 200)
                                  .acknowledge(3, 1, 300)
                                  .conversation();
  EXPECT_EQ(find(examine(conversation), "products"), nullptr) << "all of one vendor";
  for (capture::Participant& one : conversation.topology.participants) {
    if (one.prefix == prefix(3)) one.vendor = 0x0110;
  }
  const Report report = examine(conversation);
  ASSERT_NE(find(report, "products"), nullptr) << report.missing << list(report);
  EXPECT_NE(find(report, "products")->sentence.find("Cyclone DDS"), std::string::npos);
}

TEST(Reasons, UnequalQosOfOneTopic) {
  Conversation conversation =
      Built{}.announce(1, 0).announce(2, 5).discover(1, 2, 100).conversation();
  for (capture::Participant& one : conversation.topology.participants) {
    const bool writes = one.prefix == prefix(1);
    for (auto& [guid, endpoint] : one.endpoints) {
      endpoint.announced_by = writes ? pub : sub;
      endpoint.qos.is_reliable = !writes;
    }
  }
  const Report report = examine(conversation);
  ASSERT_NE(find(report, "unequal_qos"), nullptr);
  EXPECT_NE(find(report, "unequal_qos")
                ->sentence.find("topic abc: reliability: offered best "
                                "effort, requested reliable"),
            std::string::npos)
      << list(report);
  EXPECT_EQ(report.health, Health::unmatched);
}

TEST(Reasons, PortsOfStaticPeers) {
  const UdpEnd far = at(2, 7420);
  const Conversation conversation = Built{}
                                        .announce_to(1, at(2, 7410), 0)
                                        .announce_to(1, at(2, 7412), 1)
                                        .announce_from(far, 2, 5, far)
                                        .conversation();
  const Report report = examine(conversation);
  ASSERT_NE(find(report, "peer_ports"), nullptr) << list(report);
  EXPECT_NE(find(report, "peer_ports")->sentence.find("7420"), std::string::npos);
}

TEST(Reasons, NoNumberIsLeft) {
  Built built;
  for (std::uint8_t k = 0; k < 10; ++k) {
    const UdpEnd end = at(1, static_cast<std::uint16_t>(7410 + 2 * k));
    built.announce_from(end, static_cast<std::uint8_t>(10 + k), k, end);
  }
  Conversation conversation = built.conversation();
  EXPECT_EQ(find(examine(conversation), "participant_numbers"), nullptr) << "Fast DDS has more";
  for (capture::Participant& one : conversation.topology.participants) one.vendor = 0x0110;
  EXPECT_NE(find(examine(conversation), "participant_numbers"), nullptr);
}

TEST(Reasons, SomebodyWhoFallsSilent) {
  Built built;
  built.announce(1, 0).announce(2, 5).discover(1, 2, 100);
  for (int k = 1; k < 20; ++k) built.announce(1, 3 * k * second);
  const Conversation conversation = built.conversation();
  const Report report = examine(conversation);
  ASSERT_NE(find(report, "fell_silent"), nullptr) << list(report);
  EXPECT_NE(find(report, "fell_silent")->sentence.find("participant 1"), std::string::npos);
  EXPECT_EQ(report.health, Health::healthy) << "it was discovered";
}

/// Both announce themselves every 3 s from 3 s until `until_s`, but for those who do not in
/// between.
Built announcing(int until_s, std::pair<int, int> away_s = {}, bool is_one_alone = false) {
  Built built = Built{}.announce(1, 0).announce(2, 5).discover(1, 2, 100);
  for (int s = 3; s <= until_s; s += 3) {
    const bool is_away = s > away_s.first && s < away_s.second;
    if (!is_away || is_one_alone) built.announce(1, s * second);
    if (!is_away) built.announce(2, s * second + 5);
  }
  return built;
}

TEST(Reasons, BothForgotEachOther) {
  const Conversation conversation = announcing(36)
                                        .begin_anew(1, 2, 37 * second)
                                        .begin_anew(2, 1, 37 * second + 5)
                                        .discover(1, 2, 38 * second)
                                        .conversation();
  const Report report = examine(conversation);
  ASSERT_NE(find(report, "outage"), nullptr) << list(report);
  const std::string& sentence = find(report, "outage")->sentence;
  EXPECT_NE(sentence.find("host 0 (10.0.0.1) and host 1 (10.0.0.2) forgot each other (2 pairs)"),
            std::string::npos)
      << sentence;
  EXPECT_NE(sentence.find("until 37.00 s"), std::string::npos) << sentence;
  EXPECT_FALSE(find(report, "outage")->keeps_apart);
  EXPECT_EQ(report.what_keeps_apart(), nullptr) << list(report);
}

TEST(Reasons, OneSideForgotTheOther) {
  const Conversation conversation = announcing(36)
                                        .begin_anew(1, 2, 37 * second)
                                        .tell(2, 1, 38 * second)
                                        .acknowledge(1, 2, 38 * second + 20)
                                        .conversation();
  const Report report = examine(conversation);
  ASSERT_NE(find(report, "outage"), nullptr) << list(report);
  EXPECT_NE(find(report, "outage")
                ->sentence.find("of host 0 (10.0.0.1) forgot those of host 1 "
                                "(10.0.0.2), which kept them (1 pair)"),
            std::string::npos)
      << list(report);
}

TEST(Reasons, AnAcknackThatAnotherOvertookIsNoOutage) {
  const Conversation conversation = announcing(9).begin_anew(1, 2, 130).conversation();
  EXPECT_EQ(find(examine(conversation), "outage"), nullptr) << list(examine(conversation));
}

/// Discovered, then asked `times` in 6 s and answered by nobody, then again.
Report asked_in_vain(int times) {
  Built built = Built{}.announce(1, 0).announce(2, 5).discover(1, 2, 100);
  for (int k = 1; k <= times; ++k) {
    built.ask(1, 2, k * 6 * second / times).ask(2, 1, k * 6 * second / times + 5);
  }
  const Conversation conversation =
      built.acknowledge(1, 2, 7 * second).acknowledge(2, 1, 7 * second).conversation();
  Report report = examine(conversation);
  EXPECT_EQ(report.what_keeps_apart(), nullptr) << list(report);
  std::erase_if(report.reasons, [](const Reason& one) { return one.id != "outage"; });
  return report;
}

TEST(Reasons, NobodyAnsweredForAWhile) {
  const Report report = asked_in_vain(6);
  ASSERT_EQ(report.reasons.size(), 1U);
  EXPECT_NE(report.reasons.front().sentence.find("did not answer each other"), std::string::npos);
  // Answers may wait behind what is being sent; and a few may have been lost.
  EXPECT_TRUE(asked_in_vain(60).reasons.empty());
  EXPECT_TRUE(asked_in_vain(4).reasons.empty());
}

TEST(Reasons, AHostThatIsNotHeardForAWhile) {
  const Conversation away = announcing(36, {9, 24}, true).conversation();
  const Report report = examine(away);
  ASSERT_NE(find(report, "outage"), nullptr) << list(report);
  EXPECT_NE(find(report, "outage")->sentence.find("nothing was heard of host 1 (10.0.0.2)"),
            std::string::npos)
      << list(report);
  // If nobody is heard, it is the capture that paused.
  const Conversation paused = announcing(36, {9, 24}).conversation();
  EXPECT_EQ(find(examine(paused), "outage"), nullptr) << list(examine(paused));
  EXPECT_TRUE(examine(announcing(36).conversation()).reasons.empty());
}

TEST(Reasons, AGhostIsKeptUntilItsLeaseIsOver) {
  const Conversation conversation = announcing(18, {6, 60}, true).conversation();
  const Report report = examine(conversation);
  ASSERT_NE(find(report, "ghost"), nullptr) << list(report);
  EXPECT_NE(find(report, "ghost")->sentence.find("participant 1"), std::string::npos);
  EXPECT_EQ(find(report, "fell_silent"), nullptr) << "its lease is not over";
}

TEST(Reasons, WhoComesBackUnderItsOldIdentityIsNotObeyed) {
  const auto restarted = [](std::int64_t acknowledged) {
    Built built = Built{}.announce(1, 0).announce(2, 5).discover(1, 2, 100);
    built.ask(1, 2, 2 * second, 12, 40).announce(1, 9 * second).ask(1, 2, 10 * second, 2, 1);
    return built.acknowledge_up_to(2, 1, acknowledged, 10 * second + 20).conversation();
  };
  const Conversation deaf = restarted(13);
  const Report report = examine(deaf);
  ASSERT_NE(find(report, "old_identity"), nullptr) << list(report);
  EXPECT_NE(find(report, "old_identity")
                ->sentence.find("participant 0 of host 0 (10.0.0.1) came back under its old "
                                "identity 10.00 s after the capture began"),
            std::string::npos)
      << list(report);
  EXPECT_NE(find(report, "old_identity")->sentence.find("which had got as far as 12 before"),
            std::string::npos)
      << list(report);
  const Conversation obeyed = restarted(3);
  EXPECT_EQ(find(examine(obeyed), "old_identity"), nullptr);
}

TEST(Reasons, AServerThatWasKilledAndCameBackAtOnceIsNotObeyed) {
  const auto scenario = model::config::parse_scenario(
      "{deployment: {participants: [{host: 0, publications: 2, subscriptions: 2}, {host: 1, "
      "publications: 2, subscriptions: 2}], life: {restarts: [{participant: 2, stop: 10s, start: "
      "12s}]}}, dds: fastdds-server-2.6.11, wireless: wifi-80211n-paper, time_limit: 30s, "
      "run_until: time_limit}",
      "scenario", {}, model::config::SpecPath::standard());
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  const capture::SimulatedCapture simulated = capture::simulated_capture(*scenario);
  const std::vector<capture::MemoryCapture> files{
      {"run", simulated.pcap, simulated.pcap.size() + 1}};
  const auto conversation = capture::read_conversation(files);
  ASSERT_TRUE(conversation) << to_string(conversation.error());
  const Report report = examine(*conversation);
  EXPECT_NE(find(report, "old_identity"), nullptr) << list(report);
  EXPECT_EQ(find(report, "outage"), nullptr) << "its readers are new ones\n" << list(report);
}

TEST(Reasons, OfNoShippedCaptureThatIsGood) {
  std::size_t captures = 0;
  for (const auto& file :
       std::filesystem::recursive_directory_iterator{STORMPROOF_SPECS_DIR "/captures"}) {
    const std::string path = file.path().string();
    if (!path.ends_with(".pcap.xz") || path.find("same_machine") != std::string::npos) continue;
    const auto conversation = capture::read_conversation(std::vector{path});
    ASSERT_TRUE(conversation) << path;
    const Report report = examine(*conversation);
    EXPECT_EQ(report.what_keeps_apart(), nullptr) << path << "\n" << list(report);
    for (const char* id : {"outage", "ghost", "old_identity"}) {
      EXPECT_EQ(find(report, id), nullptr) << path << "\n" << list(report);
    }
    EXPECT_NE(report.health, Health::unmatched) << path << "\n" << list(report);
    ++captures;
  }
  EXPECT_GE(captures, 30U);
}

}  // namespace reasons_test
}  // namespace stormproof::doctor
