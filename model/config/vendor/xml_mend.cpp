// One pass over the markup: comments, declarations, character data, tags.
#include "model/config/vendor/xml_mend.hpp"

#include <algorithm>
#include <iterator>

namespace stormproof::model::config::vendor {
namespace {

constexpr std::string_view wrapper_start = "<_>";
constexpr std::string_view wrapper_end = "</_>";

class Mender {
 public:
  explicit Mender(std::string_view text) : text_{text} {}

  MendedXml run() && {
    if (text_.starts_with(utf8_mark)) copy(utf8_mark.size());
    while (next_ < text_.size()) {
      const std::string_view rest = text_.substr(next_);
      if (rest.starts_with("<!--")) {
        comment();
      } else if (rest.starts_with("<![CDATA[")) {
        copy_through("]]>");
      } else if (rest.starts_with("<?")) {
        instruction();
      } else if (rest.starts_with("<!")) {
        copy_through(">");
      } else if (rest.starts_with("</")) {
        end_tag();
      } else if (rest.starts_with('<')) {
        start_tag();
      } else {
        copy(std::min(rest.find('<'), rest.size()));
      }
    }
    close_what_is_open();
    if (roots_ > 1) wrap();
    std::size_t before = 0;
    for (MendedXml::Insertion& one : mended_.insertions) {
      one.before = before;
      before += one.length;
    }
    return std::move(mended_);
  }

 private:
  void copy(std::size_t length) {
    mended_.text += text_.substr(next_, length);
    next_ += std::min(length, text_.size() - next_);
  }

  void copy_through(std::string_view end) {
    const std::size_t found = text_.find(end, next_);
    copy(found == std::string_view::npos ? text_.size() - next_ : found + end.size() - next_);
  }

  void insert(std::string_view text) {
    mended_.insertions.push_back({mended_.text.size(), text.size()});
    mended_.text += text;
  }

  void note(XmlOddity oddity, std::size_t offset) { mended_.oddities.push_back({oddity, offset}); }

  void comment() {
    constexpr std::string_view start = "<!--";
    const std::size_t begin = next_ + start.size();
    const std::size_t end = text_.find("-->", begin);
    if (end == std::string_view::npos) return copy(text_.size() - next_);
    std::string content{text_.substr(begin, end - begin)};
    bool is_odd = false;
    for (std::size_t k = 0; k < content.size(); ++k) {
      const bool follows = k > 0 && content[k - 1] == '-';
      if (content[k] != '-' || !(follows || k + 1 == content.size())) continue;
      content[k] = ' ';
      is_odd = true;
    }
    if (is_odd) note(XmlOddity::hyphens, next_);
    copy(start.size());
    mended_.text += content;
    next_ = end;
    copy(std::string_view{"-->"}.size());
  }

  void instruction() {
    const bool is_declaration = text_.substr(next_).starts_with("<?xml") &&
                                next_ + 5 < text_.size() &&
                                blanks.find(text_[next_ + 5]) != std::string_view::npos;
    const std::string_view before = mended_.text;
    const bool is_late = is_declaration && !before.empty() &&
                         before.find_first_not_of(blanks) == std::string_view::npos;
    if (!is_late) return copy_through("?>");
    note(XmlOddity::blanks, 0);
    const std::size_t start = mended_.text.size();
    copy_through("?>");
    std::replace_if(
        mended_.text.begin() + static_cast<std::ptrdiff_t>(start), mended_.text.end(),
        [](char one) { return blanks.find(one) == std::string_view::npos; }, ' ');
  }

  void end_tag() {
    constexpr std::string_view start = "</";
    const std::size_t end = std::min(text_.find('>', next_), text_.size());
    const std::string_view name = text_.substr(next_ + start.size(), end - next_ - start.size());
    if (name.find_first_not_of(blanks) == std::string_view::npos && !open_.empty()) {
      note(XmlOddity::nameless_end, next_);
      copy(start.size());
      insert(open_.back());
    }
    const std::size_t last = name.find_last_not_of(blanks);
    const bool is_named = last != std::string_view::npos;
    crosses_ =
        crosses_ || (is_named && (open_.empty() || open_.back() != name.substr(0, last + 1)));
    if (!open_.empty()) open_.pop_back();
    copy_through(">");
  }

  void start_tag() {
    if (open_.empty()) {
      if (++roots_ == 1) first_root_ = mended_.text.size();
      if (roots_ > 1) note(XmlOddity::second_root, next_);
    }
    const std::size_t name_end = text_.find_first_of(" \t\r\n/>", next_);
    const std::string_view name = text_.substr(next_ + 1, name_end - next_ - 1);
    char quote = '\0';
    std::size_t end = next_;
    for (; end < text_.size() && (quote != '\0' || text_[end] != '>'); ++end) {
      const char one = text_[end];
      if (quote == '\0' && (one == '"' || one == '\'')) {
        quote = one;
      } else if (one == quote) {
        quote = '\0';
      }
    }
    if (end < text_.size() && text_[end - 1] != '/') open_.emplace_back(name);
    copy(end + 1 - next_);
  }

  /// Nothing that the parser refuses anyway.
  void close_what_is_open() {
    if (crosses_) return;
    if (!open_.empty()) note(XmlOddity::missing_end, text_.size());
    for (; !open_.empty(); open_.pop_back()) insert("</" + open_.back() + ">");
  }

  void wrap() {
    mended_.is_wrapped = true;
    mended_.text.insert(first_root_, wrapper_start);
    for (MendedXml::Insertion& one : mended_.insertions) one.at += wrapper_start.size();
    mended_.insertions.insert(mended_.insertions.begin(), {first_root_, wrapper_start.size()});
    insert(wrapper_end);
  }

  std::string_view text_;
  std::size_t next_ = 0;
  MendedXml mended_;
  std::vector<std::string> open_;  ///< names
  std::size_t roots_ = 0;
  std::size_t first_root_ = 0;  ///< in the mended text
  bool crosses_ = false;        ///< an end is not that of what is open
};

}  // namespace

std::size_t MendedXml::original(std::size_t offset) const {
  const auto after = std::ranges::upper_bound(insertions, offset, {}, &Insertion::at);
  if (after == insertions.begin()) return offset;
  const Insertion& last = *std::prev(after);
  return offset - last.before - std::min(last.length, offset - last.at);
}

MendedXml mend_xml(std::string_view text) { return Mender{text}.run(); }

}  // namespace stormproof::model::config::vendor
