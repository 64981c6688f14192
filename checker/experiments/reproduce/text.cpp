// The report as text: every published figure, the reasons below, and three tables of the 90
// configurations.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "checker/experiments/reproduce/measures.hpp"
#include "checker/experiments/reproduce/report.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::reproduce {

namespace {

using report::left;
using report::right;

constexpr std::size_t name_columns = 34;
constexpr std::size_t published_columns = 17;
constexpr std::size_t model_columns = 20;

std::string model_text(const ModelValue& model) {
  if (model.values.empty()) return "–";
  std::string text = numbers_text(model.values);
  if (model.values.size() == 1) text += "  " + right(ratio_text(model.ratios.front()), 8);
  return text;
}

std::string footnotes(const Figure& figure) {
  std::string text;
  for (const std::size_t k : figure.reasons) text += fmt::format(" [{}]", k + 1);
  return text;
}

/// "observed_means.np1.completion_s" → its first part, and the rest.
std::pair<std::string, std::string> split(const std::string& id) {
  const std::size_t dot = id.find('.');
  return dot == std::string::npos ? std::pair{id, id}
                                  : std::pair{id.substr(0, dot), id.substr(dot + 1)};
}

std::string figure_tables(const Report& report) {
  std::string text;
  std::string section;
  for (const Figure& figure : report.figures) {
    const auto [part, name] = split(figure.published.id);
    if (part != section) {
      section = part;
      text += "\n" + left(part, name_columns) + right("published", published_columns);
      for (std::size_t v = 0; v < figure.models.size(); ++v) {
        text += right(fmt::format("({})   ratio", v + 1), model_columns + 2);
      }
      text += "\n";
    }
    text += left("  " + name, name_columns);
    const std::string unit = figure.published.unit.empty() ? "" : " " + figure.published.unit;
    text += right(published_text(figure.published.values) + unit, published_columns);
    if (figure.kind == Kind::input) {
      text += "  taken over";
    } else if (figure.kind == Kind::unavailable) {
      text += "  not from a model" + footnotes(figure);
    } else {
      for (const ModelValue& model : figure.models) {
        text += "  " + right(model_text(model), model_columns);
      }
      text += (figure.kind == Kind::nearest ? " ~" : "") + footnotes(figure);
    }
    text += "\n";
  }
  return text;
}

std::string reasons_text(const Report& report) {
  std::set<std::size_t> used;
  for (const Figure& figure : report.figures) {
    used.insert(figure.reasons.begin(), figure.reasons.end());
  }
  std::string text;
  for (const std::size_t k : used) {
    const Reason& reason = report.published.reasons[k];
    std::string only;
    for (const std::string& id : reason.variants) only += (only.empty() ? "" : ", ") + id;
    text += report::paragraph(fmt::format("{:>4} ", fmt::format("[{}]", k + 1)),
                              (only.empty() ? "" : only + ": ") + reason.text);
  }
  return text;
}

template <class Value>
std::string grid(const Report& report, const std::string& title, Value value) {
  std::set<std::uint32_t> rows;
  std::set<std::uint32_t> columns;
  for (const Configuration& one : report.results.plan.configurations) {
    rows.insert(one.participants_per_host);
    columns.insert(one.endpoints_per_participant);
  }
  std::string text = "\n" + title + "\n  N_P\\N_E";
  for (const std::uint32_t ne : columns) text += right(std::to_string(ne), 8);
  text += "\n";
  for (const std::uint32_t np : rows) {
    text += left(fmt::format("  {}", np), 9);
    for (const std::uint32_t ne : columns) text += right(number_text(value({np, ne})), 8);
    text += "\n";
  }
  return text;
}

std::string grids(const Report& report, std::size_t variant) {
  const Results& results = report.results;
  const Measures measures{results};
  const std::string& id = results.plan.variants[variant].id;
  return grid(report, fmt::format("Completion on Wi-Fi in s, {}", id),
              [&](const Configuration& one) {
                const Outcome* outcome = results.find(variant, Network::wireless, one);
                return outcome ? outcome->completion_s() : std::nullopt;
              }) +
         grid(report, fmt::format("Total messages on Wi-Fi, {}", id),
              [&](const Configuration& one) {
                const Outcome* outcome = results.find(variant, Network::wireless, one);
                return outcome ? outcome->messages(Class::total) : std::nullopt;
              }) +
         grid(report, fmt::format("Total messages, Wi-Fi / wired, {}", id),
              [&](const Configuration& one) { return measures.wireless_to_wired(variant, one); });
}

/// Which cases did not complete within the limit, and how many.
std::string incomplete(const Report& report) {
  std::string text;
  for (std::size_t v = 0; v < report.results.plan.variants.size(); ++v) {
    std::size_t runs = 0;
    std::size_t open = 0;
    for (const auto& [which, outcome] : report.results.outcomes) {
      if (which.variant != v) continue;
      runs += outcome.runs.size();
      open += outcome.runs.size() - outcome.completed();
    }
    if (open == 0) continue;
    text += fmt::format("  {} of {} runs of {} do not complete within 200 s and are in no mean.\n",
                        report::grouped(open), report::grouped(runs),
                        report.results.plan.variants[v].id);
  }
  return text;
}

}  // namespace

