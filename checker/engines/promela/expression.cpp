// How expressions are written, and what is folded.
#include "checker/engines/promela/expression.hpp"

#include <algorithm>

#include <fmt/core.h>

namespace stormproof::promela {

Expression joined(const Expression& a, std::string_view word, const Expression& b,
                  std::int64_t (*fold)(std::int64_t, std::int64_t)) {
  if (a.text.empty() || b.text.empty()) return {""};
  if (a.constant && b.constant) {
    const std::int64_t value = fold(*a.constant, *b.constant);
    return {std::to_string(value), value};
  }
  Expression both{fmt::format("({} {} {})", a.text, word, b.text), {}, a.reads};
  for (const auto& [variable, writes] : b.reads) {
    const auto read = both.reads.emplace(variable, writes).first;
    read->second = std::min(read->second, writes);  // the oldest says how long it is valid
  }
  return both;
}

namespace {
/// A truth value is written as a word.
Truth truth(Expression of) { return of.constant ? Truth{*of.constant != 0} : Truth{std::move(of)}; }
}  // namespace

Truth operator!(const Truth& a) {
  if (a.of_.constant) return a.is(false);
  const std::string& text = a.of_.text;
  if (text.empty()) return a;
  return Truth{Expression{text.starts_with('!') ? text.substr(1) : "!" + text, {}, a.of_.reads}};
}
Truth operator&&(const Truth& a, const Truth& b) {
  if (a.is(false) || b.is(false)) return false;
  if (a.is(true)) return b;
  if (b.is(true)) return a;
  return Truth{joined(a.of_, "&&", b.of_, nullptr)};
}
Truth operator||(const Truth& a, const Truth& b) {
  if (a.is(true) || b.is(true)) return true;
  if (a.is(false)) return b;
  if (b.is(false)) return a;
  return Truth{joined(a.of_, "||", b.of_, nullptr)};
}

Number Number::of(const Truth& truth) {
  if (truth.expression().constant) return *truth.expression().constant;
  return Number{truth.expression()};
}
Number operator+(const Number& a, const Number& b) {
  if (a.of_.constant == 0) return b;
  return Number{joined(a.of_, "+", b.of_, [](auto x, auto y) { return x + y; })};
}
Number operator-(const Number& a, const Number& b) {
  return Number{joined(a.of_, "-", b.of_, [](auto x, auto y) { return x - y; })};
}
Number operator*(const Number& a, const Number& b) {
  return Number{joined(a.of_, "*", b.of_, [](auto x, auto y) { return x * y; })};
}
Number operator/(const Number& a, const Number& b) {
  if (b.of_.constant == 0) return Number::unknown();
  return Number{joined(a.of_, "/", b.of_, [](auto x, auto y) { return x / y; })};
}
Truth operator==(const Number& a, const Number& b) {
  return truth(joined(a.of_, "==", b.of_, [](auto x, auto y) { return std::int64_t{x == y}; }));
}
Truth operator<(const Number& a, const Number& b) {
  return truth(joined(a.of_, "<", b.of_, [](auto x, auto y) { return std::int64_t{x < y}; }));
}

Number Written::select(const Truth& condition, const Number& then, const Number& otherwise) {
  if (condition.is(true)) return then;
  if (condition.is(false)) return otherwise;
  return Number::unknown();  // only times are selected
}

Truth Lanes::any() const {
  Truth some;
  for (const Truth& lane : of) some = some || lane;
  return some;
}
Number Lanes::bitmap() const {
  Number bits;
  for (std::size_t d = of.size(); d-- > 0;) bits = bits * 2 + Number::of(of[d]);
  return bits;
}

}  // namespace stormproof::promela
