// The files of a tuning: the recommended setting and the front, as the vendor's XML.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "checker/experiments/tune/tune.hpp"

namespace stormproof::cli {

struct TuneOutput {
  std::string path;      ///< a folder, or one file that ends in ".xml"; empty: nothing is written
  std::string scenario;  ///< as it was named
  std::uint64_t seed = 0;
};

struct TuneFiles {
  std::map<std::string, std::string, std::less<>> files;  ///< name of a row → its file
  std::optional<model::config::InputError> error;
};

/// Nothing is written for a study that was interrupted, nor a single file if nothing is better.
[[nodiscard]] TuneFiles write_files(const TuneOutput& wanted, const tune::Subject& subject,
                                    const tune::Report& report);

/// Why nothing can be written to `output`, as far as that is known before there is something.
[[nodiscard]] std::optional<std::string> refuse_output(const std::string& output);

}  // namespace stormproof::cli
