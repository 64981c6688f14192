// A condition or value in words: how terms are joined and put into parentheses, and the outbox
// fields that they come from.
#pragma once

#include <cstdint>
#include <set>
#include <string>

namespace stormproof::fsm::program {

class Said {
 public:
  enum class Binding : std::uint8_t { word, negated, both, either, loose };

  explicit Said(std::string text, Binding binding = Binding::word)
      : text_{std::move(text)}, binding_{binding} {}
  [[nodiscard]] static Said field(const std::string& name) {
    Said said{name};
    said.fields_.insert(name);
    return said;
  }

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::set<std::string>& fields() const { return fields_; }
  /// The same in other words.
  [[nodiscard]] Said as(const std::string& text, Binding binding = Binding::loose) const {
    Said said{text, binding};
    said.fields_ = fields_;
    return said;
  }
  [[nodiscard]] Said negated() const {
    return as("not " + within(Binding::word), Binding::negated);
  }
  [[nodiscard]] Said joined(const std::string& word, const Said& other, Binding binding) const {
    Said said = as(within(binding) + " " + word + " " + other.within(binding), binding);
    said.fields_.insert(other.fields_.begin(), other.fields_.end());
    return said;
  }

 private:
  [[nodiscard]] std::string within(Binding outer) const {
    const bool alone = binding_ == Binding::negated && outer != Binding::word;
    return binding_ == Binding::word || binding_ == outer || alone ? text_ : "(" + text_ + ")";
  }

  std::string text_;
  Binding binding_ = Binding::word;
  std::set<std::string> fields_;
};

}  // namespace stormproof::fsm::program
