// A composition as a Mermaid flowchart: a box for each side with its machines, rules as nodes, and
// as edges what leads from one to another, with the ids of the effects: packets thick, timers
// dotted, calls and occasions thin.
#include <algorithm>

#include <fmt/format.h>

#include "checker/presentation/composition/composition_drawing.hpp"
#include "checker/presentation/composition/composition_graph.hpp"
#include "checker/presentation/composition/composition_words.hpp"
#include "checker/presentation/diagrams/mermaid_text.hpp"

namespace stormproof::draw {

namespace {

namespace comp = fsm::composition;

class Flowchart {
 public:
  explicit Flowchart(const comp::CompositionInfo& composition)
      : composition_{composition}, parties_{parties(composition)} {}

  std::string run() && {
    text_ = fmt::format("flowchart TB\n  %% {}: thick packets, dotted timers, thin calls\n",
                        composition_.name);
    const std::vector<const comp::RuleInfo*> rules = reading_order(composition_);
    for (std::size_t k = 0; k < parties_.size(); ++k) {
      const std::string id = fmt::format("side{}", k);
      text_ += fmt::format("  subgraph {}[\"{}\"]\n", id, mermaid_text(parties_[k].name));
      add_machines(parties_[k], id);
      for (const comp::RuleInfo* rule : rules) {
        if (party_of(parties_, rule->id) == &parties_[k]) add_node(*rule, "    ");
      }
      text_ += "  end\n";
    }
    for (const comp::RuleInfo* rule : rules) {
      if (party_of(parties_, rule->id) == nullptr) add_node(*rule, "  ");
    }
    for (const comp::RuleInfo* rule : rules) add_edges(*rule);
    return std::move(text_);
  }

 private:
  static std::string node(std::string_view rule) {
    std::string name{rule};
    std::ranges::replace(name, ' ', '_');
    return name;
  }

  /// A node of its own: the title of a box has one line.
  void add_machines(const Party& party, std::string_view id) {
    if (party.parts.empty()) return;
    std::string text;
    for (const comp::PartInfo& part : party.parts) {
      text +=
          fmt::format("{}{}: {} of each {}", text.empty() ? "" : "<br/>", mermaid_text(part.name),
                      mermaid_text(part.machine), mermaid_text(part.owner));
    }
    text_ += fmt::format("    machines_{}[[\"{}\"]]\n", id, text);
  }

  /// A step that does nothing between machines is left out.
  [[nodiscard]] static bool is_empty(const comp::RuleInfo& rule) {
    return rule.trigger.empty() && rule.effects.empty();
  }

  void add_node(const comp::RuleInfo& rule, std::string_view indent) {
    if (is_empty(rule)) return;
    std::string label = mermaid_text(rule.id);
    if (!rule.trigger.empty()) label += "<br/>" + mermaid_text(trigger_words(rule));
    std::string fed;
    for (const comp::EffectInfo& effect : rule.effects) {
      if (!effect.kind.starts_with("feed")) continue;
      fed += fmt::format("{}{} {}", fed.empty() ? "" : ", ", effect.target, number_of(effect));
    }
    if (!fed.empty()) label += "<br/>feeds " + mermaid_text(fed);
    const bool rounded = rule.trigger.empty();
    text_ += fmt::format("{}{}{}\"{}\"{}\n", indent, node(rule.id), rounded ? "([" : "[", label,
                         rounded ? "])" : "]");
  }

  /// What an effect sends along an edge; nothing for a call, whose edge leads to the callee.
  static std::string_view cargo(const comp::EffectInfo& effect) {
    return effect.kind == "call" || effect.kind == "perform" ? "" : effect.target;
  }
  static std::string_view arrow(const comp::EffectInfo& effect) {
    if (effect.kind == "emit") return "==>";
    return effect.kind == "after" || effect.kind == "at" ? "-.->" : "-->";
  }
  [[nodiscard]] bool is_drawn(const std::string& id) const {
    const auto step = std::ranges::find(composition_.steps, id, &comp::RuleInfo::id);
    return step == composition_.steps.end() || !is_empty(*step);
  }

  /// Effects of a rule that lead to the same with the same share an edge.
  void add_edges(const comp::RuleInfo& rule) {
    struct Edge {
      std::string_view cargo, arrow;
      std::string to;
      std::string numbers;
    };
    std::vector<Edge> edges;
    for (const comp::EffectInfo& effect : rule.effects) {
      for (const std::string& to : led_to(composition_, effect)) {
        if (!is_drawn(to)) continue;
        const auto same = std::ranges::find_if(edges, [&](const Edge& edge) {
          return edge.to == to && edge.cargo == cargo(effect) && edge.arrow == arrow(effect);
        });
        const std::string number{number_of(effect)};
        if (same == edges.end())
          edges.push_back({cargo(effect), arrow(effect), to, number});
        else
          same->numbers += " " + number;
      }
    }
    for (const Edge& edge : edges) {
      text_ += fmt::format("  {} {}|\"{}{}{}{}\"| {}\n", node(rule.id), edge.arrow,
                           mermaid_text(edge.cargo), edge.cargo.empty() ? "" : "<br/>",
                           mermaid_text(rule.id), edge.numbers, node(edge.to));
    }
  }

  const comp::CompositionInfo& composition_;
  const std::vector<Party> parties_;
  std::string text_;
};

}  // namespace

std::string composition_mermaid(const comp::CompositionInfo& composition) {
  return Flowchart{composition}.run();
}

}  // namespace stormproof::draw
