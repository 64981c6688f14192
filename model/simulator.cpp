// The event loop: the least event of the one queue, again and again (paper, event evolution).
#include "model/simulator.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "model/composition_of.hpp"
#include "model/cyclone/living_protocol.hpp"
#include "model/cyclone/protocol.hpp"
#include "model/engine/implementation_maker.hpp"
#include "model/engine/network.hpp"
#include "model/engine/run_state.hpp"
#include "model/fastdds/living_protocol.hpp"
#include "model/fastdds/living_server_protocol.hpp"
#include "model/fastdds/protocol.hpp"
#include "model/fastdds/server_protocol.hpp"
#include "model/implementations.hpp"
#include "model/life.hpp"
#include "model/paper/amended_protocol.hpp"
#include "model/paper/protocol.hpp"

namespace stormproof::model {

namespace {

bool concerns_network(EventKind kind) {
  return class_of(kind) != EventClass::protocol || kind == EventKind::source_completion;
}

ImplementationMaker maker_for(Of<comp::paper::Paper>, SameHostPairs same_host) {
  return maker_of<paper::Protocol>(same_host);
}
ImplementationMaker maker_for(Of<comp::amended::Amended>, SameHostPairs same_host) {
  return maker_of<paper::AmendedProtocol>(same_host);
}
ImplementationMaker maker_for(Of<comp::fastdds::FastDds>, SameHostPairs same_host) {
  return maker_of<fastdds::Protocol>(same_host);
}
ImplementationMaker maker_for(Of<comp::server::FastDdsServer>, SameHostPairs same_host) {
  return maker_of<fastdds::ServerProtocol>(same_host);
}
ImplementationMaker maker_for(Of<comp::cyclone::Cyclone>, SameHostPairs same_host) {
  return maker_of<cyclone::Protocol>(same_host);
}

class Simulator {
 public:
  Simulator(const Scenario& scenario, const RunOptions& options, const ImplementationMaker& maker)
      : options_{options},
        run_{scenario, options.probe, options.mutation, maker.same_host},
        network_{run_},
        implementation_{maker.make(run_, network_)} {
    network_.attach(*implementation_);
  }

  RunResult run() {
    if (run_.probe != nullptr) run_.probe->run_started(run_.topology);
    implementation_->start();
    RunResult result;
    result.end = loop();
    report(result);
    return result;
  }

 private:
  RunEnd loop() {
    const std::uint64_t most =
        options_.max_events == 0 ? std::numeric_limits<std::uint64_t>::max() : options_.max_events;
    note_completeness();  // nobody advertises anything
    if (run_.ends_now()) return RunEnd::completed;
    const bool is_plain =
        run_.probe == nullptr && network_.processors() == nullptr && !network_.sender_stalls();
    const bool until_quiet = run_.scenario.run_until == RunUntil::quiescence;
    std::uint64_t pause = std::min(most, RunOptions::progress_interval);
    while (!run_.queue.empty()) {
      const Event event = run_.queue.pop();
      if (event.time > run_.scenario.time_limit) return RunEnd::time_limit;
      run_.now = event.time;
      if (run_.now >= next_start_) note_last_start();
      if (run_.now >= next_failure_) note_last_failure();
      ++events_;
      is_plain ? handle(event) : process(event);
      if (run_.complete() != discovery_time_.has_value()) note_completeness();
      if (discovery_time_ && run_.ends_now()) return RunEnd::completed;
      if (until_quiet && is_over()) return RunEnd::no_more_events;
      if (events_ < pause) continue;
      if (events_ >= most || !report_progress()) return RunEnd::interrupted;
      pause = std::min(most, events_ + RunOptions::progress_interval);
    }
    return RunEnd::no_more_events;
  }

  /// Who is forgotten has to be learned again.
  void note_completeness() {
    if (run_.complete()) {
      discovery_time_ = run_.now;
      until_discovery_ = sent_now();
    } else {
      discovery_time_.reset();
    }
  }
  SentUntil sent_now() const {
    SentUntil sent{run_.counts, run_.user_control, run_.forgotten, 0};
    if (next_failure_ == never) {
      sent.since_last_failure = sent.messages() - sent_before_failure_;
    }
    return sent;
  }

  /// What was sent before it.
  void note_last_start() {
    next_start_ = never;
    sent_before_ = run_.counts.total();
  }

  void note_last_failure() {
    next_failure_ = never;
    sent_before_failure_ = sent_now().messages();
  }

  /// Whether the run ends because nothing is left to do.
  bool is_over() const {
    return run_.queue.is_quiet() &&
           run_.now >= std::max(run_.settled_at, last_failure(run_.scenario.deployment));
  }

