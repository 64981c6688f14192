// How statements are written.
#include "checker/engines/promela/script.hpp"

#include <stdexcept>

#include <fmt/core.h>

namespace stormproof::promela {

void Script::find_said(const std::string& field, const Number& value) {
  const Expression& said = value.expression();
  if (said.constant != 0) find("said " + field);
  find("value of " + field + (said.constant ? " " + said.text : ""));
}
unsigned Script::values_of(const std::string& field, bool bitmap) const {
  const unsigned all = bitmap ? 1U << descriptors_ : 2;
  if (is_found("value of " + field)) return all;
  unsigned count = 0;
  for (unsigned k = 0; k < all; ++k) {
    if (is_found(fmt::format("value of {} {}", field, k))) ++count;
  }
  return count;
}

Expression Script::reading(const std::string& variable, std::string text) const {
  const auto writes = writes_.find(variable);
  return {std::move(text), {}, {{variable, writes == writes_.end() ? 0 : writes->second}}};
}
Truth Script::truth(const std::string& variable) const {
  return Truth{reading(variable, variable)};
}
Truth Script::bit(const std::string& variable, int bit) const {
  return Truth{reading(variable, fmt::format("({} >> {} & 1)", variable, bit))};
}
Number Script::number(const std::string& variable) const {
  return Number{reading(variable, variable)};
}
Truth Script::equals(const std::string& variable, const std::string& value) const {
  return Truth{reading(variable, fmt::format("({} == {})", variable, value))};
}

const std::string& Script::say(const Expression& expression) {
  if (expression.text.empty()) throw std::logic_error{"a time decides in a model that has none"};
  for (const auto& [variable, writes] : expression.reads) {
    const auto now = writes_.find(variable);
    if (now != writes_.end() && now->second != writes) {
      throw std::logic_error{variable + " has changed since a rule has read it"};
    }
    find(reader_ + variable);
  }
  return expression.text;
}

void Script::assign(const std::string& variable, const Expression& value) {
  write(variable + " = " + say(value));
  changed(variable);
}
void Script::send(const std::string& store) {
  write("send_" + store + "()");
  ++sends_[store];
}
void Script::when(const Truth& condition, const std::function<void()>& body) {
  if (condition.is(true)) return body();
  if (condition.is(false)) return;
  const std::string option = fmt::format("{}:: {} ->", indent_, say(condition.expression()));
  const std::size_t before = lines_.size();
  lines_.push_back(indent_ + "if");
  lines_.push_back(option);
  const std::string outer = indent_;
  indent_ += "     ";
  body();
  indent_ = outer;
  if (lines_.size() == before + 2) return lines_.resize(before);  // nothing happens in it
  lines_.push_back(indent_ + ":: else");
  lines_.push_back(indent_ + "fi;");
}

}  // namespace stormproof::promela
