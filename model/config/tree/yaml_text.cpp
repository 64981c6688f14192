// Builds the tree from yaml-cpp's event stream rather than from its node graph: events carry marks
// for every node, show duplicate keys, tags and aliases, and can be stopped before a hostile file
// has grown in memory.
#include "model/config/tree/yaml_text.hpp"

#include <sstream>
#include <unordered_map>
#include <unordered_set>

#include <fmt/core.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

namespace stormproof::model::config {
namespace {

/// Stops the parser from inside an event; never leaves this file.
struct Refusal {
  InputError error;
};

class TreeBuilder final : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::shared_ptr<const std::string> source) : source_{std::move(source)} {}

  Node take_root() { return std::move(root_); }
  Place place(const YAML::Mark& mark) const { return {source_, mark.line + 1, mark.column + 1}; }

  void OnDocumentStart(const YAML::Mark& mark) override { root_.place = place(mark); }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add(make(Node::Kind::null, mark, "?"), anchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    Node node = make(Node::Kind::scalar, mark, tag);
    node.text = value;
    node.quoted = tag == "!";
    add(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto target = anchors_.find(anchor);
    if (target == anchors_.end()) refuse(place(mark), "an alias inside the value that it names");
    charge(target->second, place(mark));
    add(target->second, 0);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(make(Node::Kind::sequence, mark, tag), anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(make(Node::Kind::map, mark, tag), anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  /// A sequence or map whose end has not been seen yet.
  struct Unfinished {
    Node node;
    YAML::anchor_t anchor = 0;
    std::unordered_set<std::string> keys = {};
    bool has_key = false;  ///< the last member waits for its value
  };

  [[noreturn]] static void refuse(const Place& place, std::string message) {
    throw Refusal{error_at(place, std::move(message))};
  }

  Node make(Node::Kind kind, const YAML::Mark& mark, const std::string& tag) {
    if (!tag.empty() && tag != "?" && tag != "!") {
      refuse(place(mark),
             fmt::format("tag {} is not known; expected a value without a tag", quote(tag)));
    }
    count(1, 0, place(mark));
    Node node;
    node.kind = kind;
    node.place = place(mark);
    return node;
  }

  void count(std::size_t nodes, std::size_t text_bytes, const Place& where) {
    nodes_ += nodes;
    alias_bytes_ += text_bytes;
    if (nodes_ > max_tree_nodes) {
      refuse(where, fmt::format("more than {} values, aliases included", max_tree_nodes));
    }
    if (alias_bytes_ > max_file_bytes) {
      refuse(where, fmt::format("aliases expand to more than {} bytes", max_file_bytes));
    }
  }

  /// Counts a copy of `node` before it is made.
  void charge(const Node& node, const Place& where) {
    count(1, node.text.size(), where);
    for (const Node& item : node.items) charge(item, where);
    for (const Member& member : node.members) {
      count(0, member.key.size(), where);
      charge(member.value, where);
    }
  }

  void open(Node node, YAML::anchor_t anchor) {
    if (open_.size() == max_tree_depth) {
      refuse(node.place, fmt::format("nested more than {} levels deep", max_tree_depth));
    }
    open_.push_back({std::move(node), anchor});
  }

  void close() {
    Unfinished done = std::move(open_.back());
    open_.pop_back();
    add(std::move(done.node), done.anchor);
  }

  void add(Node node, YAML::anchor_t anchor) {
    if (anchor != 0) {
      charge(node, node.place);
      anchors_[anchor] = node;
    }
    if (open_.empty()) {
      root_ = std::move(node);
    } else if (open_.back().node.is_sequence()) {
      open_.back().node.items.push_back(std::move(node));
    } else if (Unfinished& map = open_.back(); map.has_key) {
      Member& member = map.node.members.back();
      if (node.kind == Node::Kind::null)
        node.place = member.key_place;  // a missing value has no mark
      member.value = std::move(node);
      map.has_key = false;
    } else {
      add_key(map, std::move(node));
    }
  }

  static void add_key(Unfinished& map, Node key) {
    if (!key.is_scalar()) {
      refuse(key.place, fmt::format("{} as a key; expected a key that is text", key.shown()));
    }
    if (!map.keys.insert(key.text).second) {
      refuse(key.place, fmt::format("key {} is given twice", quote(key.text)));
    }
    map.node.members.push_back({std::move(key.text), key.place, Node{}});
    map.has_key = true;
  }

  std::shared_ptr<const std::string> source_;
  Node root_;
  std::vector<Unfinished> open_;
  std::unordered_map<YAML::anchor_t, Node> anchors_;
  std::size_t nodes_ = 0;
  std::size_t alias_bytes_ = 0;
};

/// Length of the UTF-8 sequence at the start of `text`; 0 if it is not valid.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
  };
  const auto continues = [&](std::size_t k) { return (byte(k) & 0xC0u) == 0x80u; };
  if (byte(0) < 0x80) return 1;
  if (byte(0) < 0xC2 || byte(0) > 0xF4 || !continues(1)) return 0;
  if (byte(0) < 0xE0) return 2;
  if (!continues(2)) return 0;
  if (byte(0) < 0xF0) {
    const bool overlong = byte(0) == 0xE0 && byte(1) < 0xA0;
    const bool surrogate = byte(0) == 0xED && byte(1) >= 0xA0;
    return overlong || surrogate ? 0 : 3;
  }
  const bool overlong = byte(0) == 0xF0 && byte(1) < 0x90;
  const bool beyond_unicode = byte(0) == 0xF4 && byte(1) >= 0x90;
  return overlong || beyond_unicode || !continues(3) ? 0 : 4;
}

/// The text with a comment as its last line. Without it, yaml-cpp takes a line break before the end
/// of the file for a closing quote.
std::string with_final_comment(std::string_view text) {
  return std::string{text.substr(0, text.find_last_not_of(" \t\r\n") + 1)} + "\n#";
}

/// yaml-cpp replaces invalid UTF-8 silently and takes byte 0x04 for the end of the file, so both
/// are refused here.
void check_characters(std::string_view text, const std::shared_ptr<const std::string>& source) {
  Place here{source, 1, 1};
  for (std::size_t k = 0; k < text.size();) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const std::size_t length = utf8_length(text.substr(k));
    if (length == 0)
      throw Refusal{error_at(here, fmt::format("byte 0x{:02x} is not valid UTF-8", byte))};
    if ((byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7f) {
      throw Refusal{error_at(here, fmt::format("control character 0x{:02x}; expected text", byte))};
    }
    here.column = byte == '\n' ? 1 : here.column + static_cast<int>(length);
    if (byte == '\n') here.line += 1;
    k += length;
  }
}

}  // namespace

Result<Node> parse_yaml(std::string_view text, const std::string& source) {
  const auto name = std::make_shared<const std::string>(source);
  TreeBuilder builder{name};
  try {
    if (text.size() > max_file_bytes) {
      return InputError{source, fmt::format("longer than {} bytes", max_file_bytes)};
    }
    check_characters(text, name);
    std::istringstream stream{with_final_comment(text)};
    YAML::Parser parser{stream};
    if (!parser.HandleNextDocument(builder)) return InputError{source + ":1:1", "nothing in it"};
    Node root = builder.take_root();
    TreeBuilder second{name};
    if (parser.HandleNextDocument(second)) {
      return error_at(second.take_root().place, "a second document; expected only one");
    }
    return root;
  } catch (const Refusal& refusal) {
    return refusal.error;
  } catch (const YAML::Exception& error) {
    const Place place = error.mark.is_null() ? Place{name, 1, 1} : builder.place(error.mark);
    return error_at(place, "not valid YAML: " + error.msg);
  }
}

}  // namespace stormproof::model::config
