// Says what a program says, in the order in which its rules say it.
#include "fsm/program/words.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "fsm/program/said.hpp"

namespace stormproof::fsm::program {
namespace {

using composition::BlockInfo;
using composition::CompositionInfo;
using composition::RuleInfo;
using composition::ThingInfo;

std::string_view label(Owner owner) {
  namespace of = composition::owner;
  if (owner == of::participant) return "participant";
  if (owner == of::pair) return "pair";
  if (owner == of::writer) return "writer";
  if (owner == of::relation) return "relation";
  if (owner == of::entry) return "entry";
  if (owner == of::descriptor) return "descriptor";
  if (owner == of::control_relation) return "control relation";
  if (owner == of::control_writer) return "control writer";
  return "";
}

/// What stands before a term about another place.
std::string_view prefix_of(Op op) {
  constexpr std::array words{"those with ",   "some d: ",       "each d: ",
                             "number of d: ", "some reader: ",  "number of readers: ",
                             "some entry: ",  "all up to it: ", "it or a later one: "};
  return words.at(static_cast<std::size_t>(op) - static_cast<std::size_t>(Op::set_of));
}

class Printer {
 public:
  explicit Printer(const Program& program) : program_{program} {}

  CompositionInfo print() {
    describe();
    for (const Rule& rule : program_.rules) {
      RuleInfo printed{
          std::string{rule.name}, word_of(rule.trigger), name(rule.cause), label(rule.owner), {}};
      rule_ = &printed;
      follow(rule.body);
      into_.rules.push_back(std::move(printed));
    }
    return std::move(into_);
  }

 private:
  [[nodiscard]] const Thing& thing(Tag tag) const { return program_.things[tag]; }
  [[nodiscard]] std::string_view name(Tag tag) const { return thing(tag).name; }

  void describe() {
    into_.name = program_.name;
    for (const Tag tag : program_.parts) {
      const Machine& machine = program_.machine_of(tag);
      composition::PartInfo part{
          name(tag), machine.name, label(thing(tag).owner), machine.events, {}};
      for (const Machine::Field& field : machine.outputs) part.outbox.push_back(field.name);
      into_.parts.push_back(std::move(part));
    }
    const auto list = [&](std::vector<ThingInfo>& into, const std::vector<Tag>& tags) {
      for (const Tag tag : tags) into.push_back({name(tag), label(thing(tag).owner)});
    };
    list(into_.timers, program_.timers);
    list(into_.state, program_.state);
    list(into_.packets, program_.packets);
    list(into_.occasions, program_.occasions);
    for (const Reason& reason : program_.unused) {
      into_.unused.push_back({reason.part, reason.name, reason.text});
    }
    for (const Reason& reason : program_.from_outside) {
      into_.from_outside.push_back({reason.name, reason.text});
    }
  }

  // Terms.
  Said say(Ref ref) {
    using enum Op;
    const Term& term = program_.terms[ref];
    const auto a = [&] { return say(term.a); };
    switch (term.op) {
      case truth:
        return Said{term.value != 0 ? "true" : "false"};
      case integer:
        return Said{std::to_string(term.value)};
      case read:
        if (thing(term.tag).kind == Thing::Kind::fact) define(term.tag);
        return Said{std::string{name(term.tag)}};
      case pending:
        return Said{"pending " + std::string{name(term.tag)}, Said::Binding::loose};
      case in_state: {
        const auto state = program_.machine_of(term.tag).states[std::size_t(term.value)];
        return Said{std::string{name(term.tag)} + " in " + std::string{state},
                    Said::Binding::loose};
      }
      case let:
      case named:
        return a();
      case outbox: {
        const auto field = program_.machine_of(term.tag).outputs[std::size_t(term.value)].name;
        return Said::field(std::string{name(term.tag)} + "." + std::string{field});
      }
      case argument:
        return Said{"argument " + std::to_string(term.value)};
      case choice:
        return Said{"maybe " + std::string{term.words}, Said::Binding::loose};
      case subject:
        return Said{"it is this descriptor", Said::Binding::loose};
      case is_in:
        return prefixed("in ", a());
      case any:
        return prefixed("some ", a());
      case negation:
        return a().negated();
      case both:
        return joined(term, "and", Said::Binding::both);
      case either:
        return joined(term, "or", Said::Binding::either);
      case plus:
        return joined(term, "+");
      case minus:
        return joined(term, "-");
      case times:
        return joined(term, "*");
      case over:
        return joined(term, "/");
      case less:
        return joined(term, "<");
      case greater:
        return joined(term, ">");
      case select: {
        const Said condition = a();
        return condition.as(say(term.b).text() + " if " + condition.text() + ", otherwise " +
                            say(term.c).text());
      }
      default:
        return prefixed(prefix_of(term.op), a());
    }
  }
  /// What g++ computes first it says first: definitions of facts stand in the order in which rules
  /// read them.
  Said joined(const Term& term, const char* word, Said::Binding binding = Said::Binding::loose) {
    if (binding != Said::Binding::loose) {
      const Said left = say(term.a);
      return left.joined(word, say(term.b), binding);
    }
    const Said right = say(term.b);
    return say(term.a).joined(word, right, binding);
  }
  static Said prefixed(std::string_view words, const Said& inner) {
    return inner.as(std::string{words} + inner.text());
  }
  void define(Tag fact) {
    for (const auto& known : into_.facts) {
      if (known.first == name(fact)) return;
    }
    into_.facts.emplace_back(name(fact), "");
    const std::size_t place = into_.facts.size() - 1;
    std::string text = say(thing(fact).definition).text();
    into_.facts[place].second = std::move(text);
  }
  /// The text, whose outbox fields have a use here.
  std::string used(Ref ref) {
    const Said said = say(ref);
    for (const std::string& field : said.fields()) {
      if (std::ranges::find(into_.consumed, field) == into_.consumed.end()) {
        into_.consumed.push_back(field);
      }
    }
    return said.text();
  }

