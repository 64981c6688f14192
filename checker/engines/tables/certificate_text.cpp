// SMT-LIB 2: the invariant is a function, and each condition one question about it.
#include <algorithm>

#include "checker/engines/tables/certificate.hpp"

namespace stormproof::tables {
namespace {

std::string in_comment(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}
std::string name_of(const Expr& constant) { return constant.to_string(); }
std::string sort_of(const Expr& expr) { return expr.get_sort().to_string(); }

std::string declared(const Exprs& constants) {
  std::string text;
  for (const Expr& one : constants) {
    text += "(declare-const " + name_of(one) + " " + sort_of(one) + ")\n";
  }
  return text;
}
std::string asserted(const Expr& condition) { return "(assert " + condition.to_string() + ")\n"; }

class Text {
 public:
  Text(const Certificate& certificate, const std::vector<Clause>& invariant,
       std::string_view property, const std::vector<std::string>& assumptions)
      : certificate_{certificate}, variables_{certificate.system.variables} {
    text_ = "; certificate of " + std::string{property} +
            ": every (check-sat) must be answered unsat\n" + claim(assumptions) +
            "(set-logic ALL)\n\n; any values of these\n" + declared(certificate.constants);
    define("invariant", invariant);
    if (!certificate.conclusions.empty()) define("conclusion", certificate.conclusions);
  }

  std::string whole() {
    text_ += "\n" + declared(variables_);
    ask("initially the invariant holds",
        asserted(certificate_.system.initial) + fails("invariant", variables_));
    for (const SystemStep& step : certificate_.system.steps) {
      ask(step.name + " keeps it", taken(step) + fails("invariant", step.next));
      for (const StepClause& clause : certificate_.on_steps) {
        if (clause.step != step.name) continue;
        ask(step.name + ": " + clause.words,
            taken(step) + asserted(clause.before) +
                asserted(!with(clause.after, variables_, step.next)));
      }
    }
    if (certificate_.conclusions.empty()) return std::move(text_);
    ask("the invariant implies what is claimed of every state",
        holds("invariant", variables_) + fails("conclusion", variables_));
    return std::move(text_);
  }

 private:
  /// What the file is about, for those who read it.
  [[nodiscard]] std::string claim(const std::vector<std::string>& assumptions) const {
    std::string text;
    for (const std::string& one : assumptions) text += "; assumed: " + in_comment(one) + "\n";
    for (const Clause& clause : certificate_.conclusions) {
      text += "; claimed of every state: " + in_comment(clause.words) + "\n";
    }
    for (const StepClause& clause : certificate_.on_steps) {
      text += "; claimed of the step " + clause.step + ": " + in_comment(clause.words) + "\n";
    }
    return text;
  }
  void define(const std::string& name, const std::vector<Clause>& clauses) {
    text_ += "\n(define-fun " + name + " (";
    for (const Expr& variable : variables_) {
      text_ += "(" + name_of(variable) + " " + sort_of(variable) + ")";
    }
    text_ += ") Bool (and true\n";
    for (const Clause& clause : clauses) {
      text_ += "  ; " + in_comment(clause.words) + "\n  " + clause.holds.to_string() + "\n";
    }
    text_ += "))\n";
  }
  void ask(const std::string& what, const std::string& conditions) {
    text_ += "\n; " + in_comment(what) + "\n(push 1)\n" + conditions + "(check-sat)\n(pop 1)\n";
  }
  [[nodiscard]] std::string applied(const std::string& name, const Exprs& values) const {
    std::string text = "(" + name;
    for (const Expr& value : values) text += "\n  " + value.to_string();
    return text + ")";
  }
  [[nodiscard]] std::string holds(const std::string& name, const Exprs& values) const {
    return "(assert " + applied(name, values) + ")\n";
  }
  [[nodiscard]] std::string fails(const std::string& name, const Exprs& values) const {
    return "(assert (not " + applied(name, values) + "))\n";
  }
  [[nodiscard]] std::string taken(const SystemStep& step) const {
    return declared(step.inputs) + holds("invariant", variables_) + asserted(step.guard);
  }

  const Certificate& certificate_;
  const Exprs& variables_;
  std::string text_;
};

}  // namespace

std::string certificate_text(const Certificate& certificate, const std::vector<Clause>& invariant,
                             std::string_view property,
                             const std::vector<std::string>& assumptions) {
  return Text{certificate, invariant, property, assumptions}.whole();
}

}  // namespace stormproof::tables
