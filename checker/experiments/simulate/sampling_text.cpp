// The text form of sampled runs: the distribution of one profile, or the medians of several side by
// side.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "checker/experiments/simulate/sampling_report.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::report {

namespace {

using sampling::Quantiles;
using sampling::Sample;

constexpr const char* class_labels[] = {"initial DATA", "repair DATA",    "HEARTBEAT",
                                        "ACKNACK",      "SPDP multicast", "SPDP unicast"};

using Print = std::string (*)(double);
std::string as_time(double ns) {
  return duration(model::Nanoseconds{static_cast<std::int64_t>(std::llround(ns))});
}
std::string as_count(double value) {
  return grouped(static_cast<std::uint64_t>(std::llround(value)));
}

std::string or_beyond(const std::optional<double>& value, Print print) {
  return value ? print(*value) : "> limit";
}

std::string row(const std::string& name, const Quantiles& q, Print print) {
  return fmt::format("{}{}{}{}{}{}\n", left("  " + name, 20), right(or_beyond(q.median, print), 12),
                     right(or_beyond(q.p10, print), 12), right(or_beyond(q.p90, print), 12),
                     right(or_beyond(q.min, print), 12), right(or_beyond(q.max, print), 12));
}

std::string distribution(const SampleSummary& s) {
  std::string text =
      fmt::format("{}{}{}{}{}{}\n", left("", 20), right("median", 12), right("10 %", 12),
                  right("90 %", 12), right("least", 12), right("greatest", 12));
  text += row("completion", s.discovery_time_ns, as_time);
  for (std::size_t k = 0; k < s.counts.size(); ++k)
    text += row(class_labels[k], s.counts[k], as_count);
  text += row("total", s.total, as_count);
  if (s.user_control.max.value_or(0) > 0) text += row("user control", s.user_control, as_count);
  return text;
}

/// How many runs completed in each tenth of the range of completion times.
std::string histogram(const std::vector<Sample>& samples) {
  std::vector<double> times;
  for (const Sample& sample : samples) {
    if (sample.discovery_time) times.push_back(static_cast<double>(sample.discovery_time->count()));
  }
  if (times.size() < 2) return "";
  constexpr std::size_t bins = 10;
  const auto [least, greatest] = std::minmax_element(times.begin(), times.end());
  const double first = *least;
  const double width = std::max((*greatest - first) / static_cast<double>(bins), 1.0);
  std::vector<std::size_t> count(bins, 0);
  for (const double time : times) {
    ++count[std::min(bins - 1, static_cast<std::size_t>((time - first) / width))];
  }
  const double most = static_cast<double>(*std::max_element(count.begin(), count.end()));
  std::string text = "\nruns by completion time\n";
  for (std::size_t k = 0; k < bins; ++k) {
    const double from = first + width * static_cast<double>(k);
    const auto bar = static_cast<std::size_t>(40 * static_cast<double>(count[k]) / most + 0.5);
    text += fmt::format("  {} – {}{}{}{}\n", right(as_time(from), 9),
                        left(as_time(from + width), 9), right(std::to_string(count[k]), 4),
                        bar == 0 ? "" : "  ", std::string(bar, '#'));
  }
  const std::size_t beyond = samples.size() - times.size();
  if (beyond > 0)
    text += fmt::format("  not within the limit  {}\n", right(std::to_string(beyond), 4));
  return text;
}

/// One line per profile: the range of completion, and the medians of the counts.
std::string side_by_side(const Sampling& sampling) {
  std::size_t width = 15;
  for (const SampledProfile& profile : sampling.profiles) {
    width = std::max(width, profile.name.size() + 2);
  }
  std::string text =
      fmt::format("{}{}{}{}{}{}{}{}\n", left("medians", width), right("complete", 9),
                  right("completion [10–90 %]", 29), right("repair", 8), right("HEARTBEAT", 11),
                  right("ACKNACK", 9), right("total", 9), right("user", 8));
  for (const SampledProfile& profile : sampling.profiles) {
    const SampleSummary s = summarize(profile.samples);
    const Quantiles& t = s.discovery_time_ns;
    const auto count = [](const Quantiles& q) { return or_beyond(q.median, as_count); };
    text += fmt::format("{}{}{}{}{}{}{}{}\n", left(profile.name, width),
                        right(fmt::format("{}/{}", s.completed, s.runs), 9),
                        right(fmt::format("{} [{}–{}]", or_beyond(t.median, as_time),
                                          or_beyond(t.p10, as_time), or_beyond(t.p90, as_time)),
                              29),
                        right(count(s.counts[1]), 8), right(count(s.counts[2]), 11),
                        right(count(s.counts[3]), 9), right(count(s.total), 9),
                        right(count(s.user_control), 8));
  }
  return text;
}

}  // namespace

std::string to_text(const Sampling& sampling) {
  const SampledProfile& own = sampling.profiles.front();
  const SampleSummary summary = summarize(own.samples);
  const bool drawn = own.scenario.deployment.schedule.has_value();
  std::string text =
      drawn ? fmt::format("{}: {} of {} runs, each with its own schedule\n", sampling.name,
                          own.samples.size(), sampling.wanted)
            : fmt::format("{}: one run with the start times of the scenario\n", sampling.name);
  if (sampling.profiles.size() == 1) {
    text += fmt::format("{} of {} complete within {}.\n\n", summary.completed, summary.runs,
                        duration(own.scenario.time_limit));
    text += distribution(summary) + histogram(own.samples);
  } else {
    text += "All profiles run the same start times.\n\n" + side_by_side(sampling);
  }
  for (const SampledProfile& profile : sampling.profiles) {
    const bool alone = sampling.profiles.size() == 1;
    text += unmodelled_text(profile.scenario.dds, alone ? "" : profile.name);
  }
  text += fmt::format("\nReproduce: {}\n", sampling.command);
  if (drawn) {
    text += fmt::format(
        "One of the runs: --set deployment.schedule.seed=K without --samples, K from {} to {}\n",
        sampling.first_seed, sampling.first_seed + sampling.wanted - 1);
  }
  return text;
}

}  // namespace stormproof::report
