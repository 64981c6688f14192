// A tokenizer for the HTML that the reports write: tags, quoted attributes, raw text of script and
// style.
#include "tests/checker/presentation/document/html_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <set>

namespace stormproof::report {

namespace {

bool is_void(const std::string& name) {
  static const std::set<std::string> names{"meta", "br", "input", "link", "img", "hr"};
  return names.contains(name);
}

/// Without the data of paths, which are longer than a regular expression takes.
std::string without_paths(const std::string& page) {
  std::string rest;
  std::size_t from = 0;
  for (std::size_t at = page.find(" d=\"M"); at != std::string::npos;
       at = page.find(" d=\"M", from)) {
    rest += page.substr(from, at - from) + " d=\"";
    from = std::min(page.find_first_of("\"<>", at + 4), page.size());
  }
  return rest + page.substr(from);
}

}  // namespace

std::string html_fault(const std::string& whole_page) {
  const std::string page = without_paths(whole_page);
  static const std::regex tag{
      R"re(^<(/?)([a-zA-Z][a-zA-Z0-9]*)((?:\s+[a-zA-Z][a-zA-Z0-9:-]*(?:="[^"<]*")?)*)\s*(/?)>)re"};
  static const std::regex id{R"re(\sid="([^"]*)")re"};
  std::vector<std::string> open;
  std::set<std::string> ids;
  for (std::size_t at = page.find('<', 1); at != std::string::npos; at = page.find('<', at + 1)) {
    std::smatch found;
    const auto begin = page.begin() + static_cast<std::ptrdiff_t>(at);
    const auto end = page.begin() + static_cast<std::ptrdiff_t>(std::min(at + 4000, page.size()));
    if (!std::regex_search(begin, end, found, tag)) return "no tag: " + page.substr(at, 60);
    const std::string name = found[2];
    if (found[1].length() > 0) {
      if (open.empty() || open.back() != name) return "closes out of order: " + page.substr(at, 60);
      open.pop_back();
      continue;
    }
    const std::string attributes = found[3];
    std::smatch named;
    if (std::regex_search(attributes, named, id) && !ids.insert(named[1]).second) {
      return "twice: " + attributes;
    }
    if (is_void(name) || found[4].length() > 0) continue;
    if (name == "script" || name == "style") {
      at = page.find("</" + name, at);
      at = page.find('>', at);
      continue;
    }
    open.push_back(name);
  }
  return open.empty() ? "" : "never closed: " + open.back();
}

std::vector<std::string> outside_requests(const std::string& page) {
  // Text is escaped, so a '<' is a tag. Links and arrow heads inside the page begin with '#'.
  static const std::regex request{
      R"re(<(link|img|iframe|object|embed|base|audio|video|source|image|use)\b[^>]*>)re"
      R"re(|\s(src|srcset|data|action|poster|xlink:href)="[^"]*"|\shref="[^#][^"]*")re"
      R"re(|url\([^#)][^)]*\)|@import[^;]*|@font-face|\b(fetch|XMLHttpRequest|WebSocket)\b)re"};
  std::vector<std::string> found;
  for (std::sregex_iterator next{page.begin(), page.end(), request}, end; next != end; ++next) {
    found.push_back(next->str());
  }
  return found;
}

std::map<std::string, std::string> colours(const std::string& css, const std::string& selector) {
  std::map<std::string, std::string> result;
  const std::size_t at = css.find(selector);
  if (at == std::string::npos) return result;
  const std::size_t open = css.find('{', at + selector.size() - 1);
  const std::string body = css.substr(open, css.find('}', open) - open);
  static const std::regex property{R"re((--[a-z-]+):\s*(#[0-9a-f]{6}))re"};
  for (std::sregex_iterator next{body.begin(), body.end(), property}, end; next != end; ++next) {
    result[(*next)[1]] = (*next)[2];
  }
  return result;
}

double contrast(const std::string& a, const std::string& b) {
  const auto luminance = [](const std::string& colour) {
    constexpr std::array weights{0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double part = std::stoi(colour.substr(1 + 2 * k, 2), nullptr, 16) / 255.0;
      sum += weights[k] * (part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4));
    }
    return sum;
  };
  const double first = luminance(a);
  const double second = luminance(b);
  return (std::max(first, second) + 0.05) / (std::min(first, second) + 0.05);
}

}  // namespace stormproof::report
