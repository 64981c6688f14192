// A marker in the folder lists the files that are ours, and is locked by the run that writes them.
#include "checker/cli/output_folder.hpp"

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "checker/cli/output_file.hpp"

namespace stormproof::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* top_folder = "stormproof-out";
constexpr const char* marker_name = ".stormproof";
constexpr std::uintmax_t most_bytes = 16'000'000;

/// "check-wifi-5x20": one name of a folder, whatever the subjects are called.
std::string folder_name(std::string_view verb, const std::vector<std::string>& subjects) {
  std::string name{verb};
  for (const std::string& subject : subjects) {
    std::string stem = fs::path{subject}.filename().string();
    for (const char* ending : {".yaml", ".yml", ".xml"}) {
      if (stem.ends_with(ending)) stem.erase(stem.size() - std::strlen(ending));
    }
    name += "-" + stem;
  }
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
    if (!plain) c = '_';
  }
  return name.substr(0, 100);
}

/// Makes the folder and those above it, and says which did not exist.
std::optional<std::string> make_folders(const fs::path& folder, std::vector<std::string>& made) {
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return std::nullopt;
  if (!folder.has_filename()) return make_folders(folder.parent_path(), made);  // "tuned/"
  if (auto why = make_folders(folder.parent_path(), made)) return why;
  if (!fs::create_directory(folder, error)) {
    return error ? error.message() : std::string{"it is no folder"};
  }
  made.push_back(folder.string());
  return std::nullopt;
}

std::string in_folder(const std::string& folder, const std::string& name) {
  return (fs::path{folder} / name).string();
}

}  // namespace

OutputFolder::OutputFolder(std::string option, std::string named, std::string_view verb,
                           const std::vector<std::string>& subjects)
    : option_{std::move(option)},
      named_{std::move(named)},
      usual_{in_folder(top_folder, folder_name(verb, subjects))} {}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (names_.empty()) {
    if (marker_ >= 0) unlink(in_folder(path_, marker_name).c_str());
    if (!is_named() && !path_.empty()) fs::remove(path_, ignored);
    // Only empty ones go.
    for (; !made_.empty(); made_.pop_back()) fs::remove(made_.back(), ignored);
  }
  if (marker_ >= 0) close(marker_);
  if (held_ >= 0) close(held_);
}

void OutputFolder::fail(const std::string& why) {
  failed_ = true;
  if (is_named()) {
    error_ = why;
  } else {
    notes_.push_back(fmt::format("{}; {} names another folder", why, option_ + " DIR"));
  }
}

std::optional<std::string> OutputFolder::prepare() {
  if (is_named()) {
    acquire(true);
    return error_;
  }
  std::error_code ignored;
  if (fs::is_directory(usual_, ignored)) acquire(false);
  return std::nullopt;
}

/// Decides where the files go. `create`: the folder is made if it is not there.
bool OutputFolder::acquire(bool create) {
  if (failed_ || !path_.empty()) return !failed_;
  if (is_named()) {
    auto why = make_folders(fs::path{named_}, made_);
    if (!why) {
      const OutputFile trial{in_folder(named_, "stormproof")};
      if (trial.open_error()) why = std::strerror(errno);
    }
    if (why) fail(fmt::format("{} {}: cannot be written into: {}", option_, named_, *why));
    path_ = named_;
    if (!failed_ && !lock_named()) {
      fail(fmt::format("{} {}: another run writes into it", option_, named_));
    }
    return !failed_;
  }
  constexpr int most_at_once = 100;
  for (int k = 1; k <= most_at_once; ++k) {
    const std::string folder = k == 1 ? usual_ : fmt::format("{}-{}", usual_, k);
    std::error_code ignored;
    if (!create && !fs::is_directory(folder, ignored)) return false;
    if (const auto why = make_folders(fs::path{folder}, made_)) {
      fail(fmt::format("{}: cannot be made: {}", folder, *why));
      return false;
    }
    if (!lock(folder)) {
      if (failed_) return false;
      continue;
    }
    path_ = folder;
    const std::string ignored_by_git = in_folder(top_folder, ".gitignore");
    if (!fs::exists(ignored_by_git, ignored)) std::ofstream{ignored_by_git} << "*\n";
    clear();
    return true;
  }
  fail(fmt::format("{}: every such folder is in use", usual_));
  return false;
}

