// One sweep at a time on a database: two would run the same jobs twice. SQLite's own locks are held
// only while it writes; this one is held while the sweep runs, on a byte of the file that SQLite
// does not use. Readers of the database do not notice it, and it ends with the process.
#pragma once

#include <string>

namespace stormproof::sweep {

class FileLock {
 public:
  FileLock() = default;
  /// Makes the file if it does not exist.
  explicit FileLock(const std::string& path);
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;

  /// Somebody else holds the lock. A file that cannot be opened or locked is not refused: whoever
  /// uses it says why.
  [[nodiscard]] bool refused() const { return refused_; }

 private:
  int file_ = -1;
  bool refused_ = false;
};

}  // namespace stormproof::sweep
