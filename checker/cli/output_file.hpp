// A file that a command writes beside its report. It grows under a temporary name of its own and
// takes its name only when it is complete, so a file that exists is never half-written, and two
// runs that write the same file at once leave one of theirs.
#pragma once

#include <fstream>
#include <optional>
#include <string>

namespace stormproof::cli {

class OutputFile {
 public:
  OutputFile() = default;
  /// Opens `path` for writing; an empty path means that no file is wanted.
  explicit OutputFile(const std::string& path) { open(path); }
  ~OutputFile() { discard(); }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Once, for a file that was made without a path. `label` stands for it in complaints: the option
  /// with the path; if empty, the path alone.
  void open(const std::string& path, const std::string& label = {});

  [[nodiscard]] bool wanted() const { return !path_.empty(); }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Why the file cannot be written, if it was wanted and could not be opened.
  [[nodiscard]] std::optional<std::string> open_error() const { return error_; }
  /// Gives the complete file its name; the reason if that fails. Only once: then nothing happens.
  [[nodiscard]] std::optional<std::string> commit();
  /// Nothing is to be written after all. What had the name before stays.
  void discard();

  /// For the end of the process without destructors: no file of ours stays half-written.
  static void discard_all();

 private:
  std::optional<std::string> open_temporary();
  [[nodiscard]] bool is_special() const { return temporary_ == target_; }

  std::string path_;       ///< as it was given
  std::string target_;     ///< what it stands for, without symbolic links
  std::string temporary_;  ///< a device or pipe: the same as `target_`
  std::string label_;
  std::ofstream stream_;
  std::optional<std::string> error_;
  bool done_ = true;
};

/// Makes the folder that was given to `option`, with those above it, and tries whether a file can
/// be made in it; the reason if not.
[[nodiscard]] std::optional<std::string> make_folder(const char* option, const std::string& folder);

}  // namespace stormproof::cli
