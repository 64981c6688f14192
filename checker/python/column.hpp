// A column of numbers that a run or many of them gave. Python reads it through the buffer protocol,
// so numpy and pandas have it without a copy; without either it is a sequence.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>

namespace stormproof::python {

template <class Number>
class Column {
 public:
  explicit Column(std::vector<Number> numbers) : numbers_{std::move(numbers)} {}

  [[nodiscard]] std::size_t size() const { return numbers_.size(); }

  /// As Python's sequences count: from the end if `position` is negative.
  [[nodiscard]] Number at(std::ptrdiff_t position) const {
    const auto size = static_cast<std::ptrdiff_t>(numbers_.size());
    if (position < 0) position += size;
    if (position < 0 || position >= size) throw pybind11::index_error{"no such row"};
    return numbers_[static_cast<std::size_t>(position)];
  }

  /// Read-only: what was simulated is not to be changed in place.
  [[nodiscard]] pybind11::buffer_info buffer() const {
    return {numbers_.data(), static_cast<pybind11::ssize_t>(numbers_.size())};
  }

 private:
  std::vector<Number> numbers_;
};

template <class Number>
void declare_column(pybind11::module_& module, const char* name) {
  using Self = Column<Number>;
  pybind11::class_<Self>(module, name, pybind11::buffer_protocol())
      .def_buffer([](const Self& self) { return self.buffer(); })
      .def("__len__", &Self::size)
      .def("__getitem__", &Self::at, pybind11::arg("position"));
}

/// `table[name]` is a column of these numbers.
template <class Number>
void put(pybind11::dict& table, const char* name, std::vector<Number> numbers) {
  table[name] = Column<Number>{std::move(numbers)};
}

}  // namespace stormproof::python
