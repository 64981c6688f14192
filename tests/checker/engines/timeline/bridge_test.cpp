// The encoding says what the machines do: for drawn timers, delays, losses and phases, ties
// included, both have the same receptions, the same packets and the same last one. And no run is
// later than the bound.
#include "checker/engines/timeline/relation_timeline.hpp"
#include "tests/checker/engines/timeline/drawn_runs.hpp"

namespace stormproof::timeline {
namespace bridge_test {

Setting drawn_setting() {
  Setting setting;
  setting.dds.sedp = drawn_timers();
  setting.run_until = model::RunUntil::time_limit;
  setting.time_limit = model::Nanoseconds{600};
  if (*rc::gen::arbitrary<bool>()) {
    setting.phase = drawn_time(0, setting.dds.sedp.heartbeat_period.count());
    // The reader that makes the phase must not cause HEARTBEATs to the other one.
    setting.dds.sedp.heartbeat_recipients = model::HeartbeatRecipients::unacknowledged;
  }
  return setting;
}

TEST(TimelineBridge, EncodingAndMachinesAgree) {
  STORMPROOF_DRAWN("prediction = run", [] {
    const Setting setting = drawn_setting();
    const DrawnNetwork network = DrawnNetwork::draw();
    const auto run = direct(setting, network);
    RC_ASSERT(run.has_value());
    const Prediction seen = observe(*run);
    const Prediction predicted = predict(setting, network);
    RC_ASSERT(seen.received == predicted.received);
    RC_ASSERT(seen.data == predicted.data);
    RC_ASSERT(seen.heartbeats == predicted.heartbeats);
    RC_ASSERT(seen.acknacks == predicted.acknacks);
    RC_ASSERT(seen.last_packet == predicted.last_packet);
  });
}

TEST(TimelineBridge, NoRunIsLaterThanTheBound) {
  STORMPROOF_DRAWN("completion ≤ B(losses, Δ)", [] {
    Setting setting = drawn_setting();
    setting.descriptors = *rc::gen::inRange<std::uint32_t>(1, 5);
    setting.time_limit = model::Nanoseconds{3'000};
    model::SedpProfile& sedp = setting.dds.sedp;
    sedp.grouping = *rc::gen::element(model::Grouping::message, model::Grouping::single);
    sedp.heartbeat_timer =
        *rc::gen::element(model::HeartbeatTimerKind::single, model::HeartbeatTimerKind::additive);
    sedp.piggyback = *rc::gen::element(model::Piggyback::off, model::Piggyback::cumulative);
    sedp.piggyback_threshold_bytes = model::Bytes{*rc::gen::inRange(0, 3'000)};
    if (!setting.phase && *rc::gen::arbitrary<bool>()) {
      sedp.relation_opening = model::RelationOpening::each_side;
    }
    const DrawnNetwork network = DrawnNetwork::draw();
    const auto run = direct(setting, network);
    // Additive timers and many losses make runs too long to look at.
    RC_PRE(run.has_value());
    const auto bound = completion_bound(
        setting.dds, {model::Nanoseconds{network.delta}, std::nullopt, !setting.phase, {}});
    const auto limit = bound->after(network.losses(*run));
    RC_PRE(*limit < setting.time_limit);
    RC_ASSERT(run->completion.has_value());
    RC_ASSERT(*run->completion <= *limit);
  });
}

TEST(TimelineBridge, AWrongEncodingIsNoticed) {
  // The same comparison with timers that are off by one nanosecond fails somewhere.
  const bool agrees = [] {
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
      Setting setting;
      setting.dds.sedp.piggyback = model::Piggyback::off;
      setting.dds.sedp.heartbeat_period = model::Nanoseconds{20};
      setting.dds.sedp.heartbeat_response_delay = model::Nanoseconds{2};
      setting.dds.sedp.nack_response_delay = model::Nanoseconds{3};
      setting.dds.sedp.nack_suppression_duration = model::Nanoseconds{4};
      setting.run_until = model::RunUntil::time_limit;
      setting.time_limit = model::Nanoseconds{600};
      const DrawnNetwork network{8, seed, 30, 5};
      const auto run = direct(setting, network);
      setting.dds.sedp.nack_suppression_duration = model::Nanoseconds{5};
      if (!run || observe(*run) != predict(setting, network)) return false;
    }
    return true;
  }();
  EXPECT_FALSE(agrees);
}

}  // namespace bridge_test
}  // namespace stormproof::timeline
