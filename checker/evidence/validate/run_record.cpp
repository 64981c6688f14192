// Reads JSON, and refuses with file and key what is no record.
#include "checker/evidence/validate/run_record.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "model/config/tree/file_text.hpp"

namespace stormproof::validate {

namespace {

using Json = nlohmann::json;
using model::config::InputError;
namespace fs = std::filesystem;

constexpr std::size_t most_bytes = 1U << 24U;

std::vector<std::string> files_of(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return {path};
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator{path, ignored}) {
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  }
  std::ranges::sort(files);
  return files;
}

/// What is wrong with the participant, or nothing.
std::optional<std::string> read(const Json& json, Reported& one) {
  if (!json.is_object()) return "not an object; expected one participant, or a list of them";
  constexpr std::int64_t most_hosts = 1'000'000;
  constexpr std::int64_t latest_ns = std::int64_t{1} << 62U;
  const auto number = [&](const char* key, std::int64_t most) -> std::optional<std::int64_t> {
    const auto found = json.find(key);
    const bool is_number = found != json.end() && found->is_number_unsigned() &&
                           found->get<std::uint64_t>() <= static_cast<std::uint64_t>(most);
    if (!is_number) return std::nullopt;
    return found->get<std::int64_t>();
  };
  const auto host = number("host", most_hosts);
  if (!host) return "host: expected the number of a host; 0 is that of the server";
  const auto created = number("created_ns", latest_ns);
  if (!created) return "created_ns: expected ns since 1970, when the participant started";
  const auto done = number("endpoints_done_ns", latest_ns);
  if (!done || *done < *created) {
    return "endpoints_done_ns: expected ns since 1970, not before created_ns";
  }
  one.host = static_cast<std::size_t>(*host);
  one.created_ns = *created;
  one.endpoints_done_ns = *done;
  const auto prefix = json.find("guid_prefix");
  if (prefix == json.end()) return std::nullopt;
  if (!prefix->is_string()) return "guid_prefix: expected a text as capture summarize has it";
  one.guid_prefix = prefix->get<std::string>();
  return std::nullopt;
}

}  // namespace

model::config::Result<RunRecord> read_run_record(const std::string& path) {
  RunRecord record{path, {}};
  for (const std::string& file : files_of(path)) {
    const auto text = model::config::file_text(file, most_bytes);
    if (!text) return text.error();
    const Json json = Json::parse(*text, nullptr, false);
    if (json.is_discarded() || text->size() > most_bytes) {
      return InputError{file, "not JSON; expected one participant of a run, or a list of them"};
    }
    const bool is_run = json.is_object() && json.contains("participants");
    const Json list = json.is_array() ? json : is_run ? json["participants"] : Json::array({json});
    for (std::size_t k = 0; k < list.size(); ++k) {
      Reported one;
      if (const auto error = read(list[k], one)) {
        return InputError{list.size() > 1 ? fmt::format("{}, entry {}", file, k) : file, *error};
      }
      record.participants.push_back(std::move(one));
    }
  }
  if (record.participants.empty()) {
    return InputError{path, "no participant in it; expected JSON files, one of each"};
  }
  return record;
}

}  // namespace stormproof::validate
