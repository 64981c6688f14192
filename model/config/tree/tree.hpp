// The tree that a YAML or JSON file becomes before anything is read from it. It exists because
// every node has to remember where it was written, through `base:` merging and `--set`, so that an
// error can point at the right line of the right file.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/config/tree/result.hpp"

namespace stormproof::model::config {

/// Deepest nesting of a tree, and most elements of a path given to `set_path`.
inline constexpr std::size_t max_tree_depth = 64;

/// Where a node was written.
struct Place {
  std::shared_ptr<const std::string>
      source;      ///< file name as it was given, or the `--set` argument
  int line = 0;    ///< from 1; 0: the source has no lines (`--set`)
  int column = 0;  ///< from 1, counted in bytes

  /// "file:line:column", or the source alone if it has no lines.
  [[nodiscard]] std::string to_string() const;
};

struct Member;

struct Node {
  enum class Kind { null, scalar, sequence, map };

  Kind kind = Kind::null;
  Place place;
  std::string text;             ///< of a scalar
  bool quoted = false;          ///< a scalar written in quotes is text, never a number
  std::vector<Node> items;      ///< of a sequence
  std::vector<Member> members;  ///< of a map, in the order of the file; keys are unique

  [[nodiscard]] static Node scalar(const Place& place, std::string text, bool quoted = false);
  /// Without members.
  [[nodiscard]] static Node map(const Place& place);

  [[nodiscard]] bool is_map() const { return kind == Kind::map; }
  [[nodiscard]] bool is_sequence() const { return kind == Kind::sequence; }
  [[nodiscard]] bool is_scalar() const { return kind == Kind::scalar; }

  /// The value of `key` in a map; null if there is none.
  [[nodiscard]] const Node* find(std::string_view key) const;
  [[nodiscard]] Node* find(std::string_view key);
  /// Takes `key` out of a map and returns its value.
  [[nodiscard]] std::optional<Node> take(std::string_view key);

  /// The offending value as an error message shows it: 'text' (shortened), "a list", "a map" or
  /// "nothing".
  [[nodiscard]] std::string shown() const;
};

struct Member {
  std::string key;
  Place key_place;
  Node value;
};

/// `path`.`key`, or `key` alone at the top.
[[nodiscard]] std::string join_path(std::string_view path, std::string_view key);

/// Where everything in a tree was written, by dotted key: "spdp.period"; elements of lists go by
/// number. A map is where its key is.
using Places = std::map<std::string, Place, std::less<>>;
[[nodiscard]] Places places_of(const Node& tree);

/// `text` without blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// `text` between quotes, control characters escaped, cut after 60 bytes; for error messages.
[[nodiscard]] std::string quote(std::string_view text);

/// An error at `place`.
[[nodiscard]] InputError error_at(const Place& place, std::string message);

/// `base` with the keys of `overriding` put over it: maps merge key by key, everything else is
/// replaced. The result is placed where `overriding` is.
[[nodiscard]] Node merge(Node base, Node overriding);

/// Puts `value` at the dotted `path`; elements of sequences go by number, missing maps are made.
/// Returns what is wrong with the path, if anything; then `root` may hold new empty maps.
[[nodiscard]] std::optional<std::string> set_path(Node& root, std::string_view path, Node value);

}  // namespace stormproof::model::config
