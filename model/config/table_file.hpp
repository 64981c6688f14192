// Files of `specs` that are tables: maps of names to entries, which are read key by key. What is
// known of distributions and of environment variables is such a file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/config/tree/result.hpp"
#include "model/config/tree/tree.hpp"

namespace stormproof::model::config {

/// The file `name` in the first of these folders that has one.
[[nodiscard]] std::optional<std::string> file_in(const std::vector<std::string>& directories,
                                                 const std::string& name);

/// A file with these tables and nothing else.
[[nodiscard]] Result<Node> load_tables(const std::string& file,
                                       const std::vector<std::string>& tables);

/// The entries of the table, which is a map of `what` ("variables").
[[nodiscard]] Result<std::vector<Member>> entries_of(const Node& root, std::string_view table,
                                                     std::string_view what);

/// Reads one entry, key by key; the first mistake wins.
class EntryReader {
 public:
  EntryReader(const Node& map, std::string_view table, const std::string& name,
              const std::vector<std::string>& keys);

  [[nodiscard]] std::string text(std::string_view key);
  /// Empty if the key is absent.
  [[nodiscard]] std::string optional_text(std::string_view key);
  /// A list of `what`.
  [[nodiscard]] std::vector<std::string> texts(std::string_view key, std::string_view what);
  /// A map of `what`, in the order of the file; empty if the key is absent.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> pairs(std::string_view key,
                                                                       std::string_view what);

  [[nodiscard]] const std::optional<InputError>& error() const { return error_; }

 private:
  const Node* required(std::string_view key, std::string_view expected);
  std::string text_of(const Node& node, std::string_view key);
  void complain(const Node& node, std::string_view key, std::string_view expected);

  const Node& map_;
  std::string path_;
  std::optional<InputError> error_;
};

}  // namespace stormproof::model::config