std::string number_text(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return "–";
  const double size = std::abs(*value);
  const std::string sign = *value < 0 ? "-" : "";
  if (size >= 1000 || (size == std::floor(size) && size < 1e6)) {
    if (size >= 1e15) return fmt::format("{:.4g}", *value);
    return sign + report::grouped(static_cast<std::uint64_t>(std::llround(size)));
  }
  if (size >= 100) return fmt::format("{}{:.1f}", sign, size);
  if (size >= 10) return fmt::format("{}{:.2f}", sign, size);
  if (size >= 0.1) return fmt::format("{}{:.3f}", sign, size);
  return fmt::format("{}{:.2g}", sign, size);
}

std::string numbers_text(const std::vector<double>& values) {
  if (values.empty()) return "–";
  if (values.size() == 1) return number_text(values.front());
  return number_text(values.front()) + " … " + number_text(values.back());
}

std::string published_text(const std::vector<double>& values) {
  const auto text = [](double value) {
    const double size = std::abs(value);
    if (size < 1000 || size >= 1e15) return fmt::format("{}", value);
    const double rest = size - std::floor(size);
    const std::string digits = rest == 0 ? "" : fmt::format("{:.1f}", rest).substr(1);
    return (value < 0 ? "-" : "") + report::grouped(static_cast<std::uint64_t>(size)) + digits;
  };
  if (values.empty()) return "–";
  if (values.size() == 1) return text(values.front());
  return text(values.front()) + " … " + text(values.back());
}

std::string ratio_text(std::optional<double> ratio) {
  if (!ratio || !std::isfinite(*ratio)) return "–";
  const double size = std::abs(*ratio);
  if (size < 0.0005) return "0 ×";
  if (size >= 1000) return fmt::format("{:.0f} ×", *ratio);
  return size < 0.01 ? fmt::format("{:.3f} ×", *ratio) : fmt::format("{:.2f} ×", *ratio);
}

std::string to_text(const Report& report) {
  const Plan& plan = report.results.plan;
  std::string text = fmt::format(
      "The paper's evaluation: {} configurations of {} hosts, published figures and the "
      "model's\n\n",
      plan.configurations.size(), plan.hosts);
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    const Variant& variant = plan.variants[v];
    text += fmt::format("  ({}) {}: {}", v + 1, variant.id, variant.title);
    if (variant.runs > 1) text += fmt::format(", mean of {} draws", variant.runs);
    text += "\n";
  }
  text +=
      "  ratio: model / published.  ~: the nearest quantity that can be had from what is "
      "printed.\n";
  text +=
      "  [n]: a reason below, where a value is more than a tenth away from the published one.\n";
  if (!report.results.complete) text += "  Interrupted: values of unfinished cases are missing.\n";
  text += incomplete(report);
  text += figure_tables(report);
  text += "\nWhat is known of the differences\n";
  text += reasons_text(report);
  if (!plan.variants.empty()) text += grids(report, 0);
  text += "\nReproduce: " + report.command + "\n";
  return text;
}

}  // namespace stormproof::reproduce
