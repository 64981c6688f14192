// Rows are made before they are run and judged after. Dominance among them is that of the medians
// that the report prints.
#include "checker/experiments/tune/comparison.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/experiments/trials/sample_runs.hpp"
#include "model/implementations.hpp"

namespace stormproof::tune {

using model::Scenario;
namespace vendor = model::config::vendor;

namespace {

constexpr const char* send_buffer_key = "dds.sedp.piggyback_threshold_bytes";
constexpr std::int64_t large_send_buffer = 4'000'000;

std::vector<Change> changes_of(const Space& space, const Point& point) {
  std::vector<Change> changes;
  for (const std::size_t d : space.changes(point)) {
    const Dimension& dimension = space.dimensions[d];
    changes.push_back({dimension.key, dimension.setting, dimension.print(dimension.unchanged),
                       dimension.print(point[d]), dimension.note});
  }
  return changes;
}

class RowMaker {
 public:
  RowMaker(const Subject& subject, const Space& space) : subject_{subject}, space_{space} {}

  std::vector<Row> run(const std::vector<Point>& front, const Point& choice) {
    add(Row::Kind::unchanged, "unchanged", space_.unchanged());
    rows_.back().is_choice = choice == space_.unchanged();
    for (const Point& point : front) {
      if (point == space_.unchanged()) continue;
      add(Row::Kind::front, "", point);
      rows_.back().is_choice = point == choice;
    }
    add_send_buffer();
    add_adaptive();
    add_larger_queue(choice);
    return std::move(rows_);
  }

 private:
  void add(Row::Kind kind, const std::string& name, const Point& point) {
    Row row;
    row.kind = kind;
    row.name = name;
    row.point = point;
    row.changes = changes_of(space_, point);
    row.scenario = space_.apply(subject_.scenario, point);
    row.plan = space_.plan(point);
    rows_.push_back(std::move(row));
  }

  void add_send_buffer() {
    const auto d = space_.find(send_buffer_key);
    if (subject_.vendor != vendor::Vendor::fastdds || !d) return;
    if (large_send_buffer > space_.dimensions[*d].maximum) return;
    Point point = space_.unchanged();
    point[*d] = large_send_buffer;
    add(Row::Kind::comparison, "send buffer 4 MB alone", point);
  }

  void add_adaptive() {
    Row row;
    row.kind = Row::Kind::comparison;
    row.name = "adaptive HEARTBEATs";
    row.note = "The paper's adaptive HEARTBEAT policy; it needs a patched library.";
    row.scenario = subject_.scenario;
    const model::Writer writer = model::traits_of(row.scenario.dds).writer;
    if (writer == model::Writer::of_cyclone || writer == model::Writer::of_server) return;
    if (row.scenario.dds.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive) return;
    row.scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
    row.changes.push_back({"dds.sedp.heartbeat_policy", "", "periodic", "adaptive", ""});
    rows_.push_back(std::move(row));
  }

  /// A larger send buffer is also a longer queue of the socket; whether that is so on the user's
  /// machine is for the user to say, so it is shown and not assumed.
  void add_larger_queue(const Point& choice) {
    Scenario scenario = space_.apply(subject_.scenario, choice);
    const model::Bytes buffer = scenario.dds.sedp.piggyback_threshold_bytes;
    model::Bytes& queue = scenario.wireless.source_queue_bytes;
    if (subject_.vendor != vendor::Vendor::fastdds || choice == space_.unchanged()) return;
    if (scenario.wireless.kind != model::ServiceKind::shared_channel || queue >= buffer) return;
    Row row;
    row.kind = Row::Kind::comparison;
    row.name = "chosen, with its queue";
    row.note =
        "The chosen setting, if the socket's queue grows with the send buffer "
        "(wireless.source_queue_bytes); the other rows leave the queue as the scenario has it.";
    row.changes = changes_of(space_, choice);
    row.changes.push_back({"wireless.source_queue_bytes", "", fmt::to_string(queue.count()),
                           fmt::to_string(buffer.count()), ""});
    queue = buffer;
    row.scenario = std::move(scenario);
    row.plan = space_.plan(choice);
    rows_.push_back(std::move(row));
  }

