// Reports that are no document yet, in the formats that are wanted.
#pragma once

#include <map>
#include <string>

#include "checker/cli/session.hpp"

namespace stormproof::cli {

template <class Render>
std::map<report::Format, std::string> rendered(const Session& session, const Render& render) {
  std::map<report::Format, std::string> texts;
  for (const report::Format format : session.wanted()) {
    if (format != report::Format::json) texts[format] = render(format);
  }
  return texts;
}

}  // namespace stormproof::cli
