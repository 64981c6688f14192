// A lock of the open file description: unlike one of the process, it stays when SQLite closes the
// same file. (SQLite's locks are those of the process: so this file is closed last.)
#include "checker/experiments/sweep/file_lock.hpp"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace stormproof::sweep {

FileLock::FileLock(const std::string& path)
    : file_{open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)} {
  if (file_ < 0) return;
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = off_t{1} << 60;  // SQLite locks bytes behind 2^30
  lock.l_len = 1;
  refused_ = fcntl(file_, F_OFD_SETLK, &lock) != 0 && (errno == EAGAIN || errno == EACCES);
}

FileLock::~FileLock() {
  if (file_ >= 0) close(file_);
}

FileLock::FileLock(FileLock&& other) noexcept
    : file_{std::exchange(other.file_, -1)}, refused_{other.refused_} {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(refused_, other.refused_);
  return *this;
}

}  // namespace stormproof::sweep
