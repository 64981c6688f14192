// A file that a command writes beside its report. It grows under a temporary name and takes its own
// name only when it is complete, so a file that exists is never half-written.
#pragma once

#include <fstream>
#include <optional>
#include <string>

namespace stormproof::cli {

class OutputFile {
 public:
  /// Opens `path` for writing; an empty path means that no file is wanted.
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] bool wanted() const { return !path_.empty(); }
  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Why the file cannot be written, if it was wanted and could not be opened.
  [[nodiscard]] std::optional<std::string> open_error() const;
  /// Gives the complete file its name; the reason if that fails.
  [[nodiscard]] std::optional<std::string> commit();

 private:
  std::string path_;
  std::string temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

}  // namespace stormproof::cli