  const Subject& subject_;
  const Space& space_;
  std::vector<Row> rows_;
};

Summary summary_of(const std::vector<Outcome>& outcomes) {
  Summary summary;
  summary.runs = outcomes.size();
  std::vector<double> completion, messages, heartbeat, repair, acknack, spdp;
  for (const Outcome& outcome : outcomes) {
    const model::Counts& counts = outcome.counts;
    completion.push_back(statistics::completion_ns(outcome.completion));
    if (outcome.completion) ++summary.completed;
    messages.push_back(static_cast<double>(counts.total()));
    heartbeat.push_back(static_cast<double>(counts.heartbeat));
    repair.push_back(static_cast<double>(counts.repair_data));
    acknack.push_back(static_cast<double>(counts.acknack));
    spdp.push_back(static_cast<double>(counts.spdp_multicast + counts.spdp_unicast));
  }
  summary.completion_ns = statistics::quantiles(std::move(completion));
  summary.messages = statistics::quantiles(std::move(messages));
  summary.heartbeat = statistics::quantiles(std::move(heartbeat));
  summary.repair_data = statistics::quantiles(std::move(repair));
  summary.acknack = statistics::quantiles(std::move(acknack));
  summary.spdp = statistics::quantiles(std::move(spdp));
  return summary;
}

/// The printed medians.
Cost cost_of(const Row& row) {
  return {row.summary.completion_ns.median.value_or(statistics::unreached),
          row.summary.messages.median.value_or(0)};
}

void describe(Row& row, const std::vector<Outcome>& outcomes) {
  row.summary = summary_of(outcomes);
  row.outlook = trials::outlook_of(outcomes);
  for (const std::string_view id : broken_in(outcomes)) row.broken.emplace_back(id);
}

/// What does not even hold unchanged cannot be asked of others, unless the user does.
void forgive_unchanged(std::vector<Row>& rows, const Options& options, Report& report) {
  if (!options.keep.empty()) return;
  const std::vector<std::string> forgiven = rows.front().broken;
  for (const std::string& id : forgiven) {
    std::erase(report.kept, id);
    report.not_required.push_back(id);
    for (Row& row : rows) std::erase(row.broken, id);
  }
}

/// Leaves out settings of the front that do not belong there.
void drop(std::vector<Row>& rows, Report& report) {
  std::vector<Cost> costs;
  for (const Row& row : rows) {
    if (row.kind != Row::Kind::comparison && row.broken.empty()) costs.push_back(cost_of(row));
  }
  report.dropped = std::erase_if(rows, [&](const Row& row) {
    if (row.kind != Row::Kind::front) return false;
    return !row.broken.empty() || std::ranges::any_of(costs, [&](const Cost& cost) {
      return dominates(cost, cost_of(row));
    });
  });
}

/// Unchanged first, then the front by completion, then the comparisons.
void order(std::vector<Row>& rows) {
  std::ranges::stable_sort(rows, [](const Row& a, const Row& b) {
    if (a.kind != b.kind) return a.kind < b.kind;
    return a.kind == Row::Kind::front && cost_of(a).completion < cost_of(b).completion;
  });
  std::size_t number = 0;
  for (Row& row : rows) {
    if (row.kind == Row::Kind::front) row.name = fmt::format("front {}", ++number);
  }
}

/// The choice; if it was left out, the shortest of the front.
std::optional<std::size_t> recommended(const std::vector<Row>& rows) {
  std::optional<std::size_t> shortest;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].is_choice && rows[k].kind != Row::Kind::comparison) return k;
    if (rows[k].kind == Row::Kind::front && !shortest) shortest = k;
  }
  return shortest;
}

}  // namespace

std::vector<Row> rows_of(const Subject& subject, const Space& space,
                         const std::vector<Point>& front, const Point& choice) {
  return RowMaker{subject, space}.run(front, choice);
}

void judge_rows(std::vector<Row> rows, const std::vector<std::vector<Outcome>>& outcomes,
                const Options& options, Report& report) {
  const std::vector<Outcome>* of_choice = nullptr;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    describe(rows[k], outcomes[k]);
    if (k > 0) rows[k].against_unchanged = difference(outcomes[k], outcomes.front());
    if (rows[k].is_choice) of_choice = &outcomes[k];
  }
  for (std::size_t k = 0; k < rows.size() && of_choice != nullptr; ++k) {
    if (!rows[k].is_choice) {
      rows[k].recommended_against = difference(*of_choice, outcomes[k]);
    }
  }
  forgive_unchanged(rows, options, report);
  drop(rows, report);
  order(rows);
  report.recommended = recommended(rows);
  const bool is_choice = report.recommended && rows[*report.recommended].is_choice;
  if (!is_choice) {  // the differences are those of another setting
    for (Row& row : rows) row.recommended_against.reset();
  }
  const Row* best = report.recommended ? &rows[*report.recommended] : nullptr;
  const bool better = best != nullptr && best->against_unchanged &&
                      is_clearly_less(best->against_unchanged->completion, options.least);
  report.answer = better ? Answer::better : Answer::nothing_better;
  report.rows = std::move(rows);
}

void describe_interrupted(std::vector<Row> rows, const std::map<Point, std::vector<Outcome>>& known,
                          Report& report) {
  std::erase_if(rows, [&](const Row& row) { return !row.point || !known.contains(*row.point); });
  for (Row& row : rows) {
    const std::vector<Outcome>& outcomes = known.at(*row.point);
    describe(row, outcomes);
  }
  order(rows);
  report.recommended = recommended(rows);
  report.rows = std::move(rows);
}

}  // namespace stormproof::tune
