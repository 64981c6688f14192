// A type as a value, for `example_of` beside a description (schema.hpp).
#pragma once

namespace stormproof::report {

/// `T example_of(Type<T>)`, beside a description that cannot be shown a default T, is what the
/// schema of T is made from.
template <class T>
struct Type {};

}  // namespace stormproof::report
