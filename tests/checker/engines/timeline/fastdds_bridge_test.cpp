// Fast DDS's machines keep to their completion bound, with descriptors that exist when the relation
// opens and with descriptors that are created later.
#include "tests/checker/engines/timeline/drawn_runs.hpp"

namespace stormproof::timeline {
namespace fastdds_bridge_test {

TEST(TimelineBridge, FastDdsIsNotLaterThanItsBound) {
  STORMPROOF_DRAWN("completion ≤ B(losses, Δ)", [] {
    Setting setting;
    setting.dds.implementation = model::ImplementationKind::fastdds;
    model::SedpProfile& sedp = setting.dds.sedp;
    sedp.heartbeat_period = drawn_time(1, 40);
    sedp.heartbeat_response_delay = drawn_time(0, 8);
    sedp.nack_response_delay = drawn_time(0, 8);
    sedp.nack_suppression_duration = drawn_time(0, *rc::gen::element(8, 60));
    sedp.initial_acknack_delay = drawn_time(0, *rc::gen::element(0, 30));
    sedp.initial_acknack_interval = *rc::gen::element(model::InitialAckNackInterval::doubling,
                                                      model::InitialAckNackInterval::constant);
    sedp.piggyback = *rc::gen::element(model::Piggyback::off, model::Piggyback::cumulative);
    sedp.piggyback_threshold_bytes = model::Bytes{*rc::gen::inRange(0, 3'000)};
    setting.descriptors = *rc::gen::inRange<std::uint32_t>(0, 3);
    setting.endpoints_done = drawn_time(0, 100);
    setting.time_limit = model::Nanoseconds{4'000};
    const DrawnNetwork network = DrawnNetwork::draw();
    const auto run = direct(setting, network);
    RC_ASSERT(run.has_value());
    const auto bound =
        completion_bound(setting.dds, {model::Nanoseconds{network.delta}, {}, false, {}});
    const auto limit = bound->after(network.losses(*run));
    // From when everything has been created and both sides have matched.
    const model::Nanoseconds from =
        std::max(setting.endpoints_done, run->opened) - run->opened + *limit;
    RC_PRE(from < setting.time_limit);
    RC_ASSERT(run->completion.has_value());
    RC_ASSERT(*run->completion <= from);
  });
}

}  // namespace fastdds_bridge_test
}  // namespace stormproof::timeline
