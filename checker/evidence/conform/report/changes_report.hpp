// What `conform --changes` says: which capture notices which change of a knob of its profile.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/evidence/conform/changes.hpp"
#include "checker/presentation/document/document.hpp"

namespace stormproof::conform {

struct ChangesReport {
  std::vector<Sensitivity> captures{};
  Bounds bounds{};
  bool interrupted = false;
};

/// Over all captures: `violated` if one does not conform to its own profile, `established` if every
/// change is rejected by some.
[[nodiscard]] bool all_conform(const ChangesReport& report);
/// The changes that act in some capture, or in none, and are rejected by none.
[[nodiscard]] std::vector<std::string> unnoticed(const ChangesReport& report);

/// Without command and exit code, which only the caller knows.
[[nodiscard]] report::Document document_of(const ChangesReport& report);
/// specs/guide/conforming.md has the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const ChangesReport& report);

}  // namespace stormproof::conform
