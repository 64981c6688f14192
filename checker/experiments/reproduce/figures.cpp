// Which of the model's numbers belongs to which published figure, by its path.
#include "checker/experiments/reproduce/figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

#include "checker/experiments/reproduce/measures.hpp"

namespace stormproof::reproduce {

namespace {

using model::HeartbeatPolicy;
using Values = std::vector<double>;

constexpr double percent = 100;

std::vector<std::string> parts_of(const std::string& id) {
  std::vector<std::string> parts;
  std::istringstream text{id};
  for (std::string part; std::getline(text, part, '.');) parts.push_back(part);
  return parts;
}

Values one(std::optional<double> value, double factor = 1) {
  return value ? Values{*value * factor} : Values{};
}

/// The value of the quantity a / b.
Values quotient(std::optional<double> a, std::optional<double> b) {
  return a && b && *b != 0 ? Values{*a / *b} : Values{};
}

class Figures {
 public:
  Figures(const Published& published, const Results& results)
      : published_{published}, results_{results}, measures_{results} {}

  /// The model's numbers for a published figure; none if it has none.
  [[nodiscard]] Values values(const std::string& id, std::size_t variant) const {
    const std::vector<std::string> parts = parts_of(id);
    if (parts[0] == "repair_amplification") return repair_amplification(parts, variant);
    if (parts[0] == "observed_means") return observed_means(parts, variant);
    if (parts[0] == "upper_range") return upper_range(parts, variant);
    if (parts[0] == "ordering_policy_spread") return ordering(parts[1], variant);
    if (parts[0] == "loopback_reference_mape_pct") return loopback(parts[1], variant);
    if (id == "open_loop_fraction_high_load.median_pct") {
      const auto fraction = measures_.open_loop_fraction(variant);
      return fraction ? Values{fraction->median * percent} : Values{};
    }
    if (id == "open_loop_fraction_high_load.iqr_pct") {
      const auto fraction = measures_.open_loop_fraction(variant);
      return fraction ? Values{fraction->q1 * percent, fraction->q3 * percent} : Values{};
    }
    if (id == "loopback_configurations_with_repair") {
      return one(measures_.loopback_configurations_with_repair(variant));
    }
    return {};
  }

 private:
  /// Table "Discovery message counts": N_P 5, N_E 20.
  [[nodiscard]] Values repair_amplification(const std::vector<std::string>& parts,
                                            std::size_t variant) const {
    if (parts[1] == "largest_wireless_to_wired_ratio") {
      return one(measures_.largest_wireless_to_wired(variant));
    }
    const Network network = parts[1] == "wired" ? Network::wired : Network::wireless;
    const Outcome* outcome = results_.find(variant, network, counted);
    if (outcome == nullptr) return {};
    for (const Class what : table_classes) {
      if (parts[2] == name_of(what)) return one(outcome->messages(what));
    }
    return {};
  }

  [[nodiscard]] std::optional<double> mean(const std::string& quantity, HeartbeatPolicy policy,
                                           std::size_t variant, std::uint32_t np) const {
    return quantity == "messages" ? measures_.mean_messages(variant, policy, np)
                                  : measures_.mean_completion_s(variant, policy, np);
  }

  /// "np4" → 4; 0 for the scopes of several N_P.
  [[nodiscard]] static std::uint32_t participants(const std::string& scope) {
    return scope.rfind("np", 0) == 0 ? static_cast<std::uint32_t>(std::atoi(scope.c_str() + 2)) : 0;
  }

  /// Table "Topology-Balanced Adaptation Summary".
  [[nodiscard]] Values observed_means(const std::vector<std::string>& parts,
                                      std::size_t variant) const {
    const std::uint32_t np = participants(parts[1]);
    const std::string quantity = parts[2].rfind("messages", 0) == 0 ? "messages" : "completion_s";
    const auto baseline = mean(quantity, HeartbeatPolicy::periodic, variant, np);
    const auto adaptive = mean(quantity, HeartbeatPolicy::adaptive, variant, np);
    if (parts.size() > 3) return one(parts[3] == "adaptive" ? adaptive : baseline);
    if (!baseline || !adaptive || *baseline == 0) return {};
    return {(*adaptive / *baseline - 1) * percent};
  }

