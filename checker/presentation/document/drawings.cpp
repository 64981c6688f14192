// Splits drawings into parts, and rewrites their style sheets. Both are made by this program (by
// draw::Svg), so a splitter for their shape is enough: rules, and media queries with rules in them.
#include "checker/presentation/document/drawings.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::report {

namespace {

/// Takes what stands between `open` and `close` out of `text`, with both of them.
std::string take(std::string& text, std::string_view open, std::string_view close) {
  const std::size_t begin = text.find(open);
  if (begin == std::string::npos) return {};
  const std::size_t inner = begin + open.size();
  const std::size_t end = text.find(close, inner);
  if (end == std::string::npos) return {};
  std::string found = text.substr(inner, end - inner);
  text.erase(begin, end + close.size() - begin);
  return found;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \n\t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \n\t") - begin + 1);
}

/// ".a, .b" → "SCOPE .a, SCOPE .b"; the element svg is the scope itself.
std::string scoped_selectors(std::string_view selectors, std::string_view scope) {
  std::string result;
  while (!selectors.empty()) {
    const std::size_t comma = std::min(selectors.find(','), selectors.size());
    const std::string_view one = trimmed(selectors.substr(0, comma));
    if (!result.empty()) result += ", ";
    result += scope;
    if (one != "svg") result += " " + std::string{one};
    selectors.remove_prefix(std::min(comma + 1, selectors.size()));
  }
  return result;
}

struct CssBlock {
  std::string_view prelude;
  std::string_view body;
};

/// Takes the next "prelude { body }" off the front; an empty prelude at the end.
CssBlock take_block(std::string_view& css) {
  const std::size_t open = css.find('{');
  if (open == std::string_view::npos) return {};
  std::size_t depth = 0;
  std::size_t end = open;
  for (; end < css.size(); ++end) {
    if (css[end] == '{') ++depth;
    if (css[end] == '}' && --depth == 0) break;
  }
  const CssBlock block{trimmed(css.substr(0, open)), trimmed(css.substr(open + 1, end - open - 1))};
  css.remove_prefix(std::min(end + 1, css.size()));
  return block;
}

std::string scoped_rules(std::string_view css, const std::string& scope) {
  std::string result;
  for (CssBlock block = take_block(css); !block.prelude.empty(); block = take_block(css)) {
    if (!block.prelude.starts_with("@media")) {
      result += fmt::format("{} {{ {} }}\n", scoped_selectors(block.prelude, scope), block.body);
      continue;
    }
    if (block.prelude.find("prefers-color-scheme: dark") == std::string_view::npos) {
      result += fmt::format("{} {{\n{}}}\n", block.prelude, scoped_rules(block.body, scope));
      continue;
    }
    result += fmt::format(
        "@media screen and (prefers-color-scheme: dark) {{\n{}}}\n@media screen {{\n{}}}\n",
        scoped_rules(block.body, ":root:not([data-theme=\"light\"]) " + scope),
        scoped_rules(block.body, ":root[data-theme=\"dark\"] " + scope));
  }
  return result;
}

std::string class_of(std::size_t kind) { return fmt::format("art-{}", kind); }

}  // namespace

std::string Drawings::add(std::string_view svg, std::string_view id) {
  const std::size_t root = svg.find("<svg");
  if (root == std::string_view::npos) return {};
  std::string drawing = valid_text(svg.substr(root));
  Kind kind{take(drawing, "<style>", "</style>"), take(drawing, "<defs>", "</defs>")};
  const auto same = [&](const Kind& other) {
    return other.style == kind.style && other.definitions == kind.definitions;
  };
  const auto known = std::find_if(kinds_.begin(), kinds_.end(), same);
  const auto number = static_cast<std::size_t>(known - kinds_.begin());
  if (known == kinds_.end()) kinds_.push_back(std::move(kind));
  const std::string name = id.empty() ? "" : fmt::format(" id=\"{}\"", id);
  drawing.insert(4, fmt::format("{} class=\"art {}\"", name, class_of(number)));
  return drawing;
}

std::string Drawings::style() const {
  std::string css;
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    std::string rules = scoped_rules(kinds_[k].style, "." + class_of(k));
    replace_all(rules, "url(#", "url(#" + class_of(k) + "-");
    css += rules;
  }
  return css;
}

std::string Drawings::definitions() const {
  std::string html;
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    std::string definitions = kinds_[k].definitions;
    replace_all(definitions, "id=\"", "id=\"" + class_of(k) + "-");
    html += fmt::format(
        "<svg class=\"heads {}\" width=\"0\" height=\"0\" aria-hidden=\"true\">"
        "<defs>{}</defs></svg>\n",
        class_of(k), definitions);
  }
  return html;
}

}  // namespace stormproof::report
