// What all renderings of a chart say in the same words.
#include "checker/presentation/sequence/chart.hpp"

#include <algorithm>

namespace stormproof::sequence {

std::string with_effect(const std::string& text, const std::string& effect) {
  return effect.empty() ? text : text + " [" + effect + "]";
}

std::string words_of(const Chart::Line& line) { return with_effect(line.text, line.effect); }

std::string number_of(const Chart::Row& row) {
  if (row.kind == Chart::Row::Kind::gap) return {};
  return row.packet.empty() ? std::to_string(row.event) : row.packet;
}

std::string legend_of(const Chart& chart) {
  std::string text = chart.legend;
  const auto add = [&text](const char* words) {
    text += (text.empty() ? "" : "; ") + std::string{words};
  };
  if (std::ranges::any_of(chart.packets, &Chart::Packet::local)) {
    add("dashed arrows: packets that stay on their host");
  }
  if (std::ranges::any_of(chart.packets,
                          [](const auto& one) { return one.unknown_end.has_value(); })) {
    add("dashed arrows: nobody knows whether the packet arrives");
  }
  return text;
}

}  // namespace stormproof::sequence
