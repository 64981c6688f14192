// Reads variables.yaml.
#include "checker/evidence/init/variables.hpp"

#include <algorithm>

#include "model/config/table_file.hpp"

namespace stormproof::init {
namespace {

using model::config::Member;
using model::config::Result;

constexpr const char* table = "variables";

Result<std::vector<Variable>> read_file(const std::string& file) {
  const auto root = model::config::load_tables(file, {table});
  if (!root) return root.error();
  const auto entries = model::config::entries_of(*root, table, "variables");
  if (!entries) return entries.error();
  std::vector<Variable> all;
  for (const Member& member : *entries) {
    model::config::EntryReader reader{
        member.value, table, member.key, {"rmw", "read_by", "source", "refuses", "remark"}};
    Variable one{member.key,
                 reader.text("rmw"),
                 reader.texts("read_by", "distributions"),
                 reader.text("source"),
                 reader.pairs("refuses", "values to reasons"),
                 reader.optional_text("remark")};
    if (reader.error()) return *reader.error();
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

bool Variable::is_read_by(const std::string& distribution) const {
  return std::ranges::find(read_by, distribution) != read_by.end();
}

std::string Variable::why_not(const std::string& value) const {
  for (std::size_t at = 0; at <= value.size();) {
    const std::size_t end = std::min(value.find(';', at), value.size());
    const std::string_view one =
        model::config::trimmed(std::string_view{value}.substr(at, end - at));
    for (const auto& [beginning, why] : refuses) {
      if (one.starts_with(beginning)) return why;
    }
    at = end + 1;
  }
  return {};
}

model::config::Result<std::vector<Variable>> read_variables(
    const std::vector<std::string>& directories) {
  const auto file = model::config::file_in(directories, "variables.yaml");
  return file ? read_file(*file) : std::vector<Variable>{};
}

}  // namespace stormproof::init
