// `stormproof validate`: predicts the discovery that a capture shows, and puts the model beside the
// observation, figure by figure and over time (specs/guide/validating.md).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/validate/differences.hpp"
#include "checker/evidence/validate/observation.hpp"
#include "checker/evidence/validate/predicted_runs.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "model/config/tree/result.hpp"
#include "model/scenario.hpp"

namespace stormproof::validate {

struct Request {
  std::string dds;                         ///< name or path of a profile
  std::string wireless;                    ///< name or path of a profile
  std::vector<std::string> overrides;      ///< key.path=value of the scenario
  std::optional<std::int64_t> until_ns{};  ///< ns since 1970; see Cut
  /// Instead of what the capture proves: range of the last creation of each participant, since the
  /// first announcement of all.
  std::optional<std::pair<model::Nanoseconds, model::Nanoseconds>> endpoints_done{};
  std::optional<double> within{};  ///< a factor > 1
  /// Of participants that a capture cannot show, as they are on the host of their Discovery Server.
  RunRecord record{};
  Sampling sampling{};
};

/// Where an observation lies.
enum class Position : std::uint8_t {
  unknown,  ///< no range: one side has no figure, nothing is drawn, or too few runs completed
  below,
  inside,
  above
};
[[nodiscard]] const char* name_of(Position position);

/// One figure on both sides; absent if it falls among unreached values.
struct Row {
  Figure figure{};
  std::optional<double> observed{};
  std::optional<double> median{};
  std::optional<double> low{};   ///< 5 % quantile
  std::optional<double> high{};  ///< 95 % quantile
  std::optional<double>
      ratio{};  ///< median / observed; absent if either is, or nothing is observed
  Position position = Position::unknown;
};

/// `values` may be unreached.
[[nodiscard]] Row row(Figure figure, std::optional<double> observed, std::vector<double> values,
                      bool is_drawn);

/// Median and 5–95 % range of the model's counts at one instant.
struct Band {
  double median = 0;
  double low = 0;
  double high = 0;
};

enum class Agreement : std::uint8_t {
  not_asked,
  within,  ///< completion and messages are off by at most the factor
  beyond,
  undecided  ///< the observation is incomplete, or the model has no median
};
[[nodiscard]] const char* name_of(Agreement agreement);

/// What `--within` asks of completion and messages, given their rows.
[[nodiscard]] Agreement agreement(const std::vector<Row>& rows, bool observation_is_complete,
                                  std::optional<double> within);

struct Report {
  Request request{};  ///< without its callback
  Observation observation{};
  model::Scenario scenario{};  ///< of the first run
  std::size_t wanted = 0;      ///< runs
  std::size_t runs = 0;        ///< that finished
  std::size_t complete = 0;    ///< of these
  bool is_drawn = false;
  bool usual_hosts = false;  ///< starts are spread, and hosts are the usual ones
  std::vector<Row> rows{};   ///< in the order of Figure
  std::vector<std::array<Band, growth_curves>> bands{};  ///< by step; empty without a run
  std::vector<Difference> differences{};
  Agreement agreement = Agreement::not_asked;
  Limiting limiting{};  ///< what the model's runs waited for

  [[nodiscard]] bool interrupted() const { return runs < wanted; }
  [[nodiscard]] const Row& of(Figure figure) const { return rows[index_of(figure)]; }
};

/// Whether reports have the figure.
[[nodiscard]] bool is_shown(const Report& report, Figure figure);

[[nodiscard]] model::config::Result<Report> validate(const capture::Conversation& conversation,
                                                     const Request& request);

/// What the caller knows beside the report.
struct Heading {
  std::vector<std::string> captures{};
};
/// Without exit code, which only the caller knows.
[[nodiscard]] report::Document document_of(const Report& report, const Heading& heading);
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report, const Heading& heading);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);
/// Cumulative messages over time, a panel for each class.
[[nodiscard]] std::string to_svg(const Report& report);

}  // namespace stormproof::validate
