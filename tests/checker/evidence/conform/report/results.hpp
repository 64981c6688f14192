// Hand-made results for the tests of the reports: a small conversation, and one result for each
// verdict.
#pragma once

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "checker/evidence/conform/report/report.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::conform::testing {

/// Two participants on two hosts. Events: 0 and 1 their announcements, 2 HEARTBEAT 0 → 1, 3 ACKNACK
/// that asks for 1 and 2, 4 and 5 DATA 1 and 2 in one datagram, 6 ACKNACK, all of publications.
[[nodiscard]] inline capture::Conversation small_conversation() {
  using namespace capture::testing;
  constexpr capture::EntityId pub = capture::entity::publications_writer;
  PcapFile file;
  file.message(0, {at(1, 7410), multicast()}, Message{prefix(1)}.announcement({at(1, 7410)}));
  file.message(900, {at(2, 7410), multicast()}, Message{prefix(2)}.announcement({at(2, 7410)}));
  const Route there{at(1, 7410), at(2, 7410)};
  const Route back{at(2, 7410), at(1, 7410)};
  file.message(1000, there, Message{prefix(1)}.to(prefix(2)).heartbeat(pub, 1, 2, 1));
  file.message(2500, back, Message{prefix(2)}.to(prefix(1)).acknack(pub, 1, 2, 0xc0000000U, true));
  file.message(3000, there, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1).descriptor(pub, 2));
  file.message(3300, back, Message{prefix(2)}.to(prefix(1)).acknack(pub, 3, 0, 0, true, 2));
  return conversation_of({file.buffer()});
}

inline const Place announcements{0, std::nullopt, capture::entity::spdp_writer};
inline const Place publications{0, 1, capture::entity::publications_writer};

[[nodiscard]] inline Conformance conforming() {
  Conformance result;
  result.verdict = Verdict::conforms;
  result.bounds = {0, 60'000'000'000, 20'000'000, 500'000'000, 0, 0, 0, true};
  result.checked = result.explained = 7;
  result.not_checked = 3;
  result.by_rule[static_cast<std::size_t>(Rule::announcement_scheduled)] = 2;
  result.by_rule[static_cast<std::size_t>(Rule::heartbeat_same_host)] = 1;
  result.by_rule[static_cast<std::size_t>(Rule::data_pull)] = 2;
  result.by_rule[static_cast<std::size_t>(Rule::acknack_reply)] = 2;
  result.places = {{announcements, 1, 0, 0}, {publications, 5, 1, 0}};
  result.rows = {{"InitialAckNack", 0, "Dormant + ReaderOpened [Enabled] / Start → Waiting", 4},
                 {"InitialAckNack", 1, "Dormant + ReaderOpened [not Enabled] → Done", 0},
                 {"InitialAckNack", 2, "Waiting + AttemptDue / Retry → Waiting", 0},
                 {"InitialAckNack", 3, "Waiting + AttemptDue → Done", 2}};
  result.lost = 1;
  result.used_send_lag_ns = 1'500'000;
  result.used_lateness_ns = 2'000'000;
  result.assumptions = {"HEARTBEATs without a cause in the capture are caused on their own host"};
  return result;
}

/// The ACKNACK of event 3 comes too early, and so does the announcement of event 0.
[[nodiscard]] inline Conformance failing(const capture::Conversation& conversation) {
  Conformance result = conforming();
  result.verdict = Verdict::does_not_conform;
  result.explained = 5;
  Unexplained early;
  early.event = 3;
  early.fault = Fault::acknack_early;
  early.place = publications;
  early.what = "ACKNACK that asks for 1–2, too soon";
  early.nearest = "the HEARTBEAT arrives at once";
  early.needs = {{"send lag", 30'000'000, 20'000'000}, {"a HEARTBEAT before it", {}, {}}};
  early.context = {2, 3, 4};
  Unexplained extra;
  extra.event = 6;
  extra.fault = Fault::announcement_extra;
  extra.place = announcements;
  extra.what = "one announcement too many";
  result.unexplained = {early, extra};
  result.places[0].unexplained = result.places[1].unexplained = 1;
  const std::int64_t first = conversation.first_ns;
  result.hidden = {{Hidden::Kind::timer, first, {}, announcements, "Announcer"},
                   {Hidden::Kind::received, first + 2'000'000, 2, publications, {}},
                   {Hidden::Kind::dropped, first + 3'100'000, 3, publications, {}},
                   {Hidden::Kind::lost, first + 3'000'000, 4, publications, {}}};
  return result;
}

[[nodiscard]] inline Conformance inconclusive() {
  Conformance result = conforming();
  result.verdict = Verdict::inconclusive;
  result.why_inconclusive = "interrupted";
  return result;
}

[[nodiscard]] inline model::DdsProfile fastdds() {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  return dds;
}

[[nodiscard]] inline bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

[[nodiscard]] inline std::size_t times(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

/// A result for each verdict, ready to be changed by a test.
class Reports : public ::testing::Test {
 protected:
  [[nodiscard]] Report report_of(const Conformance& result) const {
    return {conversation, result, dds, "fastdds-2.6.11", INT64_MAX};
  }

  capture::Conversation conversation = small_conversation();
  model::DdsProfile dds = fastdds();
  Conformance good = conforming();
  Conformance bad = failing(conversation);
  Conformance open = inconclusive();
};

}  // namespace stormproof::conform::testing
