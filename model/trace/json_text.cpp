// Lists of descriptors, and the strings that a user chose.
#include "model/trace/json_text.hpp"

#include <nlohmann/json.hpp>

namespace stormproof::model::trace {

void append_members(std::string& out, const DescriptorSet& set) {
  out += '[';
  bool first = true;
  set.for_each([&](std::uint32_t d) {
    append(out, first ? "" : ",", d);
    first = false;
  });
  out += ']';
}

void append_members(std::string& out, Words words) { append_members(out, DescriptorSet{words}); }

std::string json_string(std::string_view text) {
  using nlohmann::json;
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace stormproof::model::trace
