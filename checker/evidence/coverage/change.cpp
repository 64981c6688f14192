// Reads it, runs it, and says what came of it.
#include "checker/evidence/coverage/change.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "checker/evidence/coverage/row.hpp"
#include "checker/evidence/coverage/start_times.hpp"
#include "checker/experiments/statistics/completion.hpp"
#include "model/implementations.hpp"
#include "model/life.hpp"

namespace stormproof::prediction {

namespace {

constexpr const char* time_in_ms = "a time in ms from 0 to 3600000";

/// "all", as it is if absent, or "host N".
void read_scope(Row& row, Observation& run) {
  const std::string scope = row.text("outage_scope").value_or("all");
  if (scope == "all") return;
  constexpr std::string_view host = "host ";
  std::uint32_t number = 0;
  const char* const end = scope.data() + scope.size();
  const bool named = scope.starts_with(host);
  const auto read = std::from_chars(scope.data() + (named ? host.size() : 0), end, number);
  if (!named || read.ec != std::errc{} || read.ptr != end || number >= run.hosts) {
    return row.fail("outage_scope", fmt::format("all, or host N with N up to {}", run.hosts - 1));
  }
  run.change.cut_off = number;
}

void read_departure(Row& row, Observation& run) {
  if (!row.has("leave")) return;
  const Json& leave = row.json()["leave"];
  if (!leave.is_object()) {
    return row.fail("leave", "an object with host, id, how, at_ms and, if another comes, back");
  }
  Row fields{leave};
  Departure gone;
  gone.host = fields.count("host", 0, run.hosts - 1);
  gone.id = fields.count("id", 0, run.participants_per_host - 1);
  const std::string how = fields.text("how").value_or("");
  if (how != "kill" && how != "leave") fields.fail("how", "kill or leave");
  gone.says_so = how == "leave";
  const auto planned = fields.number("at", 0, Row::max_ms, time_in_ms);
  const auto at = fields.number("at_ms", 0, Row::max_ms, time_in_ms);
  if (!at && !planned) fields.fail("at_ms", "when it went, in ms");
  gone.at = at ? *at : planned.value_or(0);
  if (const auto back = fields.number("back", 0, Row::max_ms, "how much later in ms another comes"))
    gone.planned_return = planned.value_or(gone.at) + *back;
  if (!fields.error().empty()) return row.fail("leave", "in it: " + fields.error());
  run.change.departure = gone;
}

std::optional<double>& value_of(Observation& run, Measure measure) {
  return run.values[statistics::index_of(measure)];
}

/// Messages that any host sent in a phase.
std::optional<double> sent_in(const Json& phases, const char* name) {
  const auto phase = phases.find(name);
  if (phase == phases.end() || !phase->is_object() || !phase->contains("sent")) return std::nullopt;
  const Json& sent = (*phase)["sent"];
  if (!sent.is_object() || !sent.contains("total") || !sent["total"].is_number()) {
    return std::nullopt;
  }
  return sent["total"].get<double>();
}

void read_phases(Row& row, Observation& run) {
  if (!row.has("phases")) return;
  const Json& phases = row.json()["phases"];
  constexpr std::pair<Measure, const char*> names[] = {{Measure::messages_before, "before"},
                                                       {Measure::messages_during, "during"},
                                                       {Measure::messages_after, "after"}};
  if (!phases.is_object()) return row.fail("phases", "an object with before, during and after");
  for (const auto& [measure, name] : names) value_of(run, measure) = sent_in(phases, name);
}

double messages(const model::Counts& counts) { return static_cast<double>(counts.total()); }

}  // namespace

void read_change(Row& row, Observation& run) {
  run.change.outage = row.range("outage_ms");
  if (run.change.outage) read_scope(row, run);
  read_departure(row, run);
  if (run.change.outage && run.change.departure) {
    row.fail("leave", "an outage or a process that goes, not both");
  }
  if (!run.change.happens()) return;
  value_of(run, Measure::recovery) = row.number("recovery_ms", 0, Row::max_ms, time_in_ms);
  if (row.is_null("recovery_ms")) value_of(run, Measure::recovery) = statistics::unreached;
  constexpr const char* pairs = "a number of ordered pairs";
  value_of(run, Measure::lost_pairs) = row.number("lost_pairs", 0, Row::max_messages, pairs);
  read_phases(row, run);
}

void put(const Change& change, std::uint32_t participants_per_host, model::Scenario& scenario) {
  if (!change.happens()) return;
  model::Life& life = scenario.deployment.life.emplace();
  if (change.outage) {
    model::Outage cut{.start = nanoseconds(change.outage->low),
                      .end = nanoseconds(change.outage->high),
                      .from_reach = model::Reach::all,
                      .to_reach = model::Reach::all};
    if (!change.cut_off) {
      life.outages.push_back(cut);
      return;
    }
    cut.from = *change.cut_off;
    cut.from_reach = model::Reach::host;
    life.outages.push_back(cut);
    std::swap(cut.from, cut.to);
    std::swap(cut.from_reach, cut.to_reach);
    life.outages.push_back(cut);
    return;
  }
  const Departure& gone = *change.departure;
  const std::uint32_t participant = gone.host * participants_per_host + gone.id;
  const model::Nanoseconds at = nanoseconds(gone.at);
  if (gone.back) {
    life.restarts.push_back({participant, at, nanoseconds(*gone.back), model::Identity::fresh,
                             gone.says_so ? model::Goodbye::yes : model::Goodbye::no});
  } else if (gone.says_so) {
    life.leaves.push_back({participant, at});
  } else {
    life.mute.push_back({participant, at});
  }
}

std::optional<ChangedRun> run_changed(trials::Runner& runner, const Change& change,
                                      const model::Scenario& scenario) {
  const auto until = [&](double ms) -> std::optional<model::RunResult> {
    model::Scenario first = scenario;
    first.run_until = model::RunUntil::time_limit;
    first.time_limit = std::max(model::Nanoseconds{1}, nanoseconds(ms) - model::Nanoseconds{1});
    return runner.simulate(first);
  };
  model::Scenario without = scenario;
  without.deployment.life.reset();
  auto whole = runner.simulate(scenario);
  auto undisturbed = runner.simulate(without);
  const auto until_begun = until(change.begins());
  const auto until_over = until(change.over());
  if (!whole || !undisturbed || !until_begun || !until_over) return std::nullopt;
  return ChangedRun{*std::move(whole), *std::move(undisturbed), until_begun->counts,
                    until_over->counts};
}

std::optional<model::Nanoseconds> ChangedRun::first_completion(const Change& change) const {
  const auto& time = undisturbed.discovery_time;
  return time && *time < nanoseconds(change.begins()) ? time : whole.discovery_time;
}

const model::Counts& ChangedRun::sent_at_first(const Change& change) const {
  const bool is_before = first_completion(change) == undisturbed.discovery_time;
  return is_before || !whole.until_discovery ? undisturbed.counts : whole.until_discovery->counts;
}

void add_values(const Change& change, const ChangedRun& run, MeasureValues& values) {
  const auto put = [&values](Measure measure, double value) {
    values[statistics::index_of(measure)] = value;
  };
  put(Measure::recovery, statistics::unreached);
  if (run.whole.discovery_time) {
    const double complete = static_cast<double>(run.whole.discovery_time->count()) / 1e6;
    put(Measure::recovery, std::max(0.0, complete - change.over()));
  }
  const model::SentUntil end = run.whole.until_discovery.value_or(model::SentUntil{});
  const bool is_told = change.departure && change.departure->says_so;
  if (!is_told) put(Measure::lost_pairs, static_cast<double>(end.forgotten));
  const double before = messages(run.until_begun);
  const double until_over = messages(run.until_over);
  put(Measure::messages_before, before);
  if (change.outage) put(Measure::messages_during, until_over - before);
  put(Measure::messages_after, std::max(0.0, messages(end.counts) - until_over));
}

bool is_near(Measure measure, double predicted, double measured) {
  if (measure == Measure::lost_pairs) return predicted == measured;
  constexpr double factor = 1.25;
  constexpr double ms = 300;
  if (measure == Measure::recovery && std::abs(predicted - measured) <= ms) return true;
  return predicted == measured ||
         (predicted <= measured * factor && measured <= predicted * factor);
}

}  // namespace stormproof::prediction
