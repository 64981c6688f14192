// Recursive descent, one function for each form of a value. A mistake is noted once, and everything
// returns at once: the engine of the page has no exceptions.
#include "checker/page/plain_yaml.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace stormproof::page {

using model::config::InputError;
using model::config::Member;
using model::config::Node;
using model::config::Place;
using model::config::quote;
using model::config::Result;

namespace {

constexpr std::string_view unknown_beginnings = "&*!?%@`|>";

class Reader {
 public:
  Reader(std::string_view text, const std::string& source)
      : text_{text}, source_{std::make_shared<const std::string>(source)} {}

  Result<Node> read() {
    for (const char c : text_) {
      const auto byte = static_cast<unsigned char>(c);
      if ((byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7f) {
        fail(fmt::format("control character 0x{:02x}; expected text", byte));
        return *error_;
      }
      if (!move_over(c)) return *error_;
    }
    at_ = line_begin_ = 0;
    line_ = 1;
    to_content();
    if (!error_ && is_end()) fail("nothing in it");
    Node root = error_ ? Node{} : block(0);
    if (!error_) to_content();
    if (!error_ && !is_end()) fail("more than one value; expected a map and nothing after it");
    if (error_) return *error_;
    return root;
  }

 private:
  // Where the reader stands.
  [[nodiscard]] bool is_end() const { return at_ >= text_.size(); }
  [[nodiscard]] char look(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\n';
  }
  [[nodiscard]] std::size_t column() const { return at_ - line_begin_; }
  [[nodiscard]] Place here() const { return {source_, line_, static_cast<int>(column()) + 1}; }
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  static bool is_gap(char c) { return is_blank(c) || c == '\n'; }

  bool move_over(char c) {
    ++at_;
    if (c == '\n') {
      ++line_;
      line_begin_ = at_;
    }
    return !error_;
  }
  void skip() { move_over(look()); }

  void fail(std::string message) { fail(here(), std::move(message)); }
  void fail(const Place& place, std::string message) {
    if (!error_) error_ = model::config::error_at(place, std::move(message));
  }

  /// To the next character that is neither blank nor in a comment.
  void to_content() {
    while (!is_end()) {
      if (look() == '#' && (at_ == 0 || is_gap(text_[at_ - 1]))) {
        while (!is_end() && look() != '\n') ++at_;
      } else if (look() == '\t' && text_.substr(line_begin_, column()).find_first_not_of(' ') ==
                                       std::string_view::npos) {
        return fail("a tab before the text of a line; expected spaces");
      } else if (is_gap(look())) {
        skip();
      } else {
        return;
      }
    }
  }
  /// To the next such character of the line; false if there is none.
  bool to_content_of_line() {
    while (is_blank(look())) ++at_;
    return look() != '\n' && look() != '#';
  }

  [[nodiscard]] bool begins_item() const { return look() == '-' && is_gap(look(1)); }

  /// Whether the line goes on with a key: text, a colon, and a gap.
  [[nodiscard]] bool begins_member() const {
    std::size_t k = at_;
    if (look() == '\'' || look() == '"') {
      const std::size_t end = text_.find(look(), at_ + 1);
      if (end == std::string_view::npos) return false;
      k = end + 1;
      while (k < text_.size() && is_blank(text_[k])) ++k;
      return k < text_.size() && text_[k] == ':' && (k + 1 == text_.size() || is_gap(text_[k + 1]));
    }
    for (; k < text_.size() && text_[k] != '\n'; ++k) {
      if (text_[k] == '#' && k > at_ && is_gap(text_[k - 1])) return false;
      if (text_[k] == ':' && (k + 1 == text_.size() || is_gap(text_[k + 1]))) return true;
    }
    return false;
  }

  /// The value that begins here and whose lines are at `indent` or deeper.
  Node block(std::size_t indent) {
    if (error_) return {};
    if (text_.substr(at_, 3) == "---" || text_.substr(at_, 3) == "...") {
      fail("the border of a document; expected one document without borders");
      return {};
    }
    if (begins_item()) return block_list(column());
    if (look() != '{' && look() != '[' && begins_member()) return block_map(column());
    return inline_value(indent);
  }

  Node block_list(std::size_t indent) {
    const Deeper deeper{*this};
    Node list;
    list.kind = Node::Kind::sequence;
    list.place = here();
    while (!error_ && !is_end() && column() == indent && begins_item()) {
      const Place dash = here();
      skip();
      if (to_content_of_line()) {
        list.items.push_back(block(indent + 1));
      } else {
        to_content();
        Node missing;
        missing.place = dash;
        list.items.push_back(!is_end() && column() > indent ? block(indent + 1) : missing);
      }
      to_content();
      expect_line_at_most(indent);
    }
    return list;
  }

  Node block_map(std::size_t indent) {
    const Deeper deeper{*this};
    Node map = Node::map(here());
    while (!error_ && !is_end() && column() == indent && !begins_item()) {
      if (!begins_member()) {
        fail("no key; expected a key and a colon, as on the lines above");
        break;
      }
      Node key = look() == '\'' || look() == '"' ? quoted() : plain_key();
      while (is_blank(look())) ++at_;
      skip();  // the colon
      add(map, std::move(key), [&] { return member_value(indent); });
      to_content();
      expect_line_at_most(indent);
    }
    return map;
  }

  /// What stands behind the colon, or below it.
  Node member_value(std::size_t indent) {
    if (to_content_of_line()) return inline_value(indent + 1);
    to_content();
    if (!is_end() && (column() > indent || (column() == indent && begins_item()))) {
      return block(indent + (begins_item() ? 0 : 1));
    }
    return {};
  }

  void expect_line_at_most(std::size_t indent) {
    if (error_ || is_end() || column() <= indent) return;
    fail(fmt::format("text in column {}; expected a line that begins in column {} or before",
                     column() + 1, indent + 1));
  }

  Node inline_value(std::size_t indent) {
    if (look() == '{') return flow_map();
    if (look() == '[') return flow_list();
    if (look() == '\'' || look() == '"') return quoted();
    if (look() == '>' && look(1) == '-' && is_gap(look(2))) return folded(indent);
    if (!check_beginning()) return {};
    return plain(indent, false);
  }

  bool check_beginning() {
    if (unknown_beginnings.find(look()) == std::string_view::npos) return true;
    fail(
        fmt::format("{} begins what this page does not read; expected a map, a list, text, a "
                    "number or \">-\"",
                    quote(text_.substr(at_, 1))));
    return false;
  }

  Node flow_map() {
    const Deeper deeper{*this};
    Node map = Node::map(here());
    skip();
    for (to_content(); !error_ && look() != '}'; to_content()) {
      if (is_end()) return unfinished(map.place, '}');
      Node key = look() == '\'' || look() == '"' ? quoted() : plain(0, true);
      to_content();
      if (error_) break;
      if (look() != ':') {
        fail(fmt::format("no value of key {}; expected a colon and a value", quote(key.text)));
        break;
      }
      skip();
      add(map, std::move(key), [&] {
        to_content();
        return look() == ',' || look() == '}' ? Node{} : flow_value();
      });
      to_content();
      if (!error_ && look() == ',')
        skip();
      else if (!error_ && look() != '}')
        return unfinished(map.place, '}');
    }
    if (!error_) skip();
    return map;
  }
  Node flow_list() {
    const Deeper deeper{*this};
    Node list;
    list.kind = Node::Kind::sequence;
    list.place = here();
    skip();
    for (to_content(); !error_ && look() != ']'; to_content()) {
      if (is_end()) return unfinished(list.place, ']');
      list.items.push_back(flow_value());
      to_content();
      if (!error_ && look() == ',')
        skip();
      else if (!error_ && look() != ']')
        return unfinished(list.place, ']');
    }
    if (!error_) skip();
    return list;
  }

  Node flow_value() {
    if (look() == '{') return flow_map();
    if (look() == '[') return flow_list();
    if (look() == '\'' || look() == '"') return quoted();
    if (!check_beginning()) return {};
    return plain(0, true);
  }

  Node unfinished(const Place& from, char end) {
    fail(fmt::format("expected ',' or '{}' of what begins at line {}", end, from.line));
    return {};
  }

  /// A value that is missing or null is where its key is.
  template <class Value>
  void add(Node& map, Node key, const Value& value) {
    if (error_) return;
    if (map.find(key.text) != nullptr) {
      return fail(key.place, fmt::format("key {} is given twice", quote(key.text)));
    }
    const Place place = key.place;
    map.members.push_back({std::move(key.text), place, value()});
    Node& added = map.members.back().value;
    if (added.kind == Node::Kind::null) added.place = place;
  }

  Node plain_key() {
    Node key = Node::scalar(here(), {});
    if (!check_beginning()) return key;
    const std::size_t begin = at_;
    while (!(look() == ':' && is_gap(look(1)))) ++at_;
    key.text = model::config::trimmed(text_.substr(begin, at_ - begin));
    return key;
  }

  /// Text without quotes. It goes on in lines that are at `indent` or deeper, in a flow until what
  /// ends a value there.
  Node plain(std::size_t indent, bool in_flow) {
    const Place place = here();
    std::string value;
    for (bool first = true;; first = false) {
      const std::size_t begin = at_;
      while (look() != '\n' && !ends_plain(in_flow)) ++at_;
      if (!first && !in_flow && look() == ':') fail("a key within text; expected quotes around it");
      value += model::config::trimmed(text_.substr(begin, at_ - begin));
      if (error_ || is_end() || (look() != '\n' && look() != '#')) break;
      if (look() == '#') break;
      const auto [line, line_begin, at] = std::tuple{line_, line_begin_, at_};
      std::size_t breaks = 0;
      while (!is_end() && is_gap(look())) {
        if (look() == '\n') ++breaks;
        skip();
      }
      const bool goes_on = !is_end() && look() != '#' &&
                           (in_flow ? !ends_plain(true) : column() >= indent && indent > 0);
      if (!goes_on) {
        line_ = line;
        line_begin_ = line_begin;
        at_ = at;
        break;
      }
      value += breaks > 1 ? std::string(breaks - 1, '\n') : " ";
    }
    if (value.empty() && !error_) fail("no value; expected text or a number");
    Node node = Node::scalar(place, std::move(value));
    const bool is_null =
        node.text == "~" || node.text == "null" || node.text == "Null" || node.text == "NULL";
    if (is_null) {
      node.kind = Node::Kind::null;
      node.text.clear();
    }
    return node;
  }
  [[nodiscard]] bool ends_plain(bool in_flow) const {
    if (look() == '#') return at_ > 0 && is_gap(text_[at_ - 1]);
    if (look() == ':') {
      const char next = look(1);
      return is_gap(next) || (in_flow && (next == ',' || next == '}' || next == ']'));
    }
    return in_flow && std::string_view{",{}[]"}.find(look()) != std::string_view::npos;
  }

  Node quoted() {
    Node node = Node::scalar(here(), {}, true);
    const char end = look();
    for (++at_;; ++at_) {
      if (look() == '\n') {
        fail(node.place, "no closing quote in the line");
        return node;
      }
      if (look() == end && end == '\'' && look(1) == '\'') {
        ++at_;
      } else if (look() == end) {
        ++at_;
        return node;
      } else if (look() == '\\' && end == '"') {
        ++at_;
        const std::string_view known = "\"\\/nt";
        const std::size_t which = known.find(look());
        if (which == std::string_view::npos) {
          fail("an escape that this page does not read; expected \\\", \\\\, \\/, \\n or \\t");
          return node;
        }
        node.text += "\"\\/\n\t"[which];
        continue;
      }
      node.text += look();
    }
  }

  /// ">-": lines that are deeper than the key, joined by blanks.
  Node folded(std::size_t indent) {
    Node node = Node::scalar(here(), {}, true);
    while (look() != '\n') ++at_;
    std::optional<std::size_t> deep;
    std::size_t breaks = 0;
    while (!is_end()) {
      const auto [line, line_begin, at] = std::tuple{line_, line_begin_, at_};
      skip();
      while (look() == ' ' && (!deep || column() < *deep)) ++at_;
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      const std::string_view words = text_.substr(at_, end - at_);
      if (model::config::trimmed(words).empty()) {
        ++breaks;
        at_ = end;
        continue;
      }
      if (column() < std::max<std::size_t>(indent, 1) || (deep && column() < *deep)) {
        line_ = line;
        line_begin_ = line_begin;
        at_ = at;
        break;
      }
      if (look() == ' ') fail("a line deeper than the first one; expected all in one column");
      if (deep) node.text += breaks > 0 ? std::string(breaks, '\n') : " ";
      deep = column();
      breaks = 0;
      node.text += words.ends_with('\r') ? words.substr(0, words.size() - 1) : words;
      at_ = end;
    }
    return node;
  }

  /// Counts levels.
  struct Deeper {
    explicit Deeper(Reader& reader) : depth{reader.depth_} {
      if (++depth > model::config::max_tree_depth) {
        reader.fail(fmt::format("nested more than {} levels deep", model::config::max_tree_depth));
      }
    }
    ~Deeper() { --depth; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    std::size_t& depth;
  };

  std::string_view text_;
  std::shared_ptr<const std::string> source_;
  std::size_t at_ = 0;
  std::size_t line_begin_ = 0;
  int line_ = 1;
  std::size_t depth_ = 0;
  std::optional<InputError> error_;
};

}  // namespace

Result<Node> parse_plain_yaml(std::string_view text, const std::string& source) {
  return Reader{text, source}.read();
}

}  // namespace stormproof::page
