// Names of hosts are those of RFC 1123, with '_', which containers have. A text that could be one
// but is what a tutorial has in its place ("IP_ADDRESS", "192.168.1.X") counts as none.
#include "model/config/vendor/addresses.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

#include <fmt/core.h>

#include "model/config/tree/tree.hpp"
#include "model/config/vendor/any_case.hpp"

namespace stormproof::model::config::vendor {
namespace {

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_number(std::string_view text, unsigned most) {
  unsigned number = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  return failed == std::errc{} && end == text.data() + text.size() && number <= most;
}

/// Digits and points only: it is meant to be an IPv4 address.
bool is_numeric(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return is_digit(c) || c == '.'; });
}
bool is_ipv4(std::string_view text) {
  const auto parts = parts_of(text, '.');
  return parts.size() == 4 &&
         std::ranges::all_of(parts, [](std::string_view part) { return is_number(part, 255); });
}
/// Groups of hexadecimal digits; an interface may stand behind them, and an IPv4 address as the
/// last of them.
bool may_be_ipv6(std::string_view text) {
  text = text.substr(0, text.find('%'));
  return std::ranges::count(text, ':') >= 2 && std::ranges::all_of(text, [](char c) {
           return is_digit(c) || c == ':' || c == '.' || (c >= 'a' && c <= 'f') ||
                  (c >= 'A' && c <= 'F');
         });
}

/// "192.168.1.X", "x.x.x.x", "10.0.0.NNN": four parts, some of them numbers or one letter again and
/// again.
bool has_letters_for_numbers(std::string_view text) {
  const auto parts = parts_of(text, '.');
  const auto stands_for_one = [](std::string_view part) {
    return !part.empty() && part.size() <= 3 && is_letter(part.front()) &&
           part.find_first_not_of(part.front()) == std::string_view::npos;
  };
  return parts.size() == 4 && std::ranges::any_of(parts, stands_for_one) &&
         std::ranges::all_of(parts, [&](std::string_view part) {
           return is_number(part, 255) || stands_for_one(part);
         });
}

/// A word for an address in place of one: "IP_ADDRESS", "your-ip", "SERVER_IP".
bool is_word_for_address(std::string_view text) {
  std::string word = in_lower_case(text);
  std::ranges::replace(word, '-', '_');
  bool has_address = false;
  bool has_whose = false;
  bool is_nothing_else = true;
  for (const std::string_view part : parts_of(word, '_')) {
    const bool is_address = part == "ip" || part == "address" || part == "addr" ||
                            part == "ipaddress" || part == "ipaddr" || part == "ipv4";
    has_address = has_address || is_address;
    is_nothing_else = is_nothing_else && is_address;
    has_whose = has_whose || part == "your" || part == "my";
  }
  const bool is_loud = std::ranges::none_of(text, [](char c) { return c >= 'a' && c <= 'z'; });
  return has_address && (is_nothing_else || is_loud || has_whose);
}

}  // namespace

std::string why_no_address(std::string_view text) {
  if (trimmed(text).empty()) return "there is none";
  if (is_ipv4(text) || may_be_ipv6(text)) return {};
  const std::string shown = quote(text);
  if (is_numeric(text)) return fmt::format("{} is not four numbers of 0 to 255", shown);
  const auto is_of_name = [](char c) {
    return is_digit(c) || is_letter(c) || c == '.' || c == '-' || c == '_';
  };
  if (!std::ranges::all_of(text, is_of_name)) {
    return fmt::format("{} is neither an address nor the name of a host", shown);
  }
  if (is_word_for_address(text) || has_letters_for_numbers(text)) {
    return fmt::format("{} stands for an address, which is to be put in its place", shown);
  }
  return {};
}

std::string why_no_endpoint(std::string_view text) {
  if (text.starts_with('[') && text.find(']') != std::string_view::npos) {
    const std::string_view inside = text.substr(1, text.find(']') - 1);
    if (may_be_ipv6(inside)) return {};
  }
  if (may_be_ipv6(text)) return {};
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return why_no_address(text);
  const std::string_view port = text.substr(colon + 1);
  if (!is_number(port, 65'535)) {
    return fmt::format("{} has no port of 0 to 65535 after its colon", quote(text));
  }
  return why_no_address(text.substr(0, colon));
}

}  // namespace stormproof::model::config::vendor