/// Makes the folder ours: it is new, or an earlier run's, and nobody works in it.
bool OutputFolder::lock(const std::string& folder) {
  const std::string marker = in_folder(folder, marker_name);
  std::error_code ignored;
  const bool foreign = !fs::exists(marker, ignored) && !fs::is_empty(folder, ignored);
  if (foreign) return false;
  const int file = open(marker.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) {
    fail(fmt::format("{}: cannot be written into: {}", folder, std::strerror(errno)));
    return false;
  }
  // Whoever held the lock may have removed the marker meanwhile.
  struct stat held {};
  struct stat there {};
  if (flock(file, LOCK_EX | LOCK_NB) == 0 && fstat(file, &held) == 0 &&
      stat(marker.c_str(), &there) == 0 && held.st_ino == there.st_ino) {
    marker_ = file;
    return true;
  }
  close(file);
  return false;
}

/// A named folder is locked itself: nothing is written into it that nobody asked for. False if
/// another run holds it.
bool OutputFolder::lock_named() {
  held_ = open(named_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  return held_ < 0 || flock(held_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

/// Removes what the marker lists, and nothing else.
void OutputFolder::clear() {
  std::ifstream list{in_folder(path_, marker_name)};
  std::error_code ignored;
  for (std::string name; std::getline(list, name);) {
    const bool plain = !name.empty() && name.find('/') == std::string::npos && name != "..";
    const std::string file = in_folder(path_, name);
    if (plain && fs::is_regular_file(fs::symlink_status(file, ignored))) fs::remove(file, ignored);
  }
  (void)!ftruncate(marker_, 0);
}

std::optional<std::string> OutputFolder::write(
    const std::string& name, const std::function<std::optional<std::string>(std::ostream&)>& fill) {
  if (!acquire(true)) return std::nullopt;
  const std::string path = in_folder(path_, name);
  OutputFile file;
  file.open(path, is_named() ? option_ + ": " + path : path);
  auto why = file.open_error();
  if (!why) why = fill(file.stream());
  const auto size = why ? 0 : static_cast<std::uintmax_t>(file.stream().tellp());
  if (!why && !is_named() && file.stream().good() && bytes_ + size > most_bytes) {
    notes_.push_back(fmt::format(
        "{} is left out: {:.0f} MB, of {:.0f} MB that the folder takes; "
        "{} DIR takes everything",
        name, static_cast<double>(size) / 1e6, static_cast<double>(most_bytes) / 1e6, option_));
    return std::nullopt;
  }
  const std::string line = name + "\n";
  if (!why && marker_ >= 0) (void)!::write(marker_, line.data(), line.size());
  if (!why) why = file.commit();
  if (why) {
    fail(*why);
    return std::nullopt;
  }
  bytes_ += size;
  names_.push_back(name);
  return path;
}

std::optional<std::string> OutputFolder::write(const std::string& name, const std::string& text) {
  return write(name, [&](std::ostream& out) -> std::optional<std::string> {
    out << text;
    return std::nullopt;
  });
}

std::string usual_folder_help(std::string_view what, std::string_view name) {
  return fmt::format("{} (default: {}/{}/)", what, top_folder, name);
}

std::vector<std::string> OutputFolder::listing() const {
  std::vector<std::string> lines;
  if (is_named()) return lines;
  if (!names_.empty()) lines.push_back(fmt::format("{}/: {}", path_, fmt::join(names_, ", ")));
  lines.insert(lines.end(), notes_.begin(), notes_.end());
  return lines;
}

}  // namespace stormproof::cli
