// A file that a command writes beside its report. It grows under a temporary name and takes its own
// name only when it is complete, so a file that exists is never half-written.
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

  /// Once, for a file that was made without a path.
  void open(const std::string& path);

  [[nodiscard]] bool wanted() const { return !path_.empty(); }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Why the file cannot be written, if it was wanted and could not be opened.
  [[nodiscard]] std::optional<std::string> open_error() const;
  /// Gives the complete file its name; the reason if that fails. Only once: then nothing happens.
  [[nodiscard]] std::optional<std::string> commit();
  /// Nothing is to be written after all. What had the name before stays.
  void discard();

 private:
  std::string path_;
  std::string temporary_;
  std::ofstream stream_;
  bool done_ = true;
};

/// Makes the folder that was given to `option`, with those above it; the reason if that fails.
[[nodiscard]] std::optional<std::string> make_folder(const char* option, const std::string& folder);

}  // namespace stormproof::cli
