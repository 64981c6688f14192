// Values of a Fast DDS file. The library reads them with tinyxml2 (`QueryIntText`,
// `QueryUnsignedText`, `QueryBoolText`), which takes the number that a text begins with and ignores
// the rest, and durations by XMLElementParser.cpp's getXMLDuration. Where that reading and the text
// differ, there is a remark.
#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "model/config/tree/quantities.hpp"
#include "model/config/tree/suggestion.hpp"
#include "model/config/vendor/addresses.hpp"
#include "model/config/vendor/fastdds_section.hpp"

namespace stormproof::model::config::vendor::fastdds {
namespace {

constexpr std::int64_t second = 1'000'000'000;

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// Words that '|' or blanks separate; one empty word if there is none.
std::vector<std::string> words_of(std::string_view text) {
  constexpr std::string_view separators = "| \t\r\n";
  std::vector<std::string> words;
  while (true) {
    const std::size_t first = std::min(text.find_first_not_of(separators), text.size());
    text.remove_prefix(first);
    if (text.empty()) break;
    const std::size_t end = std::min(text.find_first_of(separators), text.size());
    words.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  if (words.empty()) words.emplace_back();
  return words;
}

std::int64_t read_number(const XmlElement& element, std::int64_t minimum, std::int64_t maximum,
                         VendorProfile& profile) {
  if (element.text.empty()) {
    refuse(element.place, fmt::format("nothing in <{}>; expected a whole number", element.name));
  }
  const auto leading = leading_number(element.text);
  if (!leading) {
    refuse(element.text_place,
           fmt::format("{} in <{}>; expected a whole number", quote(element.text), element.name));
  }
  if (leading->number < minimum || leading->number > maximum) {
    refuse(element.text_place, fmt::format("{} in <{}>; expected {} to {}", quote(element.text),
                                           element.name, minimum, maximum));
  }
  if (!leading->rest.empty()) {
    add_remark(profile, Severity::warning, "fastdds.number-tail", element.text_place,
               fmt::format("{} in <{}> is read as {}: what follows the digits is ignored",
                           quote(element.text), element.name, leading->number),
               element.name == "sec" || element.name == "nanosec"
                   ? "write whole numbers without a unit; fractions of a second go into <nanosec>"
                   : "write a whole number without a unit");
  }
  return leading->number;
}

bool read_flag(const XmlElement& element) {
  if (const auto leading = leading_number(element.text)) return leading->number != 0;
  for (const std::string_view word : {"true", "True", "TRUE"}) {
    if (element.text == word) return true;
  }
  for (const std::string_view word : {"false", "False", "FALSE"}) {
    if (element.text == word) return false;
  }
  refuse(element.text.empty() ? element.place : element.text_place,
         fmt::format("{} in <{}>; expected true or false", quote(element.text), element.name));
}

/// One part of a duration in its unit, or nothing if it makes the duration infinite.
std::optional<std::int64_t> read_part(const XmlElement& part, VendorProfile& profile) {
  const bool is_seconds = part.name == "sec";
  if (part.text == "DURATION_INFINITY" ||
      part.text == (is_seconds ? "DURATION_INFINITE_SEC" : "DURATION_INFINITE_NSEC")) {
    return std::nullopt;
  }
  if (is_seconds) {
    return read_number(part, std::numeric_limits<std::int32_t>::min(),
                       std::numeric_limits<std::int32_t>::max(), profile);
  }
  const std::int64_t number =
      read_number(part, 0, std::numeric_limits<std::uint32_t>::max(), profile);
  if (number >= second) {
    add_remark(profile, Severity::warning, "fastdds.nanosec-range", part.text_place,
               fmt::format("{} ns are a second or more; the library adds them to <sec>", number),
               "nanoseconds are below 1000000000");
  }
  return number;
}

Value infinite_duration(const Place& place) {
  return {std::numeric_limits<std::int64_t>::max(), true, "infinite", place, {}};
}

Value read_duration(const XmlElement& element, VendorProfile& profile) {
  constexpr std::string_view expected = "expected <sec> and <nanosec> or DURATION_INFINITY";
  if (element.text == "DURATION_INFINITY") {
    if (!element.children.empty()) {
      refuse(element.children.front().place,
             fmt::format("<{}> beside DURATION_INFINITY", element.children.front().name));
    }
    return infinite_duration(element.place);
  }
  if (element.children.empty()) {
    refuse(element.text.empty() ? element.place : element.text_place,
           element.text.empty()
               ? fmt::format("nothing in <{}>; {}", element.name, expected)
               : fmt::format("{} in <{}>; {}", quote(element.text), element.name, expected));
  }
  std::int64_t seconds = 0;
  std::int64_t nanoseconds = 0;
  for (const XmlElement& part : element.children) {
    if (part.name != "sec" && part.name != "nanosec") {
      refuse(part.place, fmt::format("<{}> in <{}>; {}", part.name, element.name, expected));
    }
    const auto number = read_part(part, profile);
    if (!number) return infinite_duration(element.place);
    (part.name == "sec" ? seconds : nanoseconds) = *number;
  }
  const std::int64_t total = seconds * second + nanoseconds;
  std::string shown =
      total < 0 ? "-" + print_duration(Nanoseconds{-total}) : print_duration(Nanoseconds{total});
  return {total, false, std::move(shown), element.place, {}};
}

std::string read_choice(const XmlElement& element, std::string_view text,
                        std::string_view choices) {
  const std::vector<std::string> names = split(choices, '|');
  if (std::ranges::find(names, text) == names.end()) {
    refuse(element.text.empty() ? element.place : element.text_place,
           fmt::format("{} in <{}>; expected {}{}", quote(text), element.name,
                       fmt::join(names, ", "), suggestion(text, names)));
  }
  return std::string{text};
}

/// The children named `name`; `minimum` of them at least.
Value read_list(const XmlElement& element, std::string_view name, std::size_t minimum,
                VendorProfile& profile) {
  Value value{0, false, {}, element.place, {}};
  for (const XmlElement& child : element.children) {
    if (child.name != name) {
      add_remark(profile, Severity::warning, "fastdds.ignored-element", child.place,
                 fmt::format("<{}> in <{}> is ignored", child.name, element.name),
                 fmt::format("it has <{}> elements only", name));
    } else if (name == "locator") {
      value.items.push_back(read_locator(child, profile));
    } else if (!child.text.empty()) {
      value.items.push_back(child.text);
    } else if (name == "transport_id") {
      refuse(child.place, "nothing in <transport_id>; expected the id of a transport descriptor");
    }
  }
  if (value.items.empty() && name == "locator") {
    add_remark(profile, Severity::error, "fastdds.empty-list", element.place,
               fmt::format("no <locator> in <{}>; the library refuses the file", element.name),
               "leave the list out");
  } else if (value.items.size() < minimum) {
    refuse(element.place, fmt::format("no <{}> in <{}>; expected one at least, or leave it out",
                                      name, element.name));
  }
  value.number = static_cast<std::int64_t>(value.items.size());
  value.shown = fmt::format("{}", fmt::join(value.items, ", "));
  return value;
}

/// Addresses and names of interfaces. Other elements are for the section's reader to refuse.
Value read_addresses(const XmlElement& element) {
  Value value{0, false, {}, element.place, {}};
  for (const XmlElement& child : element.children) {
    if (!child.text.empty()) value.items.push_back(child.text);
  }
  value.number = static_cast<std::int64_t>(value.items.size());
  value.shown = fmt::format("{}", fmt::join(value.items, ", "));
  return value;
}

}  // namespace

std::optional<LeadingNumber> leading_number(std::string_view text) {
  text = trimmed(text);
  const bool is_negative = text.starts_with('-');
  if (is_negative || text.starts_with('+')) text.remove_prefix(1);
  const bool is_hexadecimal = text.starts_with("0x") || text.starts_with("0X");
  if (is_hexadecimal) text.remove_prefix(2);
  std::int64_t number = 0;
  const char* end = text.data() + text.size();
  if (text.starts_with('-')) return std::nullopt;  // from_chars would take it
  const auto [rest, failed] = std::from_chars(text.data(), end, number, is_hexadecimal ? 16 : 10);
  if (failed == std::errc::result_out_of_range) number = std::numeric_limits<std::int64_t>::max();
  if (failed == std::errc::invalid_argument) return std::nullopt;
  return LeadingNumber{is_negative ? -number : number,
                       trimmed({rest, static_cast<std::size_t>(end - rest)})};
}

std::string read_locator(const XmlElement& locator, VendorProfile& profile) {
  constexpr std::array<std::string_view, 4> kinds{"udpv4", "udpv6", "tcpv4", "tcpv6"};
  if (locator.children.size() != 1 ||
      std::ranges::find(kinds, locator.children.front().name) == kinds.end()) {
    refuse(locator.place, "<locator>; expected one of <udpv4>, <udpv6>, <tcpv4>, <tcpv6> in it");
  }
  const XmlElement& kind = locator.children.front();
  std::string address;
  std::string port;
  for (const XmlElement& part : kind.children) {
    if (part.name == "address") {
      address = part.text;
      const std::string why = why_no_address(address);
      if (!why.empty()) {
        add_remark(profile, Severity::error, "fastdds.address", part.place,
                   fmt::format("<address>: {}; the library refuses the file", why),
                   "write the address or the name of the host");
      }
    } else if (part.name == "port" || part.name == "physical_port") {
      const auto number = leading_number(part.text);
      if (!number || number->number < 0 || number->number > 65'535) {
        refuse(part.place, fmt::format("{} in <{}>; expected a port of 0 to 65535",
                                       quote(part.text), part.name));
      }
      port = fmt::format(":{}", number->number);
    } else if (part.name != "wan_address" && part.name != "unique_lan_id") {
      refuse(part.place,
             fmt::format("<{}> in <{}>; expected <address> and <port>", part.name, kind.name));
    }
  }
  return fmt::format("{} {}{}", kind.name, address, port);
}

Value read_value(const XmlElement& element, const SchemaItem& item, VendorProfile& profile) {
  Value value;
  value.place = element.text.empty() ? element.place : element.text_place;
  const auto number = [&](std::int64_t minimum, std::int64_t maximum) {
    value.number = read_number(element, minimum, maximum, profile);
    value.shown = std::to_string(value.number);
    return value;
  };
  switch (item.kind) {
    case ValueKind::uint32:
      return number(0, std::numeric_limits<std::uint32_t>::max());
    case ValueKind::int32:
      return number(std::numeric_limits<std::int32_t>::min(),
                    std::numeric_limits<std::int32_t>::max());
    case ValueKind::uint16:
      return number(0, 65'535);
    case ValueKind::uint8:
      return number(0, 255);
    case ValueKind::flag:
      value.number = read_flag(element) ? 1 : 0;
      value.shown = value.number == 1 ? "true" : "false";
      return value;
    case ValueKind::duration:
      return read_duration(element, profile);
    case ValueKind::choice:
      value.shown = read_choice(element, element.text, item.choices);
      return value;
    case ValueKind::choices:
      for (const std::string& part : words_of(element.text)) {
        value.items.push_back(read_choice(element, part, item.choices));
      }
      value.shown = fmt::format("{}", fmt::join(value.items, " | "));
      return value;
    case ValueKind::locators:
      return read_list(element, "locator", 1, profile);
    case ValueKind::addresses:
      return read_addresses(element);
    case ValueKind::transports:
      return read_list(element, "transport_id", 1, profile);
    case ValueKind::group:
    case ValueKind::properties:
    case ValueKind::text:
    case ValueKind::opaque:
      break;
  }
  value.shown = element.children.empty() ? element.text
                                         : fmt::format("({} elements)", element.children.size());
  if (item.kind == ValueKind::text && value.shown.empty()) {
    refuse(element.place, fmt::format("nothing in <{}>; expected text", element.name));
  }
  return value;
}

}  // namespace stormproof::model::config::vendor::fastdds
