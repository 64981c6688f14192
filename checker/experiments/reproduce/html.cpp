// The report as one HTML page: nothing is loaded from elsewhere, colours follow the viewer's light
// or dark preference.
#include <functional>
#include <set>

#include <fmt/format.h>

#include "checker/experiments/reproduce/measures.hpp"
#include "checker/experiments/reproduce/plots.hpp"
#include "checker/experiments/reproduce/report.hpp"
#include "checker/presentation/diagrams/svg.hpp"
#include "checker/presentation/document/drawings.hpp"

namespace stormproof::reproduce {

namespace {

using draw::xml_text;
using report::Drawings;

constexpr std::string_view page_style = R"(
:root { color-scheme: light dark; --page: #ffffff; --text: #1c2430; --soft: #5c6773;
  --edge: #d5dbe1; --stripe: #f4f6f8; --good: #1b6e43; --off: #a34700; --accent: #1f5fbf; }
@media (prefers-color-scheme: dark) {
  :root { --page: #14181d; --text: #e4e8ec; --soft: #98a3ae; --edge: #3d4650; --stripe: #1d232a;
    --good: #6fd19c; --off: #ffa45c; --accent: #7fb0ff; } }
body { background: var(--page); color: var(--text); margin: 2rem auto; max-width: 1240px;
  padding: 0 1rem; font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.2rem; margin: 2.5rem 0 .5rem;
  border-bottom: 1px solid var(--edge); padding-bottom: .3rem; }
p, li { max-width: 80ch; } a { color: var(--accent); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13px; margin: .8rem 0; }
th, td { padding: .22rem .5rem; text-align: right; white-space: nowrap; }
th { color: var(--soft); font-weight: 600; border-bottom: 1px solid var(--edge);
  white-space: normal; vertical-align: bottom;
  max-width: 11ch; }
th.name { max-width: none; }
th.name, td.name { text-align: left; }
td.name { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, monospace; font-size: 12px; }
tr:nth-child(even) td { background: var(--stripe); }
td.close { color: var(--good); } td.apart { color: var(--off); }
td.published { font-weight: 600; }
td.note { text-align: left; color: var(--soft); }
.plots { display: flex; flex-wrap: wrap; gap: 12px; margin: .8rem 0; }
.plots svg { max-width: 100%; height: auto; border: 1px solid var(--edge); border-radius: 6px; }
code { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, monospace; font-size: 13px; }
.warn { color: var(--off); font-weight: 600; }
summary { cursor: pointer; color: var(--accent); margin: .6rem 0; }
)";

std::string plots(Drawings& drawings, std::initializer_list<std::string> documents) {
  std::string html = "<div class=\"plots\">\n";
  for (const std::string& svg : documents) html += drawings.add(svg);
  return html + "</div>\n";
}

/// One plot for each variant.
std::string plots_of_variants(const Report& report, Drawings& drawings,
                              const std::function<std::string(std::size_t)>& draw) {
  std::string html = "<div class=\"plots\">\n";
  for (std::size_t v = 0; v < report.results.plan.variants.size(); ++v) {
    html += drawings.add(draw(v));
  }
  return html + "</div>\n";
}

std::string section_of(const std::string& id) { return id.substr(0, id.find('.')); }

std::string note_cell(const Figure& figure) {
  std::string text = figure.kind == Kind::nearest ? "nearest" : "";
  if (figure.kind == Kind::input) text = "taken over";
  if (figure.kind == Kind::unavailable) text = "not from a model";
  for (const std::size_t k : figure.reasons) {
    text += fmt::format(" <a href=\"#reason-{0}\">[{0}]</a>", k + 1);
  }
  return "<td class=\"note\">" + text + "</td>";
}

/// The published figures of one part of the file, with the model's values.
std::string figure_table(const Report& report, const std::string& section) {
  std::string html = "<div class=\"scroll\"><table><thead><tr><th class=\"name\">" + section +
                     "</th><th>published</th>";
  for (const Variant& variant : report.results.plan.variants) {
    html += "<th>" + xml_text(variant.id) + "</th><th>ratio</th>";
  }
  html += "<th></th></tr></thead><tbody>\n";
  for (const Figure& figure : report.figures) {
    const std::string& id = figure.published.id;
    if (section_of(id) != section) continue;
    const std::string name = id == section ? id : id.substr(section.size() + 1);
    const std::string unit = figure.published.unit.empty() ? "" : " " + figure.published.unit;
    html += fmt::format(
        "<tr title=\"{}\"><td class=\"name\">{}</td><td class=\"published\">{}</td>",
        xml_text(figure.quantity), xml_text(name), published_text(figure.published.values) + unit);
    for (const ModelValue& model : figure.models) {
      const char* agreement = name_of(model.agreement);
      html += fmt::format("<td class=\"{0}\">{1}</td><td class=\"{0}\">{2}</td>", agreement,
                          model.values.empty() ? "" : numbers_text(model.values),
                          model.ratios.size() == 1 ? ratio_text(model.ratios.front()) : "");
    }
    html += note_cell(figure) + "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string heading(const Report& report) {
  const Plan& plan = report.results.plan;
  std::string html = fmt::format(
      "<h1>The paper's evaluation, reproduced</h1>\n<p>{} configurations of {} hosts; published "
      "figures of “When Discovery Becomes a Storm” beside the model's. No value of the model is "
      "fitted to them. <span style=\"color: var(--good)\">Green</span>: within a tenth of the "
      "published figure; <span style=\"color: var(--off)\">orange</span>: not, and the numbers in "
      "brackets lead to what is known of the reason.</p>\n<ul>\n",
      plan.configurations.size(), plan.hosts);
  for (const Variant& variant : plan.variants) {
    html += fmt::format("<li><code>{}</code>: {}{}</li>\n", xml_text(variant.id),
                        xml_text(variant.title),
                        variant.runs > 1 ? fmt::format(", mean of {} draws", variant.runs) : "");
  }
  html +=
      "</ul>\n<p>All run on <code>wifi-80211n</code>. Fast DDS creates its endpoints over time, "
      "so its outcome is a distribution over start times, which the paper does not print: it "
      "is run with everything at time 0, as the paper's model has it, and with times drawn "
      "from ranges that were fitted to live runs on another machine.</p>\n";
  if (!report.results.complete) {
    html += "<p class=\"warn\">Interrupted: values of unfinished cases are missing.</p>\n";
  }
  return html;
}

std::string sections(const Report& report, Drawings& drawings) {
  const auto table = [&](const char* section) { return figure_table(report, section); };
  std::string html = "<h2>Message counts at N_P 5, N_E 20</h2>\n";
  html += plots(drawings,
                {counts_plot(report, Network::wired), counts_plot(report, Network::wireless)});
  html += table("repair_amplification");
  html += "<h2>Wi-Fi / wired over the 90 configurations</h2>\n";
  html +=
      plots_of_variants(report, drawings, [&](std::size_t v) { return surface_plot(report, v); });
  html +=
      "<h2>Loopback, wired and Wi-Fi</h2>\n<p>Loopback runs have l_P = (N_H − 1)·N_P + 1 "
      "participants; SEDP counts are multiplied by N_H·N_P / l_P, SPDP counts by its "
      "square.</p>\n";
  for (const Class what : {Class::total, Class::acknack}) {
    html += plots_of_variants(report, drawings,
                              [&](std::size_t v) { return environments_plot(report, v, what); });
  }
  html += table("loopback_reference_mape_pct") + table("loopback_configurations_with_repair");
  html += "<h2>Completion and messages over the workload</h2>\n";
  html += plots(drawings, {completion_plot(report), messages_plot(report)});
  html += table("open_loop_fraction_high_load");
  html += "<h2>Means by N_P, and both HEARTBEAT policies</h2>\n";
  html += plots(drawings, {ratio_plot(report, "completion_s"), ratio_plot(report, "messages")});
  html +=
      plots_of_variants(report, drawings, [&](std::size_t v) { return policies_plot(report, v); });
  html += table("observed_means");
  html += "<h2>Upper range</h2>\n" + table("upper_range");
  html += "<h2>Orders of service</h2>\n" + plots(drawings, {spreads_plot(report)}) +
          table("ordering_policy_spread");
  html += "<h2>Set-up of the experiments</h2>\n" + table("grid") + table("high_load");
  return html;
}

/// Parts of the published file that no section above shows.
std::string other_sections(const Report& report) {
  static const std::set<std::string> shown{"repair_amplification",
                                           "loopback_reference_mape_pct",
                                           "loopback_configurations_with_repair",
                                           "open_loop_fraction_high_load",
                                           "observed_means",
                                           "upper_range",
                                           "ordering_policy_spread",
                                           "grid",
                                           "high_load"};
  std::set<std::string> others;
  for (const Figure& figure : report.figures) {
    const std::string section = section_of(figure.published.id);
    if (shown.count(section) == 0) others.insert(section);
  }
  std::string html;
  for (const std::string& section : others) html += figure_table(report, section);
  return html;
}

std::string reasons_html(const Report& report) {
  std::string html = "<h2>What is known of the differences</h2>\n<ol>\n";
  for (std::size_t k = 0; k < report.published.reasons.size(); ++k) {
    const Reason& reason = report.published.reasons[k];
    std::string only;
    for (const std::string& id : reason.variants) {
      only += (only.empty() ? "<code>" : ", <code>") + xml_text(id) + "</code>";
    }
    html += fmt::format("<li id=\"reason-{}\">{}{}</li>\n", k + 1, only.empty() ? "" : only + ": ",
                        xml_text(reason.text));
  }
  return html + "</ol>\n";
}

/// All configurations of one variant on Wi-Fi.
std::string configuration_table(const Report& report, std::size_t variant) {
  const Measures measures{report.results};
  std::string html = fmt::format(
      "<details><summary>All configurations, {}</summary><div class=\"scroll\"><table><thead><tr>"
      "<th>N_P</th><th>N_E</th><th>completion s</th><th>open loop s</th>",
      xml_text(report.results.plan.variants[variant].id));
  for (const Class what : table_classes) html += fmt::format("<th>{}</th>", name_of(what));
  html +=
      "<th>failure-free</th><th>Wi-Fi / wired</th><th>adaptive s</th><th>completed</th></tr>"
      "</thead><tbody>\n";
  for (const Configuration& one : report.results.plan.configurations) {
    const Outcome* outcome = report.results.find(variant, Network::wireless, one);
    if (outcome == nullptr) continue;
    const Outcome* adaptive = report.results.find(
        {variant, Network::wireless, model::HeartbeatPolicy::adaptive, orders[0], one});
    html +=
        fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td>", one.participants_per_host,
                    one.endpoints_per_participant, number_text(outcome->completion_s()),
                    number_text(measures.open_loop_s(variant, one)));
    for (const Class what : table_classes) {
      html += "<td>" + number_text(outcome->messages(what)) + "</td>";
    }
    html += fmt::format("<td>{}</td><td>{}</td><td>{}</td><td>{} of {}</td></tr>\n",
                        number_text(measures.reference_messages(variant, Class::total, one)),
                        number_text(measures.wireless_to_wired(variant, one)),
                        number_text(adaptive ? adaptive->completion_s() : std::nullopt),
                        outcome->completed(), outcome->runs.size());
  }
  return html + "</tbody></table></div></details>\n";
}

}  // namespace

std::string to_html(const Report& report) {
  report::Drawings drawings;
  const std::string shown = sections(report, drawings);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<title>The paper's evaluation, reproduced</title>\n<style>";
  html += page_style;
  html += drawings.style();
  html += "</style>\n</head>\n<body>\n" + drawings.definitions();
  html += heading(report) + shown + other_sections(report) + reasons_html(report);
  html += "<h2>Configurations</h2>\n";
  for (std::size_t v = 0; v < report.results.plan.variants.size(); ++v) {
    html += configuration_table(report, v);
  }
  html += "<p>Reproduce: <code>" + xml_text(report.command) + "</code>, stormproof " +
          xml_text(report.version) + "</p>\n</body>\n</html>\n";
  return html;
}

}  // namespace stormproof::reproduce
