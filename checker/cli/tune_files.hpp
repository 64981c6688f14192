// The files of a tuning: the recommended setting and the front, as the vendor's XML, and the launch
// plan that is recommended with it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "checker/cli/output_file.hpp"
#include "checker/cli/output_folder.hpp"
#include "checker/experiments/tune/tune.hpp"

namespace stormproof::cli {

/// Where the files go: a folder, or one file that ends in ".xml"; with an empty path nowhere.
class TuneOutput {
 public:
  explicit TuneOutput(const std::string& path);

  /// Before the work: why nothing can be written there.
  [[nodiscard]] std::optional<std::string> prepare();
  [[nodiscard]] bool wanted() const { return file_.wanted() || folder_; }
  [[nodiscard]] bool is_one_file() const { return file_.wanted(); }
  /// The path of the file, if it was written. `name` matters in a folder only.
  std::optional<std::string> write(const std::string& name, const std::string& xml);
  /// What could not be written, the first of it.
  [[nodiscard]] std::optional<std::string> error() const;

 private:
  OutputFile file_;
  std::optional<OutputFolder> folder_;
  std::optional<std::string> error_;
};

struct TuneFiles {
  std::map<std::string, std::string, std::less<>> files;  ///< name of a row → its file
  std::vector<std::string> launch;  ///< files that start processes by the recommended plan
  std::optional<std::string> error;
};

/// `origin`: how the settings were found, for the comment on top of each file. Nothing is written
/// for a study that was interrupted, nor a single file if nothing is better, nor a launch plan
/// beside a single file. `named`: the scenario as it was given.
[[nodiscard]] TuneFiles write_files(TuneOutput& output, const std::string& origin,
                                    const std::string& named, const tune::Subject& subject,
                                    const tune::Report& report);

}  // namespace stormproof::cli
