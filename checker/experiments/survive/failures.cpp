// Lengths are spaced evenly by their logarithm, about three in a decade.
#include "checker/experiments/survive/failures.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/core.h>

#include "checker/presentation/text/numbers.hpp"
#include "model/implementations.hpp"
#include "model/life.hpp"

namespace stormproof::survive {

using model::Life;
using model::Nanoseconds;
using model::Scenario;

namespace {

constexpr Nanoseconds milliseconds(std::int64_t ms) { return Nanoseconds{ms * 1'000'000}; }

struct Words {
  const char* name;
  const char* words;
};
constexpr std::array<Words, 8> names{
    Words{"network_at_start", "the network, while everybody starts"},
    Words{"network", "the network"},
    Words{"host", "one host"},
    Words{"process_killed", "a process that is killed"},
    Words{"process_left", "a process that leaves"},
    Words{"process_gone", "a process that is killed for good"},
    Words{"server_killed", "the server, then a process joins"},
    Words{"unseen_death", "the server, while a process is killed for good"}};

/// Half an announcement period before a lease of which nothing was heard can end, and one after
/// all of them are over.
std::vector<Nanoseconds> around_lease(const Scenario& scenario) {
  const Nanoseconds lease = lease_of(scenario.dds);
  const Nanoseconds period = scenario.dds.spdp.period;
  return {std::max(milliseconds(200), lease - Nanoseconds{period.count() / 2}), lease + period};
}

std::vector<Nanoseconds> usual_lengths(const Scenario& scenario) {
  std::vector<Nanoseconds> lengths = around_lease(scenario);
  for (const std::int64_t ms : {200, 500, 1'000, 3'000, 10'000, 30'000, 60'000, 120'000}) {
    lengths.push_back(milliseconds(ms));
  }
  std::ranges::sort(lengths);
  const auto same = std::ranges::unique(lengths);
  lengths.erase(same.begin(), same.end());
  return lengths;
}

std::uint32_t first_of_last_host(const model::Deployment& deployment) {
  const auto last = std::ranges::max_element(
      deployment.participants, {}, [](const model::Participant& one) { return one.host.value; });
  return static_cast<std::uint32_t>(last - deployment.participants.begin());
}

void cut_off(const Failure& failure, Nanoseconds at, const Scenario& scenario, Life& life) {
  model::Outage cut{.start = at,
                    .end = at + failure.length,
                    .from_reach = model::Reach::all,
                    .to_reach = model::Reach::all};
  if (failure.kind == Kind::host) {
    cut.from_reach = model::Reach::host;
    cut.from = scenario.deployment.participants[first_of_last_host(scenario.deployment)].host.value;
    life.outages.push_back(cut);
    std::swap(cut.from, cut.to);
    std::swap(cut.from_reach, cut.to_reach);
  }
  life.outages.push_back(cut);
}

/// One more like the last process, 1 s later than that.
void join_after(Nanoseconds time, model::Deployment& deployment) {
  model::Participant newcomer = deployment.participants.back();
  const Nanoseconds later = time + milliseconds(1'000) - newcomer.start;
  newcomer.start = newcomer.start + later;
  newcomer.endpoints_done = newcomer.endpoints_done + later;
  if (newcomer.open) newcomer.open = *newcomer.open + later;
  if (newcomer.ready) newcomer.ready = *newcomer.ready + later;
  deployment.participants.push_back(newcomer);
}

}  // namespace

const char* name_of(Kind kind) { return names[static_cast<std::size_t>(kind)].name; }
const char* words_of(Kind kind) { return names[static_cast<std::size_t>(kind)].words; }

std::string words_of(const Failure& failure) {
  if (failure.length.count() == 0) return words_of(failure.kind);
  return fmt::format("{} for {}", words_of(failure.kind), report::duration(failure.length));
}

std::vector<Failure> failures_of(const Scenario& scenario,
                                 const std::vector<Nanoseconds>& lengths) {
  const model::ImplementationTraits& traits = traits_of(scenario.dds);
  const std::vector<Nanoseconds> all = lengths.empty() ? usual_lengths(scenario) : lengths;
  std::vector<Nanoseconds> of_processes = around_lease(scenario);
  of_processes.insert(of_processes.begin(), milliseconds(500));
  if (!lengths.empty()) of_processes = lengths;
  std::vector<Failure> failures;
  const auto add = [&failures](Kind kind, const std::vector<Nanoseconds>& each) {
    for (const Nanoseconds length : each) failures.push_back({kind, length});
  };
  add(Kind::network_at_start,
      lengths.empty() ? std::vector{milliseconds(300), milliseconds(3'000)} : lengths);
  add(Kind::network, all);
  add(Kind::host, all);
  add(Kind::process_killed, of_processes);
  if (traits.says_goodbye) add(Kind::process_left, of_processes);
  add(Kind::process_gone, {Nanoseconds{}});
  if (!traits.has_server) return failures;
  add(Kind::server_killed, all);
  add(Kind::unseen_death, {around_lease(scenario).back()});
  return failures;
}

Scenario with(const Failure& failure, Nanoseconds at, Scenario scenario) {
  Life life;
  const Nanoseconds back = at + failure.length;
  if (failure.kind == Kind::server_killed) join_after(back, scenario.deployment);
  const std::uint32_t server = scenario.deployment.size();
  const std::uint32_t process = first_of_last_host(scenario.deployment);
  switch (failure.kind) {
    case Kind::network_at_start:
    case Kind::network:
    case Kind::host:
      cut_off(failure, at, scenario, life);
      break;
    case Kind::process_killed:
    case Kind::process_left:
      life.restarts.push_back(
          {process, at, back, model::Identity::fresh,
           failure.kind == Kind::process_left ? model::Goodbye::yes : model::Goodbye::no});
      break;
    case Kind::process_gone:
      life.mute.push_back({process, at});
      break;
    case Kind::unseen_death:
      life.mute.push_back({process, at + Nanoseconds{failure.length.count() / 10}});
      [[fallthrough]];
    case Kind::server_killed:
      life.restarts.push_back({server, at, back});
      break;
  }
  scenario.deployment.life = std::move(life);
  return scenario;
}

}  // namespace stormproof::survive