  // Steps.
  void follow(const Steps& steps) {
    for (const Step& step : steps) {
      if (step.what == Do::let) {
        (void)say(step.value);
      } else if (step.what < Do::feed) {
        enter(step);
      } else {
        effect(step);
      }
    }
  }
  void enter(const Step& step) {
    const std::string text = text_of_block(step);
    if (text == "if true") return follow(step.body);
    blocks_.push_back({text, ++last_block_, word_of(step.what), step.key});
    follow(step.body);
    blocks_.pop_back();
  }
  std::string text_of_block(const Step& step) {
    switch (step.what) {
      case Do::when:
        return "if " + used(step.value);
      case Do::for_readers:
        return "for each open reader";
      case Do::for_readers_by_number:
        return "for each open reader by number";
      case Do::for_descriptors:
        return "for each d: " + say(step.value).text();
      case Do::for_queue:
        return "for each entry of the queue";
      case Do::for_streams:
        return "for each stream";
      case Do::for_known_peers:
        return "for each known peer";
      case Do::partition:
        return "for each part of " + used(step.value);
      default:
        return "in the reverse direction";
    }
  }
  void effect(const Step& step) {
    const Thing& target = thing(step.target);
    std::string detail = detail_of(step);
    rule_->effects.push_back({effect_id(rule_->id, step), word_of(step.what), target.name,
                              label(target.owner), std::move(detail), blocks_, step.file, step.line,
                              step.key});
    if (step.what == Do::call) aside(into_.procedures, step);
    if (step.what == Do::perform) aside(into_.steps, step);
  }
  std::string detail_of(const Step& step) {
    switch (step.what) {
      case Do::feed:
      case Do::feed_each: {
        std::string event{program_.machine_of(step.target).events[step.event]};
        return step.value == no_term ? event : event + " where " + say(step.value).text();
      }
      case Do::set:
      case Do::set_each:
      case Do::at:
        return used(step.value);
      case Do::after:
        return std::string{name(step.wait)};
      case Do::emit:
        return contents(step);
      case Do::call:
      case Do::perform:
        return arguments(step);
      default:
        return "";
    }
  }
  std::string contents(const Step& step) {
    std::string text;
    for (std::size_t k = 0; k < step.with.size(); ++k) {
      text += (k == 0 ? "" : ", ") + std::string{name(step.fields[k])} + " = ";
      text += used(step.with[k].value);
    }
    return text;
  }
  /// Outboxes have no name.
  std::string arguments(const Step& step) {
    const auto& parameters = program_.procedures[step.procedure].parameters;
    std::string text{step.argument};
    for (std::size_t k = 0; k < step.with.size(); ++k) {
      if (!parameters[k].is_outbox) text += (k == 0 ? "" : ", ") + used(step.with[k].value);
    }
    return text;
  }
  /// The procedure or contract, unless it has been said.
  void aside(std::vector<RuleInfo>& list, const Step& step) {
    const Procedure& procedure = program_.procedures[step.procedure];
    if (std::ranges::find(list, procedure.name, &RuleInfo::id) != list.end()) return;
    RuleInfo printed{procedure.name, "", "", "", {}};
    list.push_back(printed);  // what it calls comes after it
    const std::size_t place = list.size() - 1;
    RuleInfo* const outer = std::exchange(rule_, &printed);
    std::vector<BlockInfo> blocks = std::exchange(blocks_, {});
    follow(procedure.body);
    blocks_ = std::move(blocks);
    rule_ = outer;
    list[place] = std::move(printed);
  }

  const Program& program_;
  CompositionInfo into_;
  RuleInfo* rule_ = nullptr;
  std::vector<BlockInfo> blocks_;
  unsigned last_block_ = 0;
};

}  // namespace

CompositionInfo words_of(const Program& program) { return Printer{program}.print(); }

}  // namespace stormproof::fsm::program
