// The statistics of the paper's evaluation over the results of many configurations. A statistic
// over cases of which one is missing or incomplete does not exist.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "checker/experiments/reproduce/run.hpp"

namespace stormproof::reproduce {

/// First quartile, median and third quartile.
struct Quartiles {
  double q1 = 0;
  double median = 0;
  double q3 = 0;
};

class Measures {
 public:
  explicit Measures(const Results& results) : results_{results} {}

  /// The mean over the N_E of one N_P, each configuration with equal weight.
  [[nodiscard]] std::optional<double> mean_completion_s(std::size_t variant,
                                                        model::HeartbeatPolicy policy,
                                                        std::uint32_t participants) const;
  [[nodiscard]] std::optional<double> mean_messages(std::size_t variant,
                                                    model::HeartbeatPolicy policy,
                                                    std::uint32_t participants) const;

  /// Total messages on Wi-Fi divided by those on the wired network.
  [[nodiscard]] std::optional<double> wireless_to_wired(std::size_t variant,
                                                        const Configuration& one) const;
  [[nodiscard]] std::optional<double> largest_wireless_to_wired(std::size_t variant) const;

  /// Airtime of everything sent once, in seconds.
  [[nodiscard]] double open_loop_s(std::size_t variant, const Configuration& one) const;
  /// Open-loop airtime divided by the model's completion time, over the high-load configurations.
  [[nodiscard]] std::optional<Quartiles> open_loop_fraction(std::size_t variant) const;

  /// (largest − least) / largest over the three orders of service; 0 if the largest is 0.
  [[nodiscard]] std::optional<double> completion_spread(std::size_t variant,
                                                        const Configuration& one) const;
  [[nodiscard]] std::optional<double> message_spread(std::size_t variant, Class what,
                                                     const Configuration& one) const;
  /// Of all configurations.
  [[nodiscard]] std::optional<Quartiles> completion_spreads(std::size_t variant) const;
  [[nodiscard]] std::optional<double> largest_completion_spread(std::size_t variant) const;
  [[nodiscard]] std::optional<double> largest_message_spread(std::size_t variant, Class what) const;

  /// Messages of a loopback run, normalised to the configuration: SEDP classes by the number of
  /// directed pairs, SPDP by the square of the number of participants (paper, "Wireless Completion
  /// Scaling").
  [[nodiscard]] std::optional<double> loopback_messages(std::size_t variant, Class what,
                                                        const Configuration& one) const;
  /// The failure-free reference.
  [[nodiscard]] double reference_messages(std::size_t variant, Class what,
                                          const Configuration& one) const;
  /// Mean over the configurations of |normalised loopback − reference| / reference.
  [[nodiscard]] std::optional<double> loopback_error(std::size_t variant, Class what) const;
  [[nodiscard]] std::optional<double> loopback_configurations_with_repair(
      std::size_t variant) const;

 private:
  template <class Value>
  [[nodiscard]] std::optional<double> mean_over_endpoints(std::size_t variant,
                                                          model::HeartbeatPolicy policy,
                                                          std::uint32_t participants,
                                                          Value value) const;
  /// Of every configuration, or nothing if one has none.
  template <class Value>
  [[nodiscard]] std::optional<std::vector<double>> everywhere(Value value) const;

  const Results& results_;
};

/// Of values at position q·(n − 1), linearly interpolated; `values` must not be empty.
[[nodiscard]] Quartiles quartiles(std::vector<double> values);

/// The normalisation of loopback counts to N_H hosts with N_P participants each: by
/// c_pair = N_H·N_P / l_P and c_SPDP = (N_H·N_P / l_P)². Multiplied first and divided once, so that
/// counts that agree give exactly no error.
struct LoopbackNormalisation {
  double all = 1;       ///< N_H·N_P
  double loopback = 1;  ///< l_P = (N_H − 1)·N_P + 1

  [[nodiscard]] double sedp(double messages) const;
  [[nodiscard]] double spdp(double messages) const;
};
[[nodiscard]] LoopbackNormalisation loopback_normalisation(std::uint32_t hosts,
                                                           std::uint32_t participants);

}  // namespace stormproof::reproduce
