// Both runs are the same until the robot starts, so what differs afterwards is its doing.
#include "checker/experiments/launch/join.hpp"

#include "checker/experiments/compare/grown.hpp"
#include "checker/experiments/trials/under_seed.hpp"
#include "model/engine/packet.hpp"
#include "model/probe.hpp"
#include "model/simulator.hpp"

namespace stormproof::launch {

using model::Nanoseconds;
using model::Scenario;

namespace {

constexpr Nanoseconds settled{10'000'000'000};

/// Datagrams between the first participants.
class Among final : public model::Probe {
 public:
  explicit Among(std::uint32_t participants) : participants_{participants} {}

  [[nodiscard]] model::Reports reports() const override {
    model::Reports wanted;
    wanted.set(model::Report::emitted);
    return wanted;
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    if (packet.multicast() || source >= participants_) return;
    for (const std::uint32_t one : destinations) datagrams_ += one < participants_ ? 1 : 0;
  }
  [[nodiscard]] std::uint64_t datagrams() const { return datagrams_; }

 private:
  std::uint32_t participants_;
  std::uint64_t datagrams_ = 0;
};

double difference(std::uint64_t with, std::uint64_t without) {
  return static_cast<double>(with) - static_cast<double>(without);
}

}  // namespace

Join join(trials::Runner& runner, const Scenario& scenario, const Request& request) {
  const std::uint32_t fleet = scenario.deployment.size();
  Scenario larger = scenario;
  larger.deployment = compare::grown(scenario.deployment, compare::Grows::robots,
                                     scenario.deployment.host_count() + 1);
  for (model::Participant& one : larger.deployment.participants) {
    trials::start_later(one, Nanoseconds{} - one.start);
  }
  struct Cost {
    double took, messages, others;
  };
  const auto costs = runner.run(request.samples, [&](std::size_t k) -> std::optional<Cost> {
    Scenario with = trials::under_seed(larger, request.seed + k, request.start_jitter);
    with.deployment.schedule.reset();
    Scenario alone = with;
    alone.deployment.participants.resize(fleet);
    const auto first = runner.simulate(alone);
    if (!first) return std::nullopt;
    Cost cost{statistics::unreached, statistics::unreached, statistics::unreached};
    if (!first->discovery_time) return cost;
    const Nanoseconds joins = *first->discovery_time + settled;
    for (std::uint32_t i = fleet; i < with.deployment.size(); ++i) {
      trials::start_later(with.deployment.participants[i], joins);
    }
    with.time_limit = joins + request.limit;
    Among among_with{fleet};
    const auto run = runner.simulate(with, &among_with);
    if (!run) return std::nullopt;
    if (!run->discovery_time) return cost;
    alone.time_limit = *run->discovery_time;
    alone.run_until = model::RunUntil::time_limit;
    Among among{fleet};
    const auto without = runner.simulate(alone, &among);
    if (!without) return std::nullopt;
    return Cost{static_cast<double>((*run->discovery_time - joins).count()),
                difference(run->counts.total(), without->counts.total()),
                difference(among_with.datagrams(), among.datagrams())};
  });
  Join join;
  std::vector<double> took, messages, others;
  for (const auto& cost : costs) {
    if (!cost) continue;
    ++join.runs;
    took.push_back(cost->took);
    messages.push_back(cost->messages);
    others.push_back(cost->others);
  }
  join.took = statistics::quantiles(std::move(took));
  join.messages = statistics::quantiles(std::move(messages));
  join.others = statistics::quantiles(std::move(others));
  return join;
}

}  // namespace stormproof::launch
