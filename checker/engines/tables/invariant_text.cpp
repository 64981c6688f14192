// Invariants as people read them: clauses as implications.
#include "checker/engines/tables/transition_system.hpp"

namespace stormproof::tables {
namespace {

bool is_kind(const Expr& expr, Z3_decl_kind kind) {
  return expr.is_app() && expr.decl().decl_kind() == kind;
}

std::string joined(const std::vector<std::string>& parts, const std::string& word) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : " " + word + " ") + part;
  return text;
}

const char* infix_of(const Expr& expr) {
  if (!expr.is_app() || expr.num_args() != 2) return nullptr;
  switch (expr.decl().decl_kind()) {
    case Z3_OP_LE:
      return " <= ";
    case Z3_OP_GE:
      return " >= ";
    case Z3_OP_EQ:
      return " = ";
    case Z3_OP_ADD:
      return " + ";
    default:
      return nullptr;
  }
}

/// An atom, or anything else on one line.
std::string plain(const Expr& expr) {
  if (expr.is_const() && !expr.is_numeral()) return expr.decl().name().str();
  if (const char* const infix = infix_of(expr)) {
    return plain(expr.arg(0)) + infix + plain(expr.arg(1));
  }
  std::string text;
  for (const char c : expr.to_string()) {
    const bool blank = c == '\n' || c == ' ';
    if (blank && !text.empty() && text.back() == ' ') continue;
    text += blank ? ' ' : c;
  }
  std::erase(text, '|');
  return text;
}

std::string clause_text(const Expr& clause) {
  std::vector<std::string> conditions;
  std::vector<std::string> consequences;
  const bool many = is_kind(clause, Z3_OP_OR);
  for (unsigned k = 0; k < (many ? clause.num_args() : 1); ++k) {
    const Expr literal = many ? clause.arg(k) : clause;
    const bool negative = is_kind(literal, Z3_OP_NOT);
    (negative ? conditions : consequences).push_back(plain(negative ? literal.arg(0) : literal));
  }
  if (conditions.empty()) return joined(consequences, "or");
  if (consequences.empty()) return "never " + joined(conditions, "and");
  return joined(conditions, "and") + (conditions.size() == 1 ? " implies " : " imply ") +
         joined(consequences, "or");
}

}  // namespace

std::vector<std::string> invariant_lines(const Expr& invariant) {
  std::vector<std::string> lines;
  if (is_kind(invariant, Z3_OP_AND)) {
    for (unsigned k = 0; k < invariant.num_args(); ++k) {
      for (std::string& line : invariant_lines(invariant.arg(k))) lines.push_back(std::move(line));
    }
    return lines;
  }
  // not (a or b) is the conjunction of the negations.
  if (is_kind(invariant, Z3_OP_NOT) && is_kind(invariant.arg(0), Z3_OP_OR)) {
    const Expr inner = invariant.arg(0);
    for (unsigned k = 0; k < inner.num_args(); ++k) {
      for (std::string& line : invariant_lines((!inner.arg(k)).simplify())) {
        lines.push_back(std::move(line));
      }
    }
    return lines;
  }
  // not (a and b) is a clause.
  if (is_kind(invariant, Z3_OP_NOT) && is_kind(invariant.arg(0), Z3_OP_AND)) {
    Exprs negations;
    for (unsigned k = 0; k < invariant.arg(0).num_args(); ++k) {
      negations.push_back((!invariant.arg(0).arg(k)).simplify());
    }
    return {clause_text(any_of(negations))};
  }
  return {clause_text(invariant)};
}

}  // namespace stormproof::tables
