// Escaping of Markdown. A backslash keeps punctuation from formatting; mentions (@) and references
// (#) are made later, from the rendered text, so an empty comment is put behind those.
#include <algorithm>

#include <fmt/core.h>

#include "checker/presentation/document/markdown.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::report {

namespace {

std::size_t longest_run_of_backticks(std::string_view text) {
  std::size_t longest = 0;
  std::size_t run = 0;
  for (const char c : text) {
    run = c == '`' ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

std::string html_entities(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else
      result += c;
  }
  return result;
}

}  // namespace

std::string md_text(std::string_view text) {
  std::string result;
  for (const char c : one_line(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '@':
      case '#':
        result += std::string{c} + "<!-- -->";
        break;
      default:
        if (std::string_view{"\\`*_[]|~!$"}.find(c) != std::string_view::npos) result += '\\';
        result += c;
    }
  }
  return result;
}

std::string md_code(std::string_view text) {
  std::string line = one_line(text);
  if (line.empty()) return "–";
  const std::string fence(longest_run_of_backticks(line) + 1, '`');
  if (line.front() == '`' || line.back() == '`') line = " " + line + " ";
  // A table takes "\|" for a bar, in code, too.
  for (std::size_t at = 0; (at = line.find('|', at)) != std::string::npos; at += 2) {
    line.insert(at, "\\");
  }
  return fence + line + fence;
}

std::string md_block(std::string_view language, std::string_view text) {
  std::string body = valid_text(text);
  if (body.empty() || body.back() != '\n') body += '\n';
  const std::string fence(std::max<std::size_t>(3, longest_run_of_backticks(body) + 1), '`');
  return fmt::format("{}{}\n{}{}\n", fence, language, body, fence);
}

std::string md_table(const std::vector<std::string>& head, std::string_view align,
                     const std::vector<std::vector<std::string>>& rows) {
  std::string text = "|";
  for (const std::string& cell : head) text += " " + cell + " |";
  text += "\n|";
  for (std::size_t k = 0; k < head.size(); ++k) {
    text += k < align.size() && align[k] == 'r' ? "---:|" : "---|";
  }
  text += "\n";
  for (const std::vector<std::string>& row : rows) {
    text += "|";
    for (const std::string& cell : row) text += " " + cell + " |";
    text += "\n";
  }
  return text;
}

std::string md_details(std::string_view summary, std::string_view body) {
  return fmt::format("<details><summary>{}</summary>\n\n{}\n</details>\n",
                     html_entities(one_line(summary)), body);
}

void MarkdownDocument::add(std::string name, std::string text) {
  if (!text.empty()) sections_.push_back({std::move(name), std::move(text)});
}

std::string MarkdownDocument::text(std::string_view elsewhere, std::size_t limit) const {
  constexpr std::size_t room_for_notice = 1'000;
  std::size_t needed = room_for_notice;
  for (const Section& section : sections_) {
    if (section.name.empty()) needed += section.text.size() + 1;
  }
  std::string text;
  std::string missing;
  for (const Section& section : sections_) {
    if (!section.name.empty()) {
      if (needed + section.text.size() + 1 > limit) {
        const std::string name = missing.empty() ? section.name : ", " + section.name;
        if (missing.ends_with(section.name)) continue;
        if (missing.size() + name.size() < room_for_notice / 2)
          missing += name;
        else if (!missing.ends_with("…"))
          missing += ", …";
        continue;
      }
      needed += section.text.size() + 1;
    }
    text += (text.empty() ? "" : "\n") + section.text;
  }
  if (!missing.empty()) {
    text += fmt::format("\nLeft out to fit into a comment: {}. {}\n", md_text(missing), elsewhere);
  }
  return text;
}

}  // namespace stormproof::report
