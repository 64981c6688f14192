// The folder of the files that a command writes besides its answer: counterexamples, charts. Given
// by name, it gets all of them, what cannot be written is an error, and a second run at once is
// refused. Otherwise it is stormproof-out/<verb>-<subject>/, which git ignores: what the run before
// wrote there is removed, it takes at most 16 MB, two runs at once get two folders, and whatever
// keeps a file from it is only noted, because nobody asked for one.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace stormproof::cli {

class OutputFolder {
 public:
  /// `named`: what was given to `option`; empty: nothing. `subjects`: what the command is about:
  /// scenarios or profiles, as they were given.
  OutputFolder(std::string option, std::string named, std::string_view verb,
               const std::vector<std::string>& subjects);
  /// A folder in which nothing was written does not stay, if it is ours.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Before the work: removes what an earlier run left, and tries a named folder. The error of a
  /// named folder that cannot be written into.
  [[nodiscard]] std::optional<std::string> prepare();

  /// Writes a file that `fill` fills; it returns what is wrong, or nothing. The path of the file,
  /// or nothing if it is not there.
  std::optional<std::string> write(
      const std::string& name,
      const std::function<std::optional<std::string>(std::ostream&)>& fill);
  std::optional<std::string> write(const std::string& name, const std::string& text);

  /// What could not be written into a named folder, the first of it.
  [[nodiscard]] const std::optional<std::string>& error() const { return error_; }
  /// What stands in a folder that nobody named, and what is missing there: lines for the end of the
  /// answer.
  [[nodiscard]] std::vector<std::string> listing() const;

 private:
  [[nodiscard]] bool is_named() const { return !named_.empty(); }
  bool acquire(bool create);
  bool lock(const std::string& folder);
  bool lock_named();
  void clear();
  void fail(const std::string& why);

  std::string option_;
  std::string named_;
  std::string usual_;
  std::string path_;  ///< where files go; empty: not decided yet
  int marker_ = -1;   ///< lists what is ours; locked while the command runs
  int held_ = -1;     ///< a named folder, locked
  bool failed_ = false;
  std::uintmax_t bytes_ = 0;
  std::vector<std::string> made_;  ///< folders, the outermost first
  std::vector<std::string> names_;
  std::vector<std::string> notes_;
  std::optional<std::string> error_;
};

/// The help of the option: "WHAT (default: stormproof-out/NAME/)".
[[nodiscard]] std::string usual_folder_help(std::string_view what, std::string_view name);

}  // namespace stormproof::cli
