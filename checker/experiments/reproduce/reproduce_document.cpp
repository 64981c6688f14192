// A reproduction as a document: every published figure beside the model's, part by part with plots
// in the shape of the paper's figures, then what is known of the differences.
#include <algorithm>
#include <functional>

#include <fmt/core.h>

#include "checker/experiments/reproduce/configuration_blocks.hpp"
#include "checker/experiments/reproduce/plots.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::reproduce {

namespace {

using report::Audience;
using report::Blocks;
using report::Column;
using report::Document;
using report::Paragraph;
using report::Section;
using report::Table;
using report::Text;
using report::Tone;

constexpr auto to_right = Column::Align::right;

std::string part_of(const std::string& id) { return id.substr(0, id.find('.')); }

std::string reason_id(std::size_t reason) { return fmt::format("reason-{}", reason + 1); }

/// The model's value against the published one; nothing if there are several.
std::string comparison_of(const Figure& figure, const ModelValue& model) {
  if (model.ratios.size() != 1) return "";
  if (figure.published.unit != "%") return ratio_text(model.ratios.front());
  return distance_text(model.values.front() - figure.published.values.front());
}

/// Of one figure and variant: the value, and how it compares to the published one.
void add_model(std::vector<Text>& cells, const Figure& figure, const ModelValue& model) {
  const bool asked = figure.kind == Kind::model || figure.kind == Kind::nearest;
  cells.emplace_back(asked ? numbers_text(model.values) : "");
  const std::string ratio = comparison_of(figure, model);
  if (ratio.empty() || model.agreement == Agreement::not_asked) {
    cells.emplace_back(ratio);
  } else if (model.agreement == Agreement::close) {
    cells.push_back(report::badge(Tone::good, ratio));
  } else {
    cells.push_back(report::badge(Tone::warn, ratio, "≠"));
  }
}

Text remark_of(const Figure& figure) {
  Text text = figure.kind == Kind::nearest       ? "~"
              : figure.kind == Kind::input       ? "taken over"
              : figure.kind == Kind::unavailable ? "not from a model"
                                                 : "";
  for (const std::size_t k : figure.reasons) {
    text += (text.empty() ? "" : " ") + report::link(fmt::format("[{}]", k + 1), reason_id(k));
  }
  return text;
}

/// The published figures of one part of the file, with the model's values.
Table figure_table(const Report& report, const std::string& part) {
  Table table{{{part}, {"published", to_right}}, {}};
  table.wide = true;
  for (std::size_t v = 0; v < report.results.plan.variants.size(); ++v) {
    table.columns.push_back({fmt::format("({})", v + 1), to_right});
    table.columns.push_back({"ratio", to_right});
  }
  table.columns.push_back({""});
  for (const Figure& figure : report.figures) {
    const std::string& id = figure.published.id;
    if (part_of(id) != part) continue;
    const std::string unit = figure.published.unit.empty() ? "" : " " + figure.published.unit;
    Table::Row row{{id == part ? id : id.substr(part.size() + 1),
                    report::strong(published_text(figure.published.values) + unit)}};
    for (const ModelValue& model : figure.models) add_model(row.cells, figure, model);
    row.cells.push_back(remark_of(figure));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// A section of the report: parts of the published file, and drawings.
class Part {
 public:
  Part(const Report& report, std::string title, std::vector<std::string>& shown)
      : report_{report}, shown_{shown} {
    section_.title = std::move(title);
  }

  Part& drawn(std::string svg) {
    section_.blocks.emplace_back(report::Drawing{std::move(svg), ""}, Audience::page);
    return *this;
  }
  Part& for_each_variant(const std::function<std::string(std::size_t)>& draw) {
    for (std::size_t v = 0; v < report_.results.plan.variants.size(); ++v) drawn(draw(v));
    return *this;
  }
  Part& table(const std::string& part) {
    shown_.push_back(part);
    section_.blocks.emplace_back(figure_table(report_, part));
    return *this;
  }
  Part& says(std::string text) {
    section_.blocks.emplace_back(Paragraph{std::move(text)}, Audience::documents);
    return *this;
  }
  void into(Blocks& blocks) { blocks.emplace_back(std::move(section_)); }

 private:
  const Report& report_;
  std::vector<std::string>& shown_;
  Section section_;
};

void add_parts(Blocks& blocks, const Report& report) {
  std::vector<std::string> shown;
  const auto part = [&](const char* title) { return Part{report, title, shown}; };
  part("Message counts at N_P 5, N_E 20")
      .drawn(counts_plot(report, Network::wired))
      .drawn(counts_plot(report, Network::wireless))
      .table("repair_amplification")
      .into(blocks);
  part("Wi-Fi / wired over the 90 configurations")
      .for_each_variant([&](std::size_t v) { return surface_plot(report, v); })
      .into(blocks);
  part("Loopback, wired and Wi-Fi")
      .says(
          "Loopback runs have l_P = (N_H − 1)·N_P + 1 participants; SEDP counts are multiplied by "
          "N_H·N_P / l_P, SPDP counts by its square.")
      .for_each_variant([&](std::size_t v) { return environments_plot(report, v, Class::total); })
      .for_each_variant([&](std::size_t v) { return environments_plot(report, v, Class::acknack); })
      .table("loopback_reference_mape_pct")
      .table("loopback_configurations_with_repair")
      .into(blocks);
  part("Completion and messages over the workload")
      .drawn(completion_plot(report))
      .drawn(messages_plot(report))
      .table("open_loop_fraction_high_load")
      .into(blocks);
  part("Means by N_P, and both HEARTBEAT policies")
      .drawn(ratio_plot(report, "completion_s"))
      .drawn(ratio_plot(report, "messages"))
      .for_each_variant([&](std::size_t v) { return policies_plot(report, v); })
      .table("observed_means")
      .into(blocks);
  part("Upper range").table("upper_range").into(blocks);
  part("Orders of service")
      .drawn(spreads_plot(report))
      .table("ordering_policy_spread")
      .into(blocks);
  part("Set-up of the experiments").table("grid").table("high_load").into(blocks);
  for (const Figure& figure : report.figures) {
    const std::string rest = part_of(figure.published.id);
    if (std::ranges::find(shown, rest) == shown.end()) part(rest.c_str()).table(rest).into(blocks);
  }
}

/// Those of no figure are left out at a terminal.
void add_reasons(Blocks& blocks, const Report& report) {
  Section section{"What is known of the differences", "reasons"};
  for (std::size_t k = 0; k < report.published.reasons.size(); ++k) {
    const Reason& reason = report.published.reasons[k];
    std::string only;
    for (const std::string& id : reason.variants) only += (only.empty() ? ": " : ", ") + id;
    const bool used = std::ranges::any_of(report.figures, [k](const Figure& figure) {
      return std::ranges::find(figure.reasons, k) != figure.reasons.end();
    });
    section.blocks.emplace_back(
        Section{fmt::format("[{}]{}", k + 1, only), reason_id(k), {Paragraph{reason.text}}},
        used ? Audience::everybody : Audience::documents);
  }
  blocks.emplace_back(std::move(section));
}

void add_variants(Blocks& blocks, const Report& report) {
  report::Facts facts;
  const Plan& plan = report.results.plan;
  bool ends_early = false;
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    const Variant& variant = plan.variants[v];
    std::size_t runs = 0;
    std::size_t open = 0;
    std::size_t fewest = variant.runs;
    for (const auto& [which, outcome] : report.results.outcomes) {
      if (which.variant != v) continue;
      fewest = std::min(fewest, outcome.runs.size());
      runs += outcome.runs.size();
      open += outcome.runs.size() - outcome.completed();
    }
    std::string text = variant.title;
    ends_early = ends_early || fewest < variant.runs;
    if (fewest < variant.runs) {
      text += fmt::format(", mean of {} to {} draws", fewest, variant.runs);
    } else if (variant.runs > 1) {
      text += fmt::format(", mean of {} draws", variant.runs);
    }
    if (open > 0) {
      text += fmt::format(
          "; {} of {} runs do not complete within 200 s; a mean with one of them does not exist",
          report::grouped(open), report::grouped(runs));
    }
    facts.rows.emplace_back(fmt::format("({}) {}", v + 1, variant.id), std::move(text));
  }
  blocks.emplace_back(std::move(facts));
  if (!ends_early) return;
  blocks.emplace_back(Paragraph{
      "Configurations of one N_P get no more draws once each figure about its means over N_E is "
      "decided, with 95 % confidence; --samples N draws N times."});
}

/// Least and most of what a change of the HEARTBEAT policy brings, over N_P; published and of each
/// variant. It is what the paper proposes, so it comes first.
class PolicyGain {
 public:
  explicit PolicyGain(const Report& report) {
    for (const Figure& figure : report.figures) {
      if (!figure.published.id.ends_with(".completion_change_pct")) continue;
      published_.add(figure.published.values);
      models_.resize(figure.models.size());
      for (std::size_t v = 0; v < models_.size(); ++v) models_[v].add(figure.models[v].values);
    }
  }
  [[nodiscard]] std::string in_words() const {
    Range model;
    for (const Range& one : models_) {
      if (!one.values.empty()) model.add(one.values);
    }
    if (published_.values.empty() || model.values.empty()) return "";
    return fmt::format(
        "response-aware HEARTBEATs change completion by {}, published, and by {} in {}",
        published_.in_words(), model.in_words(),
        models_.size() == 1 ? "the model" : fmt::format("{} variants of it", models_.size()));
  }

 private:
  struct Range {
    std::vector<double> values;

    void add(const std::vector<double>& more) {
      values.insert(values.end(), more.begin(), more.end());
    }
    [[nodiscard]] std::string in_words() const {
      const auto [least, most] = std::ranges::minmax(values);
      return fmt::format("{:+.1f} to {:+.1f} %", least, most);
    }
  };
  Range published_;
  std::vector<Range> models_;
};

/// The main result, and how many figures of how many the first variant meets.
std::string answer_of(const Report& report) {
  if (!report.results.complete) return "Interrupted: values of unfinished cases are missing.";
  const Plan& plan = report.results.plan;
  if (plan.variants.empty()) return "No variant was run.";
  std::size_t close = 0;
  std::size_t asked = 0;
  for (const Figure& figure : report.figures) {
    const Agreement agreement = figure.models.front().agreement;
    close += agreement == Agreement::close ? 1 : 0;
    asked += agreement == Agreement::close || agreement == Agreement::apart ? 1 : 0;
  }
  const std::string gain = PolicyGain{report}.in_words();
  return fmt::format(
      "{}{}{} of the {} figures that a model can have are within a tenth of the "
      "published ones ({}).",
      gain, gain.empty() ? "" : "; ", close, asked, plan.variants.front().id);
}

/// What each later variant meets and the first one, the paper's model, does not; and the reverse.
void add_explained(Blocks& blocks, const Report& report) {
  const Plan& plan = report.results.plan;
  report::Facts facts;
  for (std::size_t v = 1; v < plan.variants.size(); ++v) {
    std::string gained;
    std::size_t lost = 0;
    for (const Figure& figure : report.figures) {
      const Agreement first = figure.models.front().agreement;
      const Agreement own = figure.models[v].agreement;
      if (first == Agreement::apart && own == Agreement::close) {
        gained += (gained.empty() ? "" : ", ") + figure.published.id;
      }
      if (first == Agreement::close && own == Agreement::apart) ++lost;
    }
    facts.rows.emplace_back(
        fmt::format("({}) {}", v + 1, plan.variants[v].id),
        fmt::format("{}; {} the other way round", gained.empty() ? "none" : gained, lost));
  }
  if (facts.rows.empty()) return;
  blocks.emplace_back(
      Section{fmt::format("Figures that are met, and not by {}", plan.variants.front().id),
              "explained",
              {std::move(facts)}});
}

}  // namespace

Document document_of(const Report& report) {
  const Plan& plan = report.results.plan;
  Document document;
  document.title = "The paper's evaluation, reproduced";
  document.complete = report.results.complete;
  document.exit_code = report.results.complete ? 0 : 3;
  document.tone = report.results.complete ? Tone::info : Tone::warn;
  document.subject = fmt::format(
      "The paper's evaluation: {} configurations of {} hosts, published figures and the "
      "model's (stormproof {})",
      plan.configurations.size(), plan.hosts, report.version);
  document.answer = answer_of(report);
  Blocks& blocks = document.blocks;
  add_variants(blocks, report);
  blocks.emplace_back(
      Paragraph{
          "Published figures are those of “When Discovery Becomes a Storm”; no value of the "
          "model is fitted to them. All variants but the last run on wifi-80211n-paper, that one "
          "on "
          "wifi-80211n, where fragments are handed over at once and a sender whose buffer is full "
          "waits. Fast DDS creates its "
          "endpoints over time, so its outcome is a distribution over start times, which the "
          "paper does not print: it is run with everything at time 0, as the paper's model "
          "has it, and with times drawn from ranges that were fitted to live runs on another "
          "machine."},
      Audience::documents);
  blocks.emplace_back(Paragraph{
      "ratio: model / published, and of percentages the difference in points; ✓ within a tenth, ≠ "
      "not. ~: the nearest quantity that can be had from what is printed. [n]: a reason below, "
      "where a value is more than a "
      "tenth away from the published one."});
  add_explained(blocks, report);
  add_parts(blocks, report);
  add_reasons(blocks, report);
  add_configurations(blocks, report);
  return document;
}

}  // namespace stormproof::reproduce
