// libpcap on a file or on memory.
#include "checker/evidence/capture/capture_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fmt/core.h>
#include <pcap.h>

#include "checker/evidence/capture/input_stream.hpp"
#include "checker/evidence/capture/link_layer.hpp"

namespace stormproof::capture {

namespace {

using model::config::InputError;
using model::config::Result;

/// A compressed file that is read through its decoder.
struct PackedFile {
  InputStream input{};
  std::vector<std::uint8_t> room = std::vector<std::uint8_t>(1U << 16U);
  std::shared_ptr<Unpacking> unpacking{};
};

ssize_t read_unpacked(void* cookie, char* room, std::size_t size) {
  PackedFile& file = *static_cast<PackedFile*>(cookie);
  return static_cast<ssize_t>(file.unpacking->read({reinterpret_cast<std::uint8_t*>(room), size}));
}

int close_packed(void* cookie) {
  delete static_cast<PackedFile*>(cookie);
  return 0;
}

}  // namespace

void CaptureFile::Closer::operator()(pcap* handle) const { pcap_close(handle); }

Result<CaptureFile> CaptureFile::over(CaptureFile file, std::FILE* stream) {
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  file.handle_.reset(
      pcap_fopen_offline_with_tstamp_precision(stream, PCAP_TSTAMP_PRECISION_NANO, error.data()));
  if (!file.handle_) {
    std::fclose(stream);
    if (file.unpacking_ && !file.unpacking_->damage().empty()) {
      return InputError{file.name_, file.unpacking_->damage()};
    }
    return InputError{file.name_, fmt::format("not a capture: {}; expected pcap or pcapng, plain "
                                              "or compressed as .xz or .gz",
                                              error.data())};
  }
  file.link_type_ = pcap_datalink(file.handle_.get());
  if (!is_supported_link(file.link_type_)) {
    const char* name = pcap_datalink_val_to_name(file.link_type_);
    return InputError{file.name_, fmt::format("link type {} ({}); expected {}", file.link_type_,
                                              name == nullptr ? "unknown" : name, supported_links)};
  }
  return file;
}

Result<CaptureFile> CaptureFile::from_memory(std::string name, Bytes content, std::size_t limit) {
  CaptureFile file;
  file.name_ = std::move(name);
  auto unpacked = unpack(content, compression_of(content), limit);
  if (!unpacked) return InputError{file.name_, unpacked.error()};
  file.content_ = std::move(unpacked->bytes);
  file.unpack_damage_ = std::move(unpacked->damage);
  if (file.content_.empty()) return InputError{file.name_, "the file is empty"};
  std::FILE* stream = fmemopen(file.content_.data(), file.content_.size(), "rb");
  if (stream == nullptr) return InputError{file.name_, std::strerror(errno)};
  return over(std::move(file), stream);
}

Result<CaptureFile> CaptureFile::open(const std::string& path) {
  auto stream = open_stream(path);
  if (!stream) return stream.error();
  if (compression_of(stream->first_bytes()) == Compression::none) {
    CaptureFile plain;
    plain.name_ = path;
    return over(std::move(plain), stream->file.release());
  }
  const Compression kind = compression_of(stream->first_bytes());
  auto packed = std::make_unique<PackedFile>();
  packed->input = *std::move(stream);
  packed->unpacking = std::make_shared<Unpacking>(
      [packed = packed.get()]() -> Bytes {
        std::vector<std::uint8_t>& room = packed->room;
        return {room.data(), std::fread(room.data(), 1, room.size(), packed->input.file.get())};
      },
      kind, unpack_limit);
  CaptureFile file;
  file.name_ = path;
  file.unpacking_ = packed->unpacking;
  const cookie_io_functions_t functions{read_unpacked, nullptr, nullptr, close_packed};
  std::FILE* unpacked = fopencookie(packed.get(), "rb", functions);
  if (unpacked == nullptr) return InputError{path, std::strerror(errno)};
  static_cast<void>(packed.release());  // the stream deletes it
  return over(std::move(file), unpacked);
}

std::optional<Packet> CaptureFile::next() {
  constexpr std::int64_t last_second = 9'000'000'000;  // the year 2255; below 2^63 ns
  pcap_pkthdr* header = nullptr;
  const u_char* bytes = nullptr;
  if (!damage_.empty()) return std::nullopt;
  const int status = pcap_next_ex(handle_.get(), &header, &bytes);
  if (status != 1) {
    damage_ = status == PCAP_ERROR_BREAK ? "" : pcap_geterr(handle_.get());
    if (!unpack_damage_.empty()) damage_ = unpack_damage_;
    if (unpacking_ && !unpacking_->damage().empty()) damage_ = unpacking_->damage();
    return std::nullopt;
  }
  ++packets_;
  if (header->ts.tv_sec < 0 || header->ts.tv_sec > last_second) {
    damage_ = fmt::format("packet {} has an impossible time", packets_);
    return std::nullopt;
  }
  Packet packet;
  packet.number = packets_;
  packet.time_ns = header->ts.tv_sec * 1'000'000'000 + header->ts.tv_usec;  // here nanoseconds
  packet.original_length = header->len;
  packet.bytes = {bytes, header->caplen};
  return packet;
}

}  // namespace stormproof::capture
