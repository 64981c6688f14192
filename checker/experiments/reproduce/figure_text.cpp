// Numbers of the published figures and of the model's, as people read them.
#include <cmath>

#include <fmt/core.h>

#include "checker/experiments/reproduce/reproduce_report.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::reproduce {

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

std::string distance_text(double points) {
  if (!std::isfinite(points)) return "–";
  return std::abs(points) < 0.05 ? "0 pt" : fmt::format("{:+.1f} pt", points);
}

}  // namespace stormproof::reproduce
