// Tables at a terminal. Widths are shared out before anything is written: narrow columns get what
// their longest cell needs, sentences share the rest.
#include <algorithm>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/presentation/document/text_lines.hpp"

namespace stormproof::report {

namespace {

constexpr std::size_t gap = 2;          ///< columns of a terminal between two of a table
constexpr std::size_t least_wide = 18;  ///< of a column that is broken

class TextTable {
 public:
  TextTable(const Table& table, std::size_t width, bool colours, bool verbose)
      : table_{table}, width_{width}, colours_{colours} {
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      const Audience who = table.columns[k].audience;
      if (who == Audience::page || who == Audience::documents || who == Audience::comment) continue;
      if (!verbose && (who == Audience::verbose || who == Audience::explained)) continue;
      shown_.push_back(k);
    }
    const auto is_marked = [](const Table::Row& row) { return row.marked; };
    marks_ = std::ranges::any_of(table.rows, is_marked) ? gap : 0;
  }

  /// The first entry is the head, without which a table is broken into lines. `drops` leaves
  /// columns out until it fits; their heads are in `left_out` then.
  std::optional<std::vector<std::vector<std::string>>> fitting(bool drops) {
    measure();
    while (!share()) {
      if (!drops || !drop_last()) return std::nullopt;
      measure();
    }
    return all_lines(true);
  }
  std::vector<std::vector<std::string>> broken_lines() { return all_lines(false); }

  [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }

 private:
  std::vector<std::vector<std::string>> all_lines(bool fits) const {
    std::vector<std::vector<std::string>> all(1);
    if (fits) all.front() = head();
    for (const Table::Row& row : table_.rows) all.push_back(fits ? side_by_side(row) : below(row));
    return all;
  }

  /// The last column that may go: the first two say what a row is about, sentences can be broken.
  bool drop_last() {
    for (std::size_t k = shown_.size(); k-- > 2;) {
      if (column(k).stays || column(k).wraps) continue;
      left_out_.insert(left_out_.begin(), column(k).head);
      shown_.erase(shown_.begin() + static_cast<std::ptrdiff_t>(k));
      return true;
    }
    return false;
  }

  [[nodiscard]] const Column& column(std::size_t k) const { return table_.columns[shown_[k]]; }
  [[nodiscard]] Text cell(const Table::Row& row, std::size_t k) const {
    return shown_[k] < row.cells.size() ? row.cells[shown_[k]] : Text{};
  }

  void measure() {
    widths_.assign(shown_.size(), 0);
    for (std::size_t k = 0; k < shown_.size(); ++k) {
      widths_[k] = unbroken(column(k).head, false).columns;
      for (const Table::Row& row : table_.rows) {
        widths_[k] = std::max(widths_[k], unbroken(cell(row, k), false).columns);
      }
    }
  }

  [[nodiscard]] std::size_t total() const {
    const std::size_t gaps = shown_.empty() ? 0 : gap * (shown_.size() - 1);
    return std::accumulate(widths_.begin(), widths_.end(), marks_ + gaps);
  }

  /// What a column needs at least: its longest word.
  [[nodiscard]] std::size_t least(std::size_t k) const {
    std::size_t columns = least_wide;
    for (const Table::Row& row : table_.rows) {
      for (const TextLine& line : broken(cell(row, k), least_wide, false)) {
        columns = std::max(columns, line.columns);
      }
    }
    return columns;
  }

  /// Narrows columns until the table fits; false if it cannot.
  bool share() {
    if (total() <= width_) return true;
    std::vector<std::size_t> broken_columns;
    for (std::size_t k = 0; k < shown_.size(); ++k) {
      if (column(k).wraps) broken_columns.push_back(k);
    }
    if (broken_columns.empty()) {
      std::vector<std::size_t> all(shown_.size());
      std::iota(all.begin(), all.end(), std::size_t{0});
      std::ranges::copy_if(all, std::back_inserter(broken_columns), [&](std::size_t k) {
        return column(k).align == Column::Align::left && widths_[k] > least_wide;
      });
    }
    std::vector<std::size_t> leasts(shown_.size());
    for (const std::size_t k : broken_columns) leasts[k] = least(k);
    while (total() > width_) {
      std::erase_if(broken_columns, [&](std::size_t k) { return widths_[k] <= leasts[k]; });
      // The widest gives, so that in the end they are equally wide.
      const auto widest =
          std::ranges::max_element(broken_columns, {}, [&](std::size_t k) { return widths_[k]; });
      if (widest == broken_columns.end()) return false;
      --widths_[*widest];
    }
    return true;
  }

