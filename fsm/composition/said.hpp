// The domain of words: conditions and values as text, with the outbox fields that they come from.
// It is what the recorder (fsm/composition/recorder.hpp) evaluates rules in.
#pragma once

#include <concepts>
#include <cstdint>
#include <set>
#include <string>

namespace stormproof::fsm::composition {

/// A value in words, and the outbox fields that it comes from.
class Said {
 public:
  enum class Binding : std::uint8_t { word, negated, both, either, loose };

  Said() : Said{false} {}
  template <std::same_as<bool> T>
  Said(T value) : text_{value ? "true" : "false"} {}
  template <std::integral T>
  requires(!std::same_as<T, bool>) Said(T value) : text_{std::to_string(value)} {}
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

  friend Said operator!(const Said& a) {
    return a.as("not " + a.within(Binding::word), Binding::negated);
  }
  friend Said operator&&(const Said& a, const Said& b) { return a.joined("and", b, Binding::both); }
  friend Said operator||(const Said& a, const Said& b) {
    return a.joined("or", b, Binding::either);
  }
  friend Said operator+(const Said& a, const Said& b) { return a.joined("+", b, Binding::loose); }
  friend Said operator-(const Said& a, const Said& b) { return a.joined("-", b, Binding::loose); }
  friend Said operator*(const Said& a, const Said& b) { return a.joined("*", b, Binding::loose); }
  friend Said operator/(const Said& a, const Said& b) { return a.joined("/", b, Binding::loose); }
  friend Said operator>(const Said& a, const Said& b) { return a.joined(">", b, Binding::loose); }

 private:
  [[nodiscard]] std::string within(Binding outer) const {
    const bool alone = binding_ == Binding::negated && outer != Binding::word;
    return binding_ == Binding::word || binding_ == outer || alone ? text_ : "(" + text_ + ")";
  }
  [[nodiscard]] Said joined(const std::string& word, const Said& other, Binding binding) const {
    Said said = as(within(binding) + " " + word + " " + other.within(binding), binding);
    said.fields_.insert(other.fields_.begin(), other.fields_.end());
    return said;
  }

  std::string text_;
  Binding binding_ = Binding::word;
  std::set<std::string> fields_;
};

/// The domain of words.
struct Words {
  using Bool = Said;
  using Int = Said;
};

}  // namespace stormproof::fsm::composition