  /// Table "Empirical Upper-Range Behavior": the median ratio model / observed of the covered runs
  /// needs the runs; the ratio of the means is what the published tables give.
  [[nodiscard]] Values upper_range(const std::vector<std::string>& parts,
                                   std::size_t variant) const {
    if (parts.size() < 4 || parts[3] != "median") return {};
    if (parts[1] == "high_load") {
      if (parts[2] != "completion") return {};
      const auto fraction = measures_.open_loop_fraction(variant);
      if (!fraction) return {};
      return {published_.values("open_loop_fraction_high_load.median_pct").front() / percent /
              fraction->median};
    }
    double model = 0;
    double observed = 0;
    for (const double np : published_.values("grid.participants_per_host")) {
      const auto count = static_cast<std::uint32_t>(np);
      if (parts[1] != "all" && participants(parts[1]) != count) continue;
      const std::string quantity = parts[2] == "messages" ? "messages" : "completion_s";
      const auto mine = mean(quantity, HeartbeatPolicy::periodic, variant, count);
      const std::string id =
          "observed_means.np" + std::to_string(count) + "." + quantity + ".baseline";
      if (!mine || published_.find(id) == nullptr) return {};
      model += *mine;
      observed += published_.values(id).front();
    }
    return quotient(model, observed);
  }

  /// "Fit by Message Class": the spreads over the three orders of service.
  [[nodiscard]] Values ordering(const std::string& what, std::size_t variant) const {
    if (what == "completion_median_pct") {
      const auto spreads = measures_.completion_spreads(variant);
      return spreads ? Values{spreads->median * percent} : Values{};
    }
    if (what == "completion_max_pct") {
      return one(measures_.largest_completion_spread(variant), percent);
    }
    if (what == "total_messages_max_pct") {
      return one(measures_.largest_message_spread(variant, Class::total), percent);
    }
    if (what != "recovery_class_max_pct") return {};
    double most = 0;
    for (const Class recovery : {Class::repair_data, Class::heartbeat, Class::acknack}) {
      const auto spread = measures_.largest_message_spread(variant, recovery);
      if (!spread) return {};
      most = std::max(most, *spread);
    }
    return {most * percent};
  }

  [[nodiscard]] Values loopback(const std::string& what, std::size_t variant) const {
    for (const Class each : {Class::total, Class::spdp_multicast, Class::spdp_unicast,
                             Class::heartbeat, Class::acknack}) {
      if (what == name_of(each)) return one(measures_.loopback_error(variant, each), percent);
    }
    return {};
  }

  const Published& published_;
  const Results& results_;
  Measures measures_;
};

ModelValue compared(const std::vector<double>& published, Values values) {
  ModelValue result;
  if (values.size() != published.size()) return result;
  result.agreement = Agreement::close;
  for (std::size_t k = 0; k < values.size(); ++k) {
    result.ratios.push_back(published[k] == 0 ? std::nullopt
                                              : std::optional{values[k] / published[k]});
    if (std::abs(values[k] - published[k]) > close_share * std::abs(published[k])) {
      result.agreement = Agreement::apart;
    }
  }
  result.values = std::move(values);
  return result;
}

}  // namespace

const char* name_of(Agreement agreement) {
  switch (agreement) {
    case Agreement::close:
      return "close";
    case Agreement::apart:
      return "apart";
    case Agreement::no_value:
      return "no_value";
    case Agreement::not_asked:
      return "not_asked";
  }
  std::abort();
}

std::vector<Figure> compare(const Published& published, const Results& results) {
  const Figures figures{published, results};
  std::vector<Figure> all;
  for (const PublishedFigure& one : published.figures) {
    const Note& note = published.note_of(one.id);
    Figure figure{one, note.kind, note.quantity, {}, {}};
    std::set<std::size_t> reasons;
    if (note.kind == Kind::unavailable) figure.reasons = published.reasons_of(one.id, "");
    const bool asked = note.kind == Kind::model || note.kind == Kind::nearest;
    for (std::size_t v = 0; v < results.plan.variants.size(); ++v) {
      ModelValue value;
      value.agreement = Agreement::not_asked;
      if (asked) value = compared(one.values, figures.values(one.id, v));
      if (value.agreement == Agreement::apart) {
        value.reasons = published.reasons_of(one.id, results.plan.variants[v].id);
        reasons.insert(value.reasons.begin(), value.reasons.end());
      }
      figure.models.push_back(std::move(value));
    }
    figure.reasons.insert(figure.reasons.end(), reasons.begin(), reasons.end());
    all.push_back(std::move(figure));
  }
  return all;
}

}  // namespace stormproof::reproduce