  [[nodiscard]] std::vector<std::string> head() const {
    Table::Row row;
    row.cells.resize(table_.columns.size());
    bool empty = true;
    for (std::size_t k = 0; k < shown_.size(); ++k) {
      row.cells[shown_[k]] = strong(column(k).head);
      empty = empty && column(k).head.empty();
    }
    return empty ? std::vector<std::string>{} : side_by_side(row);
  }

  [[nodiscard]] std::vector<std::string> side_by_side(const Table::Row& row) const {
    std::vector<std::vector<TextLine>> cells;
    std::size_t height = 1;
    for (std::size_t k = 0; k < shown_.size(); ++k) {
      cells.push_back(broken(cell(row, k), widths_[k], colours_));
      height = std::max(height, cells.back().size());
    }
    std::vector<std::string> lines;
    for (std::size_t line = 0; line < height; ++line) {
      std::string text = marks_ == 0 ? "" : row.marked && line == 0 ? "* " : "  ";
      std::size_t padding = 0;
      for (std::size_t k = 0; k < cells.size(); ++k) {
        const TextLine part = line < cells[k].size() ? cells[k][line] : TextLine{};
        const std::size_t left_over = widths_[k] - std::min(widths_[k], part.columns);
        const bool right = column(k).align == Column::Align::right;
        text += std::string(padding + (right ? left_over : 0), ' ') + part.shown;
        padding = gap + (right ? 0 : left_over);
      }
      lines.push_back(std::move(text));
    }
    return lines;
  }

  /// "head: cell", one below the other.
  [[nodiscard]] std::vector<std::string> below(const Table::Row& row) const {
    std::vector<std::string> lines;
    for (std::size_t k = 0; k < shown_.size(); ++k) {
      const Text text = cell(row, k);
      if (text.empty()) continue;
      const std::string label = column(k).head.empty() ? "" : column(k).head + ": ";
      const std::string indent = lines.empty() ? "" : "  ";
      for (const TextLine& part : broken(Text{label} + text, width_ - gap - 2, colours_)) {
        const bool first = lines.empty();
        lines.push_back((first && row.marked ? "* " : indent) + part.shown);
      }
    }
    return lines;
  }

  const Table& table_;
  std::size_t width_;
  bool colours_;
  std::vector<std::size_t> shown_;     ///< columns of the table that the reader gets to see
  std::vector<std::size_t> widths_;    ///< of those
  std::vector<std::string> left_out_;  ///< heads of columns that a narrow terminal has no room for
  std::size_t marks_ = 0;              ///< columns in front of all, for the marks of rows
};

}  // namespace

std::vector<std::vector<std::string>> table_lines(const Table& table, std::size_t width,
                                                  const Terminal& terminal) {
  constexpr std::size_t wide_columns = 140;  // of tables that are not broken
  if (terminal.drops_columns && !terminal.verbose) {
    TextTable narrow{table, width, terminal.colours, terminal.verbose};
    if (auto lines = narrow.fitting(true)) {
      if (narrow.left_out().empty()) return *std::move(lines);
      lines->front().insert(
          lines->front().begin(),
          fmt::format("(not at this width: {}; -v shows all)", fmt::join(narrow.left_out(), ", ")));
      return *std::move(lines);
    }
  }
  TextTable whole{table, table.wide ? std::max(width, wide_columns) : width, terminal.colours,
                  terminal.verbose};
  auto lines = whole.fitting(false);
  return lines ? *std::move(lines) : whole.broken_lines();
}

}  // namespace stormproof::report
