// A rule that asks for a knob by its key gets what the profile has under that key: the member is
// found while the program is compiled, and here again at run time.
#include "model/engine/composition_knobs.hpp"

#include <gtest/gtest.h>

#include "model/config/knobs/numeric_knobs.hpp"

namespace stormproof::model {
namespace composition_knobs_test {

/// What a rule gets is what the table of knobs has.
template <class Knob>
void expect_number_of_the_key(const DdsProfile& usual) {
  const std::string key{Knob::key};
  const std::optional<std::int64_t> before = config::numeric_knob(usual, key);
  ASSERT_TRUE(before) << key;
  EXPECT_EQ(knob_value(Knob{}, usual), *before) << key;
}

DdsProfile amended() {
  DdsProfile dds;
  dds.amendments.emplace();
  dds.amendments->match_clock_skew = Nanoseconds{7};
  dds.amendments->count_filter = 11;
  dds.amendments->resend_copies = 13;
  return dds;
}

TEST(CompositionKnobs, AreTheNumbersUnderTheirKeys) {
  const DdsProfile paper;
  expect_number_of_the_key<comp::HeartbeatPeriod>(paper);
  expect_number_of_the_key<comp::ResponseDelay>(paper);
  expect_number_of_the_key<comp::InitialDelay>(paper);
  expect_number_of_the_key<comp::MinPeriod>(paper);
  expect_number_of_the_key<comp::MaxPeriod>(paper);
  expect_number_of_the_key<comp::StartupAnnouncements>(paper);
  expect_number_of_the_key<comp::AnnouncementPeriod>(paper);
  expect_number_of_the_key<comp::paper::SuppressionDuration>(paper);
  expect_number_of_the_key<comp::amended::MatchClockSkew>(amended());
  expect_number_of_the_key<comp::amended::CountFilter>(amended());
  expect_number_of_the_key<comp::amended::ResendCopies>(amended());
  DdsProfile cyclone;
  cyclone.implementation = implementations.back();
  expect_number_of_the_key<comp::cyclone::AckDelay>(cyclone);
  expect_number_of_the_key<comp::cyclone::DirectedReplies>(cyclone);
  DdsProfile server;
  server.implementation = implementation_with_discovery;
  server.discovery = Discovery::server;
  expect_number_of_the_key<comp::server::ClientSyncPeriod>(server);
  expect_number_of_the_key<comp::server::RegistrationResponseDelay>(server);
}

TEST(CompositionKnobs, ASwitchIsOnForTheValuesThatItNames) {
  DdsProfile dds = amended();
  const auto asks_by_age = [&](InitialAckNackRepeat repeat) {
    dds.amendments->initial_acknack_repeat = repeat;
    return knob_value(comp::amended::AsksByAge{}, dds);
  };
  EXPECT_FALSE(asks_by_age(InitialAckNackRepeat::again));
  EXPECT_FALSE(asks_by_age(InitialAckNackRepeat::once));
  EXPECT_TRUE(asks_by_age(InitialAckNackRepeat::age_based));
  EXPECT_TRUE(asks_by_age(InitialAckNackRepeat::age_based_zero));
  EXPECT_TRUE(knob_value(comp::ResendsToAll{}, dds));
  dds.spdp.resend = SpdpResend::new_only;
  EXPECT_FALSE(knob_value(comp::ResendsToAll{}, dds));
  EXPECT_TRUE(knob_value(comp::ResendsCopy{}, dds));
}

TEST(CompositionKnobs, WhatNoProfileHasIsFixedOrTheDeployments) {
  EXPECT_EQ(knob_value(comp::control::TopicReplyDelay{}, {}), 5'000'000);
  EXPECT_TRUE(is_knob<comp::AcceptsUnmatched>);
  EXPECT_FALSE(is_knob<comp::cyclone::SendTime>);
}

}  // namespace composition_knobs_test
}  // namespace stormproof::model
