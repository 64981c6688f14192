// The report as CSV: a line for each published figure and variant, and one for each configuration.
#include <cmath>

#include <fmt/core.h>

#include "checker/experiments/reproduce/measures.hpp"
#include "checker/experiments/reproduce/reproduce_report.hpp"
#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/knobs/wireless_knobs.hpp"

namespace stormproof::reproduce {

namespace {

/// A field of a CSV line.
std::string csv(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string{"\"\""} : std::string{c};
  return quoted + "\"";
}

std::string csv(std::optional<double> value) {
  return value && std::isfinite(*value) ? fmt::format("{:.10g}", *value) : "";
}

}  // namespace

std::string figures_csv(const Report& report) {
  std::string text = "figure,published,unit,kind,variant,model,ratio,agreement,quantity,reasons\n";
  for (const Figure& figure : report.figures) {
    // One line for each number: quartiles have two, lists of sizes more.
    for (std::size_t n = 0; n < figure.published.values.size(); ++n) {
      const std::string id = figure.published.values.size() == 1
                                 ? figure.published.id
                                 : fmt::format("{}.{}", figure.published.id, n);
      for (std::size_t v = 0; v < figure.models.size(); ++v) {
        const ModelValue& model = figure.models[v];
        const bool has = n < model.values.size();
        std::string reasons;
        for (const std::size_t k :
             figure.kind == Kind::unavailable ? figure.reasons : model.reasons) {
          reasons += (reasons.empty() ? "" : " ") + report.published.reasons[k].text;
        }
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", id,
                            csv(std::optional{figure.published.values[n]}), figure.published.unit,
                            name_of(figure.kind), report.results.plan.variants[v].id,
                            csv(has ? std::optional{model.values[n]} : std::nullopt),
                            csv(has ? model.ratios[n] : std::nullopt), name_of(model.agreement),
                            csv(figure.quantity), csv(reasons));
      }
    }
  }
  return text;
}

std::string configurations_csv(const Report& report) {
  const Measures measures{report.results};
  std::string text =
      "variant,network,heartbeat_policy,order,participants_per_host,endpoints_per_participant,runs,"
      "completed,completion_s,fastest_s,slowest_s,spdp,initial_data,repair_data,heartbeat,acknack,"
      "total,open_loop_s,failure_free_total,wireless_to_wired\n";
  for (const auto& [which, outcome] : report.results.outcomes) {
    const Configuration& one = which.configuration;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}",
                        report.results.plan.variants[which.variant].id, name_of(which.network),
                        model::config::name_of(which.policy), model::config::name_of(which.order),
                        one.participants_per_host, one.endpoints_per_participant,
                        outcome.runs.size(), outcome.completed(), csv(outcome.completion_s()),
                        csv(outcome.fastest_s()), csv(outcome.slowest_s()));
    for (const Class what : table_classes) text += "," + csv(outcome.messages(what));
    const bool wireless = which.network == Network::wireless;
    text += fmt::format(
        ",{},{},{}\n", wireless ? csv(std::optional{measures.open_loop_s(which.variant, one)}) : "",
        csv(std::optional{measures.reference_messages(which.variant, Class::total, one)}),
        wireless ? csv(measures.wireless_to_wired(which.variant, one)) : "");
  }
  return text;
}

}  // namespace stormproof::reproduce
