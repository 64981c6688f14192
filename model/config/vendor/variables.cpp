// Recursive descent over the text of a value.
#include "model/config/vendor/variables.hpp"

#include <atomic>
#include <cstdlib>

#include <fmt/core.h>

#include "model/config/tree/tree.hpp"

namespace stormproof::model::config::vendor {
namespace {

std::atomic<bool> from_environment = false;

constexpr std::size_t most_bytes = 65'536;
constexpr int deepest = 20;

/// Empty if it is not set, or if nobody is to look.
std::string value_of(const std::string& name) {
  const char* value = from_environment ? std::getenv(name.c_str()) : nullptr;
  return value == nullptr ? "" : value;
}

class Expander {
 public:
  /// What is wrong, or nothing.
  [[nodiscard]] const std::string& error() const { return error_; }
  [[nodiscard]] std::vector<std::string>& variables() { return variables_; }

  std::string expand(std::string_view text, int depth) {
    if (depth >= deepest) return fail("variables are nested too deeply");
    std::string out;
    while (!text.empty() && error_.empty()) {
      const std::size_t start = text.find("${");
      out += text.substr(0, start);
      if (start == std::string_view::npos) break;
      text.remove_prefix(start + 2);
      const std::size_t end = end_of(text);
      if (end == std::string_view::npos) return fail("${ without its }");
      out += variable(text.substr(0, end), depth);
      text.remove_prefix(end + 1);
      if (out.size() > most_bytes) return fail("variables make it too long");
    }
    return out;
  }

 private:
  std::string fail(std::string why) {
    if (error_.empty()) error_ = std::move(why);
    return {};
  }

  /// Of the '}' that belongs to the "${" before `text`; a '\' hides what follows.
  static std::size_t end_of(std::string_view text) {
    int nested = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
      if (text[k] == '\\') {
        ++k;
      } else if (text[k] == '{') {
        ++nested;
      } else if (text[k] == '}' && nested-- == 0) {
        return k;
      }
    }
    return std::string_view::npos;
  }

  std::string variable(std::string_view inside, int depth) {
    const std::size_t colon = inside.find(':');
    const std::string name{inside.substr(0, colon)};
    variables_.push_back(name);
    const std::string value = value_of(name);
    if (colon == std::string_view::npos) return value;
    const std::string_view rest = inside.substr(colon + 1);
    const char kind = rest.empty() ? '\0' : rest.front();
    const std::string_view other = rest.empty() ? rest : rest.substr(1);
    switch (kind) {
      case '-':
        return value.empty() ? expand(other, depth + 1) : value;
      case '+':
        return value.empty() ? "" : expand(other, depth + 1);
      case '?':
        if (!value.empty()) return value;
        return fail(fmt::format("variable {} is not set: {}", name, other));
      default:
        return fail(fmt::format("{} in an expansion; expected :-, :+ or :?",
                                quote(":" + std::string{rest.substr(0, 1)})));
    }
  }

  std::string error_;
  std::vector<std::string> variables_;
};

}  // namespace

void take_variables_from_environment() { from_environment = true; }

Parsed<Expanded> expand_variables(std::string_view text) {
  Expander expander;
  std::string expanded = expander.expand(text, 0);
  if (!expander.error().empty()) return expander.error();
  return Expanded{std::move(expanded), std::move(expander.variables())};
}

}  // namespace stormproof::model::config::vendor
