// Every plan runs the same draws: what processes add to their planned start, how long they take to
// create their endpoints, and what gets lost is that of the seed, whatever the plan.
#include "checker/experiments/launch/launch.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "checker/engines/calculus/calculus.hpp"
#include "checker/engines/calculus/cannot_start.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/experiments/launch/join.hpp"
#include "checker/experiments/trials/under_seed.hpp"
#include "checker/experiments/trials/usual_hosts.hpp"
#include "model/config/scenario_file.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"

namespace stormproof::launch {

using model::Nanoseconds;
using model::Scenario;
using model::config::InputError;
using model::config::Result;
using trials::Sample;

namespace {

constexpr model::Bytes large_send_buffer{4'000'000};

/// The participants that belong to one of the first starts, without the others.
Scenario only_first(Scenario scenario, const std::vector<std::uint32_t>& starts,
                    std::uint32_t below) {
  auto& participants = scenario.deployment.participants;
  std::vector<model::Participant> kept;
  for (std::size_t i = 0; i < participants.size(); ++i) {
    if (starts[i] < below) kept.push_back(participants[i]);
  }
  participants = std::move(kept);
  return scenario;
}

/// The scenario as it starts under a plan; nothing if it was stopped, or a wave is not complete.
std::optional<Scenario> planned(trials::Runner& runner, const Scenario& base, const Plan& plan,
                                std::uint64_t seed, Nanoseconds jitter) {
  Scenario scenario = trials::under_seed(base, seed, jitter);
  follow(plan, base.deployment, scenario);
  if (!plan.waits()) return scenario;
  const std::vector<std::uint32_t> starts = starts_of(scenario.deployment, plan.order);
  auto& participants = scenario.deployment.participants;
  for (std::uint32_t wave = 1; wave <= *std::ranges::max_element(starts); ++wave) {
    const Scenario before = only_first(scenario, starts, wave);
    Nanoseconds complete;
    for (const model::Participant& one : before.deployment.participants) {
      complete = std::max(complete, one.endpoints_done);
    }
    if (before.deployment.has_cross_host_pair()) {
      const auto run = runner.simulate(before);
      if (!run || !run->discovery_time) return std::nullopt;
      complete = std::max(complete, *run->discovery_time);
    }
    for (std::size_t i = 0; i < participants.size(); ++i) {
      if (starts[i] == wave) trials::start_later(participants[i], complete);
    }
  }
  return scenario;
}

/// Of a run whose plan got stuck: it was not complete.
Sample stuck(std::uint64_t seed) {
  Sample sample;
  sample.seed = seed;
  sample.end = model::RunEnd::time_limit;
  sample.health.health = exact::Health::incomplete;
  return sample;
}

/// What storm.cannot-start says of a setting whose programs take no time, for all start times.
void prove(Setting& setting, const std::function<bool(std::string_view)>& on_progress) {
  Scenario scenario = setting.scenario;
  scenario.hosts.reset();
  if (!props::applicability_of(calculus::cannot_start, scenario)
           .is_decided_by(props::Engine::calculus)) {
    return;
  }
  smt::Claims claims{smt::Options{}};
  const std::string_view asked[] = {calculus::cannot_start};
  const auto findings = calculus::check(asked, {scenario, claims, nullptr, 0, 12, on_progress});
  setting.proved = !findings.empty() && findings[0].second.kind == props::VerdictKind::proved;
  if (!findings.empty()) setting.why = findings[0].second.how;
}

class Study {
 public:
  explicit Study(const Request& request)
      : request_{request}, runner_{request.threads, [this](std::size_t runs, std::size_t) {
                                     return goes_on(doing_, runs);
                                   }} {}

  Result<Report> run(const model::config::SpecPath& specs) {
    if (const auto error = settle(specs)) return *error;
    for (Setting& setting : report_.settings) {
      prove(setting, [this](std::string_view what) { return goes_on(what, 0); });
    }
    const auto& own = report_.settings.front().scenario.deployment;
    const std::vector<Plan> plans = plans_for(own, request_.steps, request_.limit);
    about_ = plans.size() * report_.settings.size() * request_.samples;
    for (const Plan& plan : plans) run_plan(plan);
    if (request_.join) {
      doing_ = "one robot more";
      for (const Setting& setting : report_.settings) {
        report_.joins.push_back(join(runner_, setting.scenario, request_));
      }
    }
    report_.interrupted = runner_.stopped();
    return std::move(report_);
  }

 private:
  [[nodiscard]] bool goes_on(std::string_view what, std::size_t runs) const {
    return !request_.on_progress || request_.on_progress(what, runs, std::max(runs, about_));
  }

