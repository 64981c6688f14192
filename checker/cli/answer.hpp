// What a command hands to the frame when it is done: an answer to be shown, or why there is none.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "checker/cli/exit_code.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/document/format.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::cli {

/// The frame completes both forms: the document, which knows the exit code, gets the command unless
/// it has one; the JSON starts with `schema`, `command`, `exit_code` and `interrupted`.
struct Answer {
  report::Document document;
  nlohmann::ordered_json json;
  std::string csv = {};                 ///< of verbs that offer `--format csv`
  std::vector<std::string> notes = {};  ///< lines on standard error, after the answer
  std::vector<std::pair<std::string, report::Format>> files = {};  ///< written by the frame: paths
  std::vector<std::string> listing = {};  ///< of files that nobody asked for: ends the answer
  std::string complaint = {};  ///< what failed after the work; the exit code is bad_input
};

/// Bad input: what is wrong, with its place and what was expected. One line on standard error.
struct Complaint {
  std::string message;

  explicit Complaint(std::string text) : message{std::move(text)} {}
  Complaint(const model::config::InputError& error)  // NOLINT(google-explicit-constructor)
      : message{to_string(error)} {}
};

/// With an exit code alone, the command has said what there is to say.
using Outcome = std::variant<Answer, Complaint, ExitCode>;

}  // namespace stormproof::cli
