// Reads `--name value` pairs: the standard library is enough for a program that a script starts.
#include "options.hpp"

#include <charconv>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace stormproof::live {

namespace {

using Values = std::map<std::string, std::string, std::less<>>;

std::uint32_t number(const std::string& name, const std::string& text) {
  std::uint32_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) {
    throw std::invalid_argument(name + " '" + text + "': expected a whole number");
  }
  return value;
}

Values values_of(int argc, const char* const* argv) {
  static const std::set<std::string_view> known = {
      "--host",           "--index",     "--np",          "--ne",           "--address",
      "--hosts",          "--start",     "--send-buffer", "--simultaneous", "--report",
      "--create-over-us", "--discovery", "--server",      "--serves",       "--multicast",
      "--addresses"};
  Values values;
  for (int at = 1; at < argc; at += 2) {
    const std::string name = argv[at];
    if (!known.contains(name)) {
      throw std::invalid_argument("unknown option '" + name + "'");
    }
    if (at + 1 == argc) {
      throw std::invalid_argument(name + ": expected a value behind it");
    }
    values[name] = argv[at + 1];
  }
  return values;
}

const std::string& required(const Values& values, const std::string& name) {
  const auto found = values.find(name);
  if (found == values.end()) {
    throw std::invalid_argument(name + " is missing");
  }
  return found->second;
}

std::uint32_t optional_number(const Values& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? 0 : number(name, found->second);
}

Discovery discovery_of(const Values& values) {
  static const std::map<std::string_view, Discovery> words = {
      {"simple", Discovery::simple},
      {"server", Discovery::server},
      {"super_client", Discovery::super_client},
      {"static", Discovery::static_peers}};
  const auto given = values.find("--discovery");
  if (given == values.end()) {
    return Discovery::simple;
  }
  const auto found = words.find(given->second);
  if (found == words.end()) {
    throw std::invalid_argument("--discovery '" + given->second +
                                "': expected simple, server, super_client or static");
  }
  return found->second;
}

}  // namespace

Options parse_options(int argc, const char* const* argv) {
  const Values values = values_of(argc, argv);
  const auto required_number = [&values](const std::string& name) {
    return number(name, required(values, name));
  };
  Options options;
  options.host = required_number("--host");
  options.index = required_number("--index");
  options.participants_per_host = required_number("--np");
  options.user_endpoints = required_number("--ne");
  options.address = required(values, "--address");
  options.hosts = required_number("--hosts");
  options.send_buffer = optional_number(values, "--send-buffer");
  options.simultaneous = optional_number(values, "--simultaneous") != 0;
  options.create_over_ns = std::int64_t{1000} * optional_number(values, "--create-over-us");
  options.discovery = discovery_of(values);
  options.multicast = optional_number(values, "--multicast") != 0;
  options.serves = optional_number(values, "--serves") != 0;
  if (options.discovery == Discovery::server || options.discovery == Discovery::super_client) {
    options.server = required(values, "--server");
  }
  if (options.discovery == Discovery::static_peers) {
    std::istringstream words{required(values, "--addresses")};
    for (std::string word; std::getline(words, word, ',');) options.addresses.push_back(word);
  }
  options.start_file = required(values, "--start");
  options.report = required(values, "--report");
  if (options.participants_per_host == 0) {
    throw std::invalid_argument("--np 0: expected at least 1");
  }
  if (options.hosts < 2) {
    throw std::invalid_argument("--hosts: expected at least 2");
  }
  return options;
}

}  // namespace stormproof::live
