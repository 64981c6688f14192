// What a composition declares, kept: the states of its machines, its flags, numbers and timers, one
// place for each thing and owner. All that an owner has lies in one row, which inherits a place of
// each thing: what is found there costs an index. `Kept` (model/engine/kept.hpp) is what a host
// has of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <vector>

#include "model/engine/columns.hpp"

namespace stormproof::model {

namespace detail {

template <std::uint8_t indices, class Columns, std::size_t least, std::size_t most>
struct InRow {
  template <class T>
  static constexpr bool holds = [] {
    if constexpr (owner_of_row<T>.indices != indices) {
      return false;
    } else {
      constexpr std::size_t size = sizeof(Place<T, WayOf<T, Columns>>);
      return least <= size && size <= most;
    }
  }();
};
template <class Columns, class... Ts>
struct RowOf : Place<Ts, WayOf<Ts, Columns>>... {};
template <class Columns, class... Ts>
RowOf<Columns, Ts...> row_of(fsm::TypeList<Ts...>);

/// All of one owner; large things first, which leaves no holes.
template <std::uint8_t indices, class Kept, class Columns>
struct RowsOf {
  using Row =
      decltype(row_of<Columns>(comp::Joined<Filtered<Kept, InRow<indices, Columns, 9, SIZE_MAX>>,
                                            Filtered<Kept, InRow<indices, Columns, 8, 8>>,
                                            Filtered<Kept, InRow<indices, Columns, 4, 4>>,
                                            Filtered<Kept, InRow<indices, Columns, 1, 1>>>{}));

  template <class Numbering>
  explicit RowsOf([[maybe_unused]] const Numbering& numbering) {
    if constexpr (!std::is_empty_v<Row>) {
      rows.resize(Columns::template rows<comp::Owner{indices}>(numbering));
    }
  }
  std::vector<Row> rows;
};

}  // namespace detail

/// `Things` are parts, flags, numbers and timers. `Columns::rows` and `row` are asked with the
/// numbering of the host, in the simulator its run.
template <class Things, class Columns>
class Store {
  using Kept = Filtered<Things, detail::HasPlace<Columns>>;
  template <std::uint8_t indices>
  using Rows = detail::RowsOf<indices, Kept, Columns>;

 public:
  template <class T>
  static constexpr bool keeps = detail::is_listed<T>(Kept{});

  template <class Numbering>
  explicit Store(const Numbering& numbering)
      : rows_{Rows<comp::owner::participant.indices>{numbering},
              Rows<comp::owner::pair.indices>{numbering},
              Rows<comp::owner::writer.indices>{numbering},
              Rows<comp::owner::relation.indices>{numbering},
              Rows<comp::owner::control_relation.indices>{numbering},
              Rows<comp::owner::control_writer.indices>{numbering}} {}

  /// The place of a thing in a row.
  template <class T>
  [[nodiscard]] auto& at(std::uint32_t row) {
    return static_cast<detail::Place<T, detail::WayOf<T, Columns>>&>(
        std::get<Rows<owner_of_row<T>.indices>>(rows_).rows[row]);
  }

 private:
  std::tuple<Rows<comp::owner::participant.indices>, Rows<comp::owner::pair.indices>,
             Rows<comp::owner::writer.indices>, Rows<comp::owner::relation.indices>,
             Rows<comp::owner::control_relation.indices>, Rows<comp::owner::control_writer.indices>>
      rows_;
};

}  // namespace stormproof::model
