// The least delay that suffices for its own load, by iteration from 0: the load grows with it.
#include "checker/engines/calculus/closed_loop.hpp"

#include <algorithm>

#include "checker/engines/bounds/completion_bound.hpp"
#include "checker/engines/calculus/cannot_start.hpp"
#include "checker/engines/calculus/closed_loop_parts.hpp"
#include "checker/engines/calculus/threshold.hpp"
#include "model/fastdds/peer_ports.hpp"
#include "model/implementations.hpp"
#include "props/monitors/delay_meter.hpp"
#include "props/monitors/quiescence.hpp"

namespace stormproof::calculus {

namespace {

using model::Nanoseconds;
using model::TrafficClass;

Repairs add_repairs(model::Of<fsm::composition::paper::Paper>, const Lateness& lateness,
                    Flows& flows) {
  return add_repairs_of_the_paper(lateness, flows);
}
Repairs add_repairs(model::Of<fsm::composition::fastdds::FastDds>, const Lateness& lateness,
                    Flows& flows) {
  return add_repairs_of_fastdds(lateness, flows);
}

bool is_stateful(const model::Scenario& scenario) {
  return model::traits_of(scenario.dds).writer == model::Writer::stateful;
}

/// In the sense of `pushes_keep_order`, whichever HEARTBEATs ride in what is pushed.
bool keeps_order(const model::Scenario& scenario, const OpenLoop& open) {
  const bool is_known =
      is_stateful(scenario) || scenario.dds.sedp.piggyback == model::Piggyback::off;
  return pushes_keep_order(scenario.wireless, is_known ? &open : nullptr);
}

std::string not_closed(const model::Scenario& scenario) {
  if (!model::traits_of(scenario.dds).is_known_to_engines) return "no lemma is about its writer";
  if (const char* const gap = uncovered(scenario)) return gap;
  if (!scenario.wireless.lost_packets.empty()) return "packets are lost";
  if (!model::fastdds::announcements_reach_all(scenario)) {
    return "somebody is at no port that announcements go to";
  }
  if (scenario.deployment.life) return "participants that fail or forget have no bound here";
  if (model::rules_of(scenario.dds).heartbeat_timer == model::HeartbeatTimerKind::additive) {
    return "additive HEARTBEAT timers have no rate";
  }
  return {};
}

/// From the last start until everybody has recognised everybody.
Nanoseconds recognition(const model::SpdpProfile& spdp, Nanoseconds delay) {
  if (spdp.resend != model::SpdpResend::none) return delay * 2;
  return delay + std::max(spdp.period, spdp.startup_period);
}

class Loop {
 public:
  Loop(const model::Scenario& scenario, const Omission& omission)
      : scenario_{scenario}, omission_{omission}, flows_{scenario} {
    Omission first = omission;
    first.piggyback = true;  // which HEARTBEATs DATA causes depends on what is repaired
    open_ = open_loop(scenario, first);
    keeps_order_ = keeps_order(scenario, open_);
  }

  /// Pushed DATA that reaches a reader before it is open has to be asked for, after a suppression.
  [[nodiscard]] bool is_received_when_pushed() const {
    if (!is_stateful(scenario_) || is_created_at_once(scenario_.deployment)) return true;
    return keeps_order_ && scenario_.dds.spdp.resend != model::SpdpResend::none;
  }

  /// The load if no packet takes longer.
  const OpenLoop& at(Nanoseconds delay, Repairs& repairs) {
    flows_.traffic = open_;
    const Lateness lateness{scenario_, omission_, keeps_order_, delay};
    repairs = model::visit_engine_composition(scenario_.dds, [&](auto composition) {
      return add_repairs(composition, lateness, flows_);
    });
    return flows_.traffic;
  }

  void iterate(ClosedLoop& loop, Nanoseconds loopback) {
    constexpr std::uint32_t most_steps = 10'000;
    std::int64_t length = 0;
    for (std::uint32_t step = 0; step < most_steps && length <= hour; ++step) {
      const Nanoseconds delay{std::max(length, loopback.count())};
      const std::int64_t next = at(delay, loop.repairs).work(length, delay.count());
      if (next <= length) {
        loop.busy = Nanoseconds{length};
        loop.delay = delay;
        return;
      }
      length = next;
    }
    loop.gap =
        "whatever packets take, up to an hour, the repairs that this allows can keep the channel "
        "busy for longer";
  }

  /// How the load grows with the delay, in the long run.
  [[nodiscard]] std::optional<double> gain() {
    const auto load = [&](std::int64_t delay) {
      Repairs none;
      return at(Nanoseconds{delay}, none).work(delay, delay);
    };
    const std::int64_t most = load(hour);
    if (most == endless) return std::nullopt;
    return static_cast<double>(most - load(hour / 2)) / static_cast<double>(hour / 2);
  }

  [[nodiscard]] std::int64_t first_copies() const {
    std::int64_t sum = 0;
    for (std::uint32_t i = 0; i < flows_.topology.participant_count(); ++i) {
      for (const model::Stream s : model::streams) {
        sum += cross_peers(flows_.topology, i) * flows_.topology.descriptor_count(i, s);
      }
    }
    return sum;
  }

 private:
  const model::Scenario& scenario_;
  const Omission& omission_;
  Flows flows_;
  OpenLoop open_;
  bool keeps_order_ = false;
};

}  // namespace

std::int64_t ClosedLoop::messages(Nanoseconds until) const {
  std::int64_t sum = plus(first, repairs.sent);
  for (const Flow& flow : traffic.flows) {
    if (flow.traffic == TrafficClass::initial_data || flow.traffic == TrafficClass::repair_data ||
        flow.traffic == TrafficClass::user_control) {
      continue;
    }
    sum = plus(sum, times(flow.messages, flow.when.most(until.count(), delay->count())));
  }
  return sum;
}

ClosedLoop closed_loop(const model::Scenario& scenario, const Omission& omission) {
  ClosedLoop loop;
  loop.gap = not_closed(scenario);
  if (!loop.gap.empty()) return loop;
  Loop iteration{scenario, omission};
  if (!iteration.is_received_when_pushed()) {
    loop.gap = "what is pushed can reach a reader that is not open yet";
    return loop;
  }
  loop.first = iteration.first_copies();
  if (scenario.wireless.kind == model::ServiceKind::shared_channel) {
    loop.gain = iteration.gain();
    iteration.iterate(loop, props::loopback_of(scenario));
  } else {
    loop.delay = judge(scenario).delay;
  }
  if (!loop.delay) return loop;
  loop.traffic = iteration.at(*loop.delay, loop.repairs);
  timeline::Circumstances circumstances;
  circumstances.delta = *loop.delay;
  const auto losses = timeline::loss_bound(scenario.dds, circumstances);
  loop.completion =
      recognition(scenario.dds.spdp, *loop.delay) + Nanoseconds{losses.first + losses.exchange};
  if (!is_stateful(scenario)) loop.silence = props::quiescence_bound(scenario.dds, *loop.delay);
  return loop;
}

}  // namespace stormproof::calculus
