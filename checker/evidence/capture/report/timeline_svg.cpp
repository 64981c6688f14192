// The timeline plot: what was sent until each instant, by class.
#include "checker/evidence/capture/summary.hpp"
#include "checker/evidence/capture/timeline.hpp"
#include "checker/presentation/charts/plot.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::capture {

std::string to_svg(const Summary& summary) {
  constexpr std::size_t points = 240;
  constexpr double ns_per_second = 1e9;
  const Conversation& conversation = summary.conversation;
  const Timeline steps = timeline(conversation, summary.counting, summary.end_ns(), points);
  plot::Chart chart;
  chart.title = "Discovery messages in the capture";
  chart.description =
      "Cumulative number of messages of each class over the time since the first "
      "packet";
  chart.x = {.label = "time since the first packet", .min = 0.0, .unit = "s"};
  chart.y = {.label = "messages so far", .min = 0.0};
  chart.width = 760;
  for (std::size_t one = 0; one < message_class_count; ++one) {
    plot::Series series;
    series.name = words_of(static_cast<MessageClass>(one));
    series.mark = plot::Mark::line;
    series.color = one;
    series.x.push_back(0);
    series.y.push_back(0);
    std::uint64_t so_far = 0;
    for (std::size_t k = 0; k < steps.steps.size(); ++k) {
      so_far += steps.steps[k][one];
      series.x.push_back(static_cast<double>(k + 1) * static_cast<double>(steps.step_ns) /
                         ns_per_second);
      series.y.push_back(static_cast<double>(so_far));
    }
    chart.series.push_back(std::move(series));
  }
  if (const auto last = summary.counting.last_initial_ns) {
    chart.references.push_back(
        {.kind = plot::Reference::Kind::vertical,
         .value = static_cast<double>(*last - conversation.first_ns) / ns_per_second,
         .label = "every descriptor sent"});
  }
  return plot::to_svg(chart);
}

}  // namespace stormproof::capture
