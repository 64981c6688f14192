// The run is made twice: the first one says how long it takes.
#include "checker/page/recording.hpp"

#include <algorithm>
#include <optional>

#include "checker/page/knowledge.hpp"
#include "model/engine/packet.hpp"
#include "model/simulator.hpp"

namespace stormproof::page {

namespace {

using model::Report;

class Camera final : public model::Probe {
 public:
  Camera(const model::Scenario& scenario, model::Nanoseconds end, std::size_t pictures)
      : participants_{scenario.deployment.size()},
        knowledge_{scenario},
        end_{end},
        wanted_{static_cast<std::int64_t>(pictures)} {}

  [[nodiscard]] model::Reports reports() const override {
    model::Reports reports;
    for (const Report one : {Report::event_started, Report::event_finished, Report::transition,
                             Report::reader_transition, Report::emitted, Report::received}) {
      reports.set(one);
    }
    return reports;
  }
  [[nodiscard]] bool wants_single_packets() const override { return false; }

  void run_started(const model::Topology& topology) override {
    topology_.emplace(topology);
    knowledge_.run_started(*topology_);
    now_.missing = topology.required_deliveries();
  }
  void event_started(const model::Event& event) override {
    while (event.time > next_time()) take();
    ++now_.events;
  }
  void event_finished(const model::Depths& depths) override {
    now_.missing = depths.missing;
    now_.waiting = std::max(now_.waiting, depths.waiting);
    now_.backlog = std::max(now_.backlog, depths.backlog_packets);
  }
  void transition(const model::Transition& fired) override { knowledge_.transition(fired); }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    now_.sent[static_cast<std::size_t>(model::traffic_class(packet))] += packet.copies;
  }
  void received(const model::Packet& packet, std::uint32_t) override {
    knowledge_.received(packet);
  }

  /// The end of the run, in the middle of whose last event the run may have been complete.
  void finish(const model::RunResult& result) {
    while (taken_ < wanted_) {
      now_.missing = result.missing_count;
      take();
    }
  }

  std::vector<Picture> pictures;
  std::vector<std::uint8_t> known;

 private:
  [[nodiscard]] model::Nanoseconds next_time() const {
    return model::Nanoseconds{end_.count() / wanted_ * (taken_ + 1) +
                              end_.count() % wanted_ * (taken_ + 1) / wanted_};
  }

  void take() {
    now_.time = next_time();
    pictures.push_back(now_);
    now_.waiting = now_.backlog = 0;
    const std::size_t first = known.size();
    known.resize(first + std::size_t{participants_} * participants_);
    for (std::uint32_t pair = 0; pair < topology_->pair_count(); ++pair) {
      const model::Pair& ends = topology_->pair(pair);
      if (std::max(ends.source, ends.destination) >= participants_) continue;  // a server
      const std::uint64_t all = std::max(knowledge_.all(pair), 1U);
      known[first + std::size_t{ends.source} * participants_ + ends.destination] =
          static_cast<std::uint8_t>(255 * std::uint64_t{knowledge_.known(pair)} / all);
    }
    ++taken_;
  }

  const std::uint32_t participants_;
  Knowledge knowledge_;
  const model::Nanoseconds end_;
  const std::int64_t wanted_;
  std::int64_t taken_ = 0;
  std::optional<model::Topology> topology_;  // the run's own ends with it
  Picture now_;
};

}  // namespace

Recording record(const model::Scenario& scenario, std::size_t pictures) {
  Recording recording;
  recording.result = model::simulate(scenario);
  Camera camera{scenario, recording.result.end_time, std::max<std::size_t>(pictures, 1)};
  model::RunOptions options;
  options.probe = &camera;
  (void)model::simulate(scenario, options);
  camera.finish(recording.result);
  recording.pictures = std::move(camera.pictures);
  recording.known = std::move(camera.known);
  return recording;
}

}  // namespace stormproof::page
