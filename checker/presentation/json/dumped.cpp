// A name of a file may be any bytes; a report about it must not fail.
#include "checker/presentation/json/dumped.hpp"

#include <nlohmann/json.hpp>

namespace stormproof::report {

std::string dumped(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace stormproof::report
