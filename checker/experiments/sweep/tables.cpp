// CSV as RFC 4180 has it, but with line feeds; JSON with one job a line.
#include "checker/experiments/sweep/tables.hpp"

#include <nlohmann/json.hpp>

namespace stormproof::sweep {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* not_done = "interrupted";

/// A field of CSV, in quotes if it needs them.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string{"\"\""} : std::string{c};
  return quoted + '"';
}

Json number_json(const std::optional<std::int64_t>& number) {
  return number ? Json(*number) : Json(nullptr);
}

Json run_json(const Plan& plan, std::size_t job, const Outcome* outcome) {
  Json json;
  json["keys"] = Json::parse(plan.values_json(job));
  json["digest"] = hex(plan.digest(job));
  json["completed"] = outcome != nullptr && outcome->completed();
  json["end"] = outcome != nullptr ? outcome->end : not_done;
  if (outcome == nullptr) return json;
  if (outcome->failed()) {
    json["error"] = outcome->error;
    return json;
  }
  for (std::size_t k = 0; k < number_names.size(); ++k) {
    const bool is_count = first_count <= k && k < end_of_counts;
    (is_count ? json["counts"] : json)[number_names[k]] = number_json(outcome->numbers[k]);
  }
  return json;
}

}  // namespace

void write_csv(std::ostream& out, const Plan& plan, const Collector& results) {
  for (const std::string& key : plan.keys()) out << field(key) << ',';
  out << "end";
  for (const char* name : number_names) out << ',' << name;
  out << ",digest,error\n";
  for (std::size_t job = 0; job < plan.size(); ++job) {
    const Outcome* outcome = results.outcome(job);
    for (const std::string& value : plan.values(job)) out << field(value) << ',';
    out << (outcome != nullptr ? outcome->end : not_done);
    for (std::size_t k = 0; k < number_names.size(); ++k) {
      out << ',';
      if (outcome != nullptr && outcome->numbers[k]) out << *outcome->numbers[k];
    }
    out << ',' << hex(plan.digest(job)) << ',';
    if (outcome != nullptr) out << field(outcome->error);
    out << '\n';
  }
}

void write_json(std::ostream& out, const Plan& plan, const Collector& results,
                const std::string& program_version) {
  const std::vector<std::string> keys = plan.keys();
  std::size_t completed = 0;
  for (std::size_t job = 0; job < plan.size(); ++job) {
    const Outcome* outcome = results.outcome(job);
    if (outcome != nullptr && outcome->completed()) ++completed;
  }
  out << "{\n\"grid\": " << Json(plan.grid().source).dump()
      << ",\n\"version\": " << Json(program_version).dump() << ",\n\"keys\": " << Json(keys).dump()
      << ",\n\"jobs\": " << plan.size() << ",\n\"completed\": " << completed << ",\n\"runs\": [";
  for (std::size_t job = 0; job < plan.size(); ++job) {
    out << (job == 0 ? "\n" : ",\n") << run_json(plan, job, results.outcome(job)).dump();
  }
  out << "\n]\n}\n";
}

}  // namespace stormproof::sweep
