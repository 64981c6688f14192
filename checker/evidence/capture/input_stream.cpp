// Regular files are wound back; what cannot be is read through a stream that has the start.
#include "checker/evidence/capture/input_stream.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

namespace stormproof::capture {

namespace {

using model::config::InputError;
using model::config::Result;

/// A stream whose first bytes were read already.
struct Ahead {
  InputStream read;
  std::size_t given = 0;
};

ssize_t read_ahead(void* cookie, char* room, std::size_t size) {
  Ahead& ahead = *static_cast<Ahead*>(cookie);
  const Bytes rest = part(ahead.read.first_bytes(), ahead.given, size);
  if (!rest.empty()) {
    std::copy(rest.begin(), rest.end(), room);
    ahead.given += rest.size();
    return static_cast<ssize_t>(rest.size());
  }
  const std::size_t count = std::fread(room, 1, size, ahead.read.file.get());
  return count == 0 && std::ferror(ahead.read.file.get()) != 0 ? -1 : static_cast<ssize_t>(count);
}

int close_ahead(void* cookie) {
  delete static_cast<Ahead*>(cookie);
  return 0;
}

/// What is wrong with reading from it; empty if nothing is.
std::string refusal(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) return "is a directory; expected a file";
  const bool is_readable = std::filesystem::is_regular_file(status) ||
                           std::filesystem::is_fifo(status) || std::filesystem::is_socket(status);
  if (!std::filesystem::exists(status) || is_readable) return "";
  return "not a regular file or a pipe; expected a capture (pcap or pcapng)";
}

/// Opens what is no standard input. A pipe is not waited for: without somebody who writes into it,
/// who may never come, its first byte is the end.
std::string open_file(const std::string& path, InputStream& stream) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  stream.file.reset(descriptor < 0 ? nullptr : fdopen(descriptor, "rb"));
  if (!stream.file) return std::strerror(errno);
  if (std::filesystem::is_fifo(path)) {
    const ssize_t count = ::read(descriptor, stream.start.data(), 1);
    if (count == 0) return "a pipe into which nobody writes; expected a capture (pcap or pcapng)";
    stream.start_length = count > 0 ? 1 : 0;
  }
  return fcntl(descriptor, F_SETFL, O_RDONLY) == 0 ? "" : std::strerror(errno);
}

}  // namespace

Result<InputStream> open_stream(const std::string& path) {
  const bool is_standard = path == "-";
  if (is_standard && isatty(STDIN_FILENO) != 0) {
    return InputError{path,
                      "standard input is a terminal; expected a capture, as in "
                      "'tcpdump -w - | stormproof doctor -'"};
  }
  if (const std::string why = is_standard ? "" : refusal(path); !why.empty()) {
    return InputError{path, why};
  }
  InputStream stream;
  if (is_standard) {
    stream.file.reset(stdin);
  } else if (const std::string why = open_file(path, stream); !why.empty()) {
    return InputError{path, why};
  }
  stream.start_length += std::fread(stream.start.data() + stream.start_length, 1,
                                    stream.start.size() - stream.start_length, stream.file.get());
  if (std::fseek(stream.file.get(), 0, SEEK_SET) == 0) return stream;
  InputStream whole;
  whole.start = stream.start;
  whole.start_length = stream.start_length;
  const cookie_io_functions_t functions{read_ahead, nullptr, nullptr, close_ahead};
  auto ahead = std::make_unique<Ahead>(Ahead{std::move(stream)});
  whole.file.reset(fopencookie(ahead.get(), "rb", functions));
  if (!whole.file) return InputError{path, std::strerror(errno)};
  static_cast<void>(ahead.release());  // the stream deletes it
  return whole;
}

}  // namespace stormproof::capture
