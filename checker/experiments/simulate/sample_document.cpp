// Sampled runs as a document: the distribution of one profile, or the medians of several side by
// side.
#include <algorithm>

#include <fmt/core.h>

#include "checker/experiments/simulate/distribution_plot.hpp"
#include "checker/experiments/simulate/sample_report.hpp"
#include "checker/experiments/trials/tone_of_health.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/document/unreached.hpp"
#include "checker/presentation/text/figures.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/check/next_steps.hpp"

namespace stormproof::report {

namespace {

using statistics::Quantiles;
using trials::Sample;

using Print = std::string (*)(double);
std::string as_time(double ns) { return report::time_figure(ns); }
std::string as_count(double value) { return report::count_figure(value); }

/// What no run gave is not known; what a run did not come to within its limit is beyond it.
std::string or_beyond(const Quantiles& q, const std::optional<double>& value, Print print) {
  if (q.count == 0) return "–";
  return value ? print(*value) : "> limit";
}

Column number_column(const char* head) { return {head, Column::Align::right}; }

Table distribution(const SampleSummary& s) {
  Table table{{{""},
               number_column("median"),
               number_column("10 %"),
               number_column("90 %"),
               number_column("least"),
               number_column("greatest")},
              {}};
  const auto row = [&table](const char* name, const Quantiles& q, Print print) {
    table.rows.push_back(
        {{name, or_beyond(q, q.median, print), or_beyond(q, q.p10, print),
          or_beyond(q, q.p90, print), or_beyond(q, q.min, print), or_beyond(q, q.max, print)}});
  };
  row("completion", s.discovery_time_ns, as_time);
  for (const model::MessageClass one : model::message_classes) {
    row(words_of(one), s.counts[model::index_of(one)], as_count);
  }
  row("total", s.total, as_count);
  if (s.user_control.max.value_or(0) > 0) row("user control", s.user_control, as_count);
  if (s.lookup.max.value_or(0) > 0) row("lookups", s.lookup, as_count);
  return table;
}

/// How many runs completed in each tenth of the range of completion times.
void add_histogram(Blocks& blocks, const std::vector<Sample>& samples) {
  std::vector<double> times;
  for (const Sample& sample : samples) {
    if (sample.discovery_time) times.push_back(static_cast<double>(sample.discovery_time->count()));
  }
  if (times.size() < 2) return;
  constexpr std::size_t bins = 10;
  const auto [least, greatest] = std::ranges::minmax_element(times);
  const double first = *least;
  const double width = std::max((*greatest - first) / static_cast<double>(bins), 1.0);
  std::vector<std::size_t> count(bins, 0);
  for (const double time : times) {
    ++count[std::min(bins - 1, static_cast<std::size_t>((time - first) / width))];
  }
  const double most = static_cast<double>(*std::ranges::max_element(count));
  Table table{{{"runs by completion time"},
               number_column("runs"),
               {.head = "", .audience = Audience::terminal}},
              {}};
  for (std::size_t k = 0; k < bins; ++k) {
    const double from = first + width * static_cast<double>(k);
    const auto bar = static_cast<std::size_t>(40 * static_cast<double>(count[k]) / most + 0.5);
    table.rows.push_back({{fmt::format("{} – {}", as_time(from), as_time(from + width)),
                           std::to_string(count[k]), std::string(bar, '#')}});
  }
  const std::size_t beyond = samples.size() - times.size();
  if (beyond > 0) {
    table.rows.push_back({{"not within the limit", std::to_string(beyond), ""}});
  }
  blocks.emplace_back(std::move(table));
}

/// One line per profile: the range of completion, and the medians of the counts.
Table side_by_side(const Sampling& sampling) {
  Table table{{{"medians"},
               number_column("complete"),
               number_column("completion [10–90 %]"),
               number_column("repair"),
               number_column("HEARTBEAT"),
               number_column("ACKNACK"),
               number_column("total"),
               number_column("user")},
              {}};
  table.wide = true;
  for (const SampledProfile& profile : sampling.profiles) {
    const SampleSummary s = summarize(profile.samples);
    const Quantiles& t = s.discovery_time_ns;
    const auto count = [](const Quantiles& q) { return or_beyond(q, q.median, as_count); };
    table.rows.push_back({{profile.name, fmt::format("{}/{}", s.completed, s.runs),
                           fmt::format("{} [{}–{}]", or_beyond(t, t.median, as_time),
                                       or_beyond(t, t.p10, as_time), or_beyond(t, t.p90, as_time)),
                           count(s.counts[1]), count(s.counts[2]), count(s.counts[3]),
                           count(s.total), count(s.user_control)}});
  }
  return table;
}

/// Which profile's median is the least.
std::string fastest_text(const Sampling& sampling) {
  const auto median = [](const SampledProfile& profile) {
    return summarize(profile.samples).discovery_time_ns.median;
  };
  const SampledProfile* best = nullptr;
  for (const SampledProfile& one : sampling.profiles) {
    if (median(one) && (best == nullptr || *median(one) < *median(*best))) best = &one;
  }
  if (best == nullptr) return "With no profile half of the runs complete.";
  const auto own = median(sampling.profiles.front());
  std::string text = fmt::format("{} is fastest: discovery completes after {} at the median",
                                 best->name, as_time(*median(*best)));
  if (best != &sampling.profiles.front()) {
    text += fmt::format(", {} {}", sampling.profiles.front().name,
                        own ? "after " + as_time(*own) : "not within the limit");
  }
  return text + ".";
}

std::size_t all_runs(const Sampling& sampling) {
  std::size_t runs = 0;
  for (const SampledProfile& one : sampling.profiles) runs += one.samples.size();
  return runs;
}

/// What makes a run the one of seed K.
std::string seeds_of(const model::Scenario& scenario) {
  std::string text;
  if (scenario.deployment.schedule) text = "--set deployment.schedule.seed=K";
  if (scenario.wireless.loss)
    text += (text.empty() ? "" : " ") + std::string{"--set "} + "wireless.loss.seed=K";
  if (text.empty()) text = "--set hosts.deaf_seed=K";
  return text;
}

}  // namespace

Document document_of(const Sampling& sampling) {
  const SampledProfile& own = sampling.profiles.front();
  const SampleSummary summary = summarize(own.samples);
  const bool drawn = sampling.is_drawn(own.scenario);
  const auto outlook = trials::outlook_of(own.samples);
  const bool alone = sampling.profiles.size() == 1;
  Document document;
  document.title = "stormproof simulate " + sampling.name;
  document.subject =
      drawn ? fmt::format("{}: {} of {} runs, each with its own schedule", sampling.name,
                          own.samples.size(), sampling.wanted)
            : fmt::format("{}: one run with the start times of the scenario", sampling.name);
  const std::size_t made = all_runs(sampling);
  const std::size_t asked = sampling.wanted * sampling.profiles.size();
  const std::string so_far =
      made < asked ? fmt::format("INTERRUPTED after {} of {} runs. ", made, asked) : std::string{};
  if (made == 0) {
    document.answer = so_far;
  } else if (alone) {
    document.answer = so_far + outlook->headline() + ": " + outlook->sentence();
    document.elaboration = fmt::format("{} of {} complete within {}.", summary.completed,
                                       summary.runs, duration(own.scenario.time_limit));
    if (!own.samples.empty()) document.blocks.emplace_back(distribution(summary));
    if (std::string svg = distribution_plot(own.samples, own.scenario.time_limit); !svg.empty()) {
      document.blocks.emplace_back(Drawing{std::move(svg), "The runs by their completion"},
                                   Audience::page);
    }
    add_histogram(document.blocks, own.samples);
  } else {
    document.answer = so_far + fastest_text(sampling);
    document.elaboration = "All profiles run the same start times.";
    document.blocks.emplace_back(side_by_side(sampling));
  }
  for (const SampledProfile& profile : sampling.profiles) {
    document.complete = document.complete && profile.samples.size() == sampling.wanted;
    if (const std::string text = unreached(profile.scenario); !text.empty()) {
      document.blocks.emplace_back(
          Paragraph{alone ? text : fmt::format("{}: {}", profile.name, text), Tone::warn});
    }
    add_unmodelled(document, profile.scenario.dds, alone ? "" : profile.name);
  }
  const bool all = document.complete && summary.completed == sampling.wanted;
  document.tone = !all ? Tone::warn : alone ? tone_of(outlook->health()) : Tone::info;
  if (outlook && alone) {
    document.next = checker::next_steps(sampling.words, own.scenario, *outlook);
  }
  document.exit_code = all ? 0 : 3;
  if (model::is_drawn(own.scenario)) {
    document.blocks.emplace_back(Paragraph{
        fmt::format("One of the runs: {} --samples 1, K from {} to {}", seeds_of(own.scenario),
                    sampling.first_seed, sampling.first_seed + sampling.wanted - 1)});
  }
  return document;
}

}  // namespace stormproof::report
