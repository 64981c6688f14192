// Errors in what a user wrote, and a value-or-error type to return them with. Bad input is refused
// at the boundary, with its place, the offending value and what was expected; no exception crosses
// a public header. (std::expected would do, but clang 14 does not have it.)
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>

namespace stormproof::model::config {

/// One mistake in the input.
struct InputError {
  std::string where;    ///< "file:line:column", "file", or "--set key=value"
  std::string message;  ///< the offending value and what was expected

  bool operator==(const InputError&) const = default;
};

/// "where: message", the form that goes to stderr.
[[nodiscard]] inline std::string to_string(const InputError& error) {
  return error.where + ": " + error.message;
}

/// A `T`, or the reason why there is none. Asking for the half that is not there ends the program
/// (exit 70).
template <class T, class E = InputError>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_{std::in_place_index<0>, std::move(value)} {}
  Result(E error) : state_{std::in_place_index<1>, std::move(error)} {}

  [[nodiscard]] explicit operator bool() const { return state_.index() == 0; }

  [[nodiscard]] const T& operator*() const& { return *held<0>(state_); }
  [[nodiscard]] T& operator*() & { return *held<0>(state_); }
  [[nodiscard]] T&& operator*() && { return std::move(*held<0>(state_)); }
  [[nodiscard]] const T* operator->() const { return held<0>(state_); }
  [[nodiscard]] T* operator->() { return held<0>(state_); }
  [[nodiscard]] const E& error() const { return *held<1>(state_); }

 private:
  template <std::size_t Half>
  static auto* held(auto& state) {
    auto* half = std::get_if<Half>(&state);
    if (half == nullptr) {
      std::fputs("internal error: a Result was read without looking whether it holds a value\n",
                 stderr);
      std::_Exit(70);
    }
    return half;
  }

  std::variant<T, E> state_;
};

}  // namespace stormproof::model::config