  std::optional<InputError> settle(const model::config::SpecPath& specs) {
    auto scenario = model::config::read_scenario(request_.scenario, request_.overrides, specs);
    if (!scenario) return scenario.error();
    if (const auto why = props::why_profile_is_not_changed(*scenario); !why.empty()) {
      return InputError{request_.scenario, std::string{why}};
    }
    if (scenario->deployment.life) {
      return InputError{request_.scenario + ": deployment.life",
                        "expected none: a launch plan is about first starts"};
    }
    report_.usual_hosts = trials::lacks_hosts(*scenario);
    if (report_.usual_hosts) {
      scenario = model::config::read_scenario(request_.scenario,
                                              trials::with_usual_hosts(request_.overrides), specs);
      if (!scenario) return scenario.error();
    }
    scenario->time_limit = request_.limit;
    scenario->run_until = model::RunUntil::completion;
    report_.settings.push_back({"as_it_is", "as it is", *scenario, {}, {}});
    if (auto dds = with_large_send_buffer(scenario->dds)) {
      scenario->dds = *std::move(dds);
      report_.settings.push_back({"large_send_buffer", "sendBufferSize 4 MB", *scenario, {}, {}});
    }
    return std::nullopt;
  }

  void run_plan(const Plan& plan) {
    doing_ = words_of(plan);
    Row row{plan, {}, {}};
    row.cells.resize(report_.settings.size());
    auto runs = runner_.run(request_.samples * row.cells.size(), [&](std::size_t k) {
      const Scenario& base = report_.settings[k / request_.samples].scenario;
      const std::uint64_t seed = request_.seed + k % request_.samples;
      return sample_plan(runner_, base, plan, seed, request_.start_jitter);
    });
    std::vector<std::vector<Sample>> by_setting(row.cells.size());
    std::vector<Nanoseconds> last;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (!runs[k]) continue;
      last.push_back(runs[k]->health.last_start);
      by_setting[k / request_.samples].push_back(*std::move(runs[k]));
    }
    for (std::size_t s = 0; s < by_setting.size(); ++s) row.cells[s] = cell_of(by_setting[s]);
    std::ranges::sort(last);
    if (!last.empty()) row.last_start = last[last.size() / 2];
    report_.rows.push_back(std::move(row));
  }

  const Request& request_;
  std::string doing_;
  std::size_t about_ = 0;
  trials::Runner runner_;
  Report report_;
};

}  // namespace

Cell cell_of(std::vector<Sample> runs) {
  Cell cell;
  std::vector<double> completion;
  std::vector<double> messages;
  for (const Sample& run : runs) {
    completion.push_back(statistics::completion_ns(run.discovery_time));
    messages.push_back(static_cast<double>(run.counts.total()));
    if (run.health.health == exact::Health::storm) ++cell.storms;
    if (!run.discovery_time) ++cell.incomplete;
  }
  cell.runs = std::move(runs);
  cell.completion = statistics::quantiles(std::move(completion));
  cell.messages = statistics::quantiles(std::move(messages));
  return cell;
}

std::optional<Sample> sample_plan(trials::Runner& runner, const Scenario& scenario,
                                  const Plan& plan, std::uint64_t seed, Nanoseconds start_jitter) {
  const auto drawn = planned(runner, scenario, plan, seed, start_jitter);
  if (drawn) return trials::sample_run(runner, *drawn, seed, {});
  return runner.stopped() ? std::nullopt : std::optional{stuck(seed)};
}

std::optional<model::DdsProfile> with_large_send_buffer(model::DdsProfile dds) {
  if (model::traits_of(dds).writer != model::Writer::stateful ||
      dds.sedp.piggyback_threshold_bytes >= large_send_buffer) {
    return std::nullopt;
  }
  dds.sedp.piggyback_threshold_bytes = large_send_buffer;
  return dds;
}

std::optional<Report::Place> Report::best(std::optional<std::size_t> setting) const {
  std::optional<Place> best;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t s = 0; s < rows[r].cells.size(); ++s) {
      const Cell& cell = rows[r].cells[s];
      if ((setting && s != *setting) || !cell.completes()) continue;
      const auto median = [this](const Place& at) {
        return *rows[at.row].cells[at.setting].completion.median;
      };
      if (!best || *cell.completion.median < median(*best)) best = Place{r, s};
    }
  }
  if (!best) return best;
  const double within = 1.1 * *rows[best->row].cells[best->setting].completion.median;
  const auto together =
      std::ranges::find_if(rows, [](const Row& row) { return row.plan.order == Order::at_once; });
  if (together == rows.end()) return best;
  for (std::size_t s = 0; s <= best->setting; ++s) {
    const Cell& cell = together->cells[s];
    if ((setting && s != *setting) || !cell.completes()) continue;
    if (*cell.completion.median > within) continue;
    return Place{static_cast<std::size_t>(together - rows.begin()), s};
  }
  return best;
}

Result<Report> launch(const Request& request, const model::config::SpecPath& specs) {
  return Study{request}.run(specs);
}

std::vector<Nanoseconds> starts_in(const Setting& setting, const Plan& plan,
                                   const Request& request) {
  trials::Runner runner{1};
  const auto scenario = planned(runner, setting.scenario, plan, request.seed, {});
  std::vector<Nanoseconds> starts;
  if (!scenario) return starts;
  for (const model::Participant& one : scenario->deployment.participants) {
    starts.push_back(one.start);
  }
  return starts;
}

}  // namespace stormproof::launch
