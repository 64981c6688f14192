// The report for scripts; specs/guide/validating.md explains the keys.
#include <nlohmann/json.hpp>

#include "checker/evidence/validate/validate.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::validate {

namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) {
  if (!value) return nullptr;
  return *value;
}

/// Counts are whole numbers.
Json count_or_null(const std::optional<double>& value) {
  if (!value) return nullptr;
  return static_cast<std::uint64_t>(*value);
}

Json row_json(const Row& row) {
  return {
      {"observed", count_or_null(row.observed)},
      {"model",
       {{"median", or_null(row.median)}, {"low", or_null(row.low)}, {"high", or_null(row.high)}}},
      {"ratio", or_null(row.ratio)},
      {"observation", name_of(row.position)}};
}

Json participants_json(const Report& report) {
  Json list = Json::array();
  for (const CapturedParticipant& one : report.observation.deployment.participants) {
    list.push_back(
        {{"host", one.host},
         {"publications", one.publications},
         {"subscriptions", one.subscriptions},
         {"start_ns", one.start.count()},
         {"announced", one.announced},
         {"last_creation_ns", {one.created_earliest.count(), one.created_latest.count()}},
         {"unevenness_ns", one.unevenness.count()},
         {"creations_seen", one.creations_seen}});
  }
  return list;
}

Json over_time_json(const Report& report) {
  Json json = {{"step_ns", report.observation.growth.step_ns}};
  for (std::size_t curve = 0; curve < growth_curves; ++curve) {
    Json observed = Json::array();
    for (const GrowthPoint& point : report.observation.growth.points) {
      observed.push_back(point[curve]);
    }
    Json median = Json::array();
    Json low = Json::array();
    Json high = Json::array();
    for (const auto& bands : report.bands) {
      median.push_back(bands[curve].median);
      low.push_back(bands[curve].low);
      high.push_back(bands[curve].high);
    }
    json[name_of(figure_of_curve(curve))] = {
        {"observed", observed}, {"median", median}, {"low", low}, {"high", high}};
  }
  return json;
}

}  // namespace

Json to_json(const Report& report, const Heading& heading) {
  const Observation& observation = report.observation;
  Json figures;
  for (const Row& row : report.rows) figures[name_of(row.figure)] = row_json(row);
  Json differences = Json::array();
  for (const Difference& one : report.differences) {
    differences.push_back({{"id", one.id}, {"count", one.count}, {"text", one.text}});
  }
  Json json = {
      {"command", heading.command},
      {"captures", heading.captures},
      {"cut", observation.cut == Cut::given ? "given" : "last_initial"},
      {"first_announcement_ns", observation.deployment.zero_ns},
      {"cut_ns", observation.cut_ns},
      {"complete", observation.complete},
      {"missing", observation.counting.missing_count},
      {"participants", participants_json(report)},
      {"runs",
       {{"wanted", report.wanted},
        {"finished", report.runs},
        {"complete", report.complete},
        {"first_seed", report.request.sampling.first_seed},
        {"loss", report.request.sampling.loss},
        {"drawn", report.is_drawn}}},
      {"figures", figures},
      {"within", report.request.within ? Json(*report.request.within) : Json{}},
      {"agreement", name_of(report.agreement)},
      {"over_time", over_time_json(report)},
      {"differences", differences},
  };
  report::add_unmodelled(json, report.scenario.dds);
  json["scenario"] = model::config::effective_json(report.scenario);
  // Names in a capture are any bytes; what is no UTF-8 is replaced here, not when it is printed.
  return Json::parse(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace stormproof::validate
