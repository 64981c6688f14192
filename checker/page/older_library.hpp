// Stands in for what the standard library of Debian 12's emscripten (libc++ 13) lacks of C++20: the
// algorithms of std::ranges and std::make_unique_for_overwrite, as far as fsm and model use them.
// Only the page is built with it, by -include; with a later library it is empty.
#pragma once

#include <ciso646>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <ranges>
#include <type_traits>

namespace std {

template <class Value>
requires(!is_array_v<Value>) unique_ptr<Value> make_unique_for_overwrite() {
  return unique_ptr<Value>(new Value);
}
template <class Array>
requires is_array_v<Array> unique_ptr<Array> make_unique_for_overwrite(size_t size) {
  return unique_ptr<Array>(new remove_extent_t<Array>[size]);
}

namespace ranges {

/// A predicate of what a projection makes of an element.
template <class Predicate, class Projection>
constexpr auto projected_predicate(Predicate& predicate, Projection& projection) {
  return [&](auto&& element) -> bool {
    return std::invoke(predicate, std::invoke(projection, element));
  };
}
template <class Compare, class Projection>
constexpr auto projected_order(Compare& compare, Projection& projection) {
  return [&](auto&& a, auto&& b) -> bool {
    return std::invoke(compare, std::invoke(projection, a), std::invoke(projection, b));
  };
}

template <class Iterator, class Predicate, class Projection = identity>
requires input_or_output_iterator<Iterator>
constexpr Iterator find_if(Iterator first, Iterator last, Predicate predicate,
                           Projection projection = {}) {
  return std::find_if(first, last, projected_predicate(predicate, projection));
}
template <class Range, class Predicate, class Projection = identity>
constexpr auto find_if(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::find_if(ranges::begin(range), ranges::end(range),
                      projected_predicate(predicate, projection));
}
template <class Range, class Value, class Projection = identity>
constexpr auto find(Range&& range, const Value& value, Projection projection = {}) {
  const auto is_value = [&](auto&& element) { return element == value; };
  return ranges::find_if(range, is_value, projection);
}
template <class Range, class Predicate, class Projection = identity>
constexpr bool any_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return ranges::find_if(range, predicate, projection) != ranges::end(range);
}
template <class Range, class Predicate, class Projection = identity>
constexpr bool none_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return !ranges::any_of(range, predicate, projection);
}
template <class Range, class Predicate, class Projection = identity>
constexpr bool all_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::all_of(ranges::begin(range), ranges::end(range),
                     projected_predicate(predicate, projection));
}
template <class Range, class Predicate, class Projection = identity>
constexpr auto count_if(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::count_if(ranges::begin(range), ranges::end(range),
                       projected_predicate(predicate, projection));
}
template <class Range, class Value, class Projection = identity>
constexpr auto count(Range&& range, const Value& value, Projection projection = {}) {
  const auto is_value = [&](auto&& element) { return element == value; };
  return ranges::count_if(range, is_value, projection);
}
template <class Range, class Function>
constexpr void for_each(Range&& range, Function function) {
  std::for_each(ranges::begin(range), ranges::end(range), std::ref(function));
}
template <class Range, class Output>
constexpr auto copy(Range&& range, Output output) {
  return std::copy(ranges::begin(range), ranges::end(range), output);
}
template <class Range, class Output, class Function>
constexpr auto transform(Range&& range, Output output, Function function) {
  return std::transform(ranges::begin(range), ranges::end(range), output, function);
}
template <class Range, class Value>
constexpr void fill(Range&& range, const Value& value) {
  std::fill(ranges::begin(range), ranges::end(range), value);
}
template <class Range, class Value>
constexpr void replace(Range&& range, const Value& before, const Value& after) {
  std::replace(ranges::begin(range), ranges::end(range), before, after);
}
template <class Range>
constexpr void reverse(Range&& range) {
  std::reverse(ranges::begin(range), ranges::end(range));
}
template <class Range, class Compare = less, class Projection = identity>
constexpr void sort(Range&& range, Compare compare = {}, Projection projection = {}) {
  std::sort(ranges::begin(range), ranges::end(range), projected_order(compare, projection));
}
template <class Range, class Compare = less, class Projection = identity>
void stable_sort(Range&& range, Compare compare = {}, Projection projection = {}) {
  std::stable_sort(ranges::begin(range), ranges::end(range), projected_order(compare, projection));
}
template <class Range, class Compare = less, class Projection = identity>
constexpr auto max_element(Range&& range, Compare compare = {}, Projection projection = {}) {
  return std::max_element(ranges::begin(range), ranges::end(range),
                          projected_order(compare, projection));
}
template <class Range, class Compare = less, class Projection = identity>
constexpr auto min_element(Range&& range, Compare compare = {}, Projection projection = {}) {
  return std::min_element(ranges::begin(range), ranges::end(range),
                          projected_order(compare, projection));
}
template <class Range>
constexpr auto max(Range&& range) {
  return *std::max_element(ranges::begin(range), ranges::end(range));
}
template <class Range, class Compare = equal_to, class Projection = identity>
constexpr auto adjacent_find(Range&& range, Compare compare = {}, Projection projection = {}) {
  return std::adjacent_find(ranges::begin(range), ranges::end(range),
                            projected_order(compare, projection));
}
template <class Range, class Value, class Compare = less, class Projection = identity>
constexpr auto lower_bound(Range&& range, const Value& value, Compare compare = {},
                           Projection projection = {}) {
  const auto before = [&](auto&& element, const Value& bound) {
    return std::invoke(compare, std::invoke(projection, element), bound);
  };
  return std::lower_bound(ranges::begin(range), ranges::end(range), value, before);
}
template <class Range, class Value, class Compare = less, class Projection = identity>
constexpr auto upper_bound(Range&& range, const Value& value, Compare compare = {},
                           Projection projection = {}) {
  const auto before = [&](const Value& bound, auto&& element) {
    return std::invoke(compare, bound, std::invoke(projection, element));
  };
  return std::upper_bound(ranges::begin(range), ranges::end(range), value, before);
}
template <class A, class B, class Compare = equal_to, class First = identity,
          class Second = identity>
constexpr bool equal(A&& a, B&& b, Compare compare = {}, First first = {}, Second second = {}) {
  const auto same = [&](auto&& x, auto&& y) {
    return std::invoke(compare, std::invoke(first, x), std::invoke(second, y));
  };
  return std::equal(ranges::begin(a), ranges::end(a), ranges::begin(b), ranges::end(b), same);
}

}  // namespace ranges
}  // namespace std

#endif