  /// What nobody observes, holds or pays for.
  void handle(const Event& event) {
    concerns_network(event.kind) ? network_.handle(event) : implementation_->handle(event);
    network_.settle_drops();
  }

  void process(const Event& event) {
    const bool of_network = concerns_network(event.kind);
    Processors* const processors = network_.processors();
    const auto actor = processors != nullptr ? actor_of(event) : std::nullopt;
    if (actor && !processors->begins(*actor, event)) return;
    if (network_.sender_stalls() && !of_network && waits(event)) {
      if (actor) processors->finish();
      return;
    }
    if (actor && !of_network) processors->act();
    if (run_.who_hears(Report::event_started) != nullptr) run_.probe->event_started(event);
    if (event.kind == EventKind::thread_free)
      processors->handle(event);
    else
      handle(event);
    if (actor) processors->finish();
    if (run_.who_hears(Report::event_finished) != nullptr)
      run_.probe->event_finished(network_.depths());
  }

  /// Whose thread has to handle the event, if one has.
  std::optional<std::uint32_t> actor_of(const Event& event) const {
    if (event.kind == EventKind::reception) {
      if (!network_.processors()->hears(event.detail)) return std::nullopt;
      return event.detail;
    }
    if (concerns_network(event.kind)) return std::nullopt;
    return implementation_->sender_of(event);
  }

  /// Holds the event if its participant stalls.
  bool waits(const Event& event) {
    const std::optional<std::uint32_t> sender = implementation_->sender_of(event);
    if (!sender || !network_.stalls(*sender)) return false;
    network_.hold(*sender, event);
    return true;
  }

  bool report_progress() const {
    if (!options_.on_progress) return true;
    return options_.on_progress(
        {run_.now, events_, run_.missing, run_.topology.required_deliveries()});
  }

  void report(RunResult& result) {
    result.end_time = run_.now;
    result.discovery_time = discovery_time_;
    if (discovery_time_ && run_.scenario.deployment.life) {
      result.recovery_time =
          std::max(Nanoseconds{}, *discovery_time_ - last_failure(run_.scenario.deployment));
    }
    if (run_.scenario.deployment.life) {
      result.until_discovery = discovery_time_ ? until_discovery_ : sent_now();
    }
    if (sent_before_) result.messages_since_last_start = run_.counts.total() - *sent_before_;
    result.counts = run_.counts;
    result.user_control = run_.user_control;
    result.events = events_;
    result.missing_count = run_.missing;
    result.missing = implementation_->missing(RunResult::missing_listed);
    result.useful_deliveries = run_.useful_deliveries;
    result.duplicate_deliveries = run_.duplicate_deliveries;
    network_.report(result);
  }

  const RunOptions& options_;
  RunState run_;
  Network network_;
  std::unique_ptr<Implementation> implementation_;
  std::uint64_t events_ = 0;
  std::optional<Nanoseconds> discovery_time_;
  static constexpr Nanoseconds never{std::numeric_limits<std::int64_t>::max()};
  /// The last start, until it is reached; never without a life.
  Nanoseconds next_start_ =
      run_.scenario.deployment.life ? last_start(run_.scenario.deployment) : never;
  std::optional<std::uint64_t> sent_before_;
  /// The last failure, until it is reached; never without a life.
  Nanoseconds next_failure_ =
      run_.scenario.deployment.life ? last_failure(run_.scenario.deployment) : never;
  std::uint64_t sent_before_failure_ = 0;
  SentUntil until_discovery_;
};

}  // namespace

RunResult simulate(const Scenario& scenario, const RunOptions& options,
                   const ImplementationMaker& maker) {
  if (scenario.deployment.life || announces_to_ports(scenario)) {
    const Scenario living = as_run(scenario);
    return std::make_unique<Simulator>(living, options, maker)->run();
  }
  return std::make_unique<Simulator>(scenario, options, maker)->run();
}

RunResult simulate(const Scenario& scenario, const RunOptions& options) {
  if (is_living(scenario)) {
    const SameHostPairs same_host = same_host_pairs(scenario.dds);
    const ImplementationTraits& traits = traits_of(scenario.dds);
    return simulate(scenario, options,
                    traits.has_event_thread ? maker_of<cyclone::LivingProtocol>(same_host)
                    : traits.has_server     ? maker_of<fastdds::LivingServerProtocol>(same_host)
                                            : maker_of<fastdds::LivingProtocol>(same_host));
  }
  const auto maker = [&](auto composition) {
    return maker_for(composition, same_host_pairs(scenario.dds));
  };
  return simulate(scenario, options, visit_composition(scenario.dds, maker));
}

}  // namespace stormproof::model
