// A value that many may have and most do not: an optional that costs a pointer, and whose copies
// share what it holds.
#pragma once

#include <memory>

namespace stormproof::model {

template <class T>
class Shared {
 public:
  using value_type = T;

  Shared() = default;
  Shared(const T& value) : value_{std::make_shared<T>(value)} {}  // NOLINT: as std::optional does

  [[nodiscard]] bool has_value() const { return value_ != nullptr; }
  explicit operator bool() const { return has_value(); }
  [[nodiscard]] const T& operator*() const { return *value_; }
  [[nodiscard]] const T* operator->() const { return value_.get(); }
  /// A value of its own, to be filled in.
  T& emplace(const T& value = {}) {
    value_ = std::make_shared<T>(value);
    return *value_;
  }
  void reset() { value_.reset(); }

  bool operator==(const Shared& other) const {
    if (value_ == other.value_) return true;
    return value_ && other.value_ && *value_ == *other.value_;
  }

 private:
  std::shared_ptr<T> value_;
};

}  // namespace stormproof::model
