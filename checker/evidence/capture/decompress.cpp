// liblzma and zlib behind one loop: give input, take output until the bound.
#include "checker/evidence/capture/decompress.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include <fmt/core.h>
#include <lzma.h>
#include <zlib.h>

namespace stormproof::capture {

namespace {

constexpr std::array<std::uint8_t, 6> xz_magic{0xfd, '7', 'z', 'X', 'Z', 0};
constexpr std::array<std::uint8_t, 2> gzip_magic{0x1f, 0x8b};
/// For the dictionary of an xz stream; the largest preset needs 65 MiB.
constexpr std::uint64_t xz_memory_limit = 256ULL << 20U;

enum class Step : std::uint8_t { more, end, cut_off, corrupt, too_large };

/// liblzma; concatenated streams are its own business.
class XzDecoder {
 public:
  explicit XzDecoder(Bytes packed) {
    ok_ = lzma_stream_decoder(&stream_, xz_memory_limit, LZMA_CONCATENATED) == LZMA_OK;
    stream_.next_in = packed.data();
    stream_.avail_in = packed.size();
  }
  ~XzDecoder() { lzma_end(&stream_); }
  XzDecoder(const XzDecoder&) = delete;
  XzDecoder& operator=(const XzDecoder&) = delete;

  /// Fills `room` as far as possible; `written` is how far.
  Step step(std::span<std::uint8_t> room, std::size_t& written) {
    if (!ok_) return Step::corrupt;
    stream_.next_out = room.data();
    stream_.avail_out = room.size();
    const lzma_ret result = lzma_code(&stream_, LZMA_FINISH);
    written = room.size() - stream_.avail_out;
    if (result == LZMA_OK) return Step::more;
    if (result == LZMA_STREAM_END) return Step::end;
    if (result == LZMA_MEMLIMIT_ERROR) return Step::too_large;
    return result == LZMA_BUF_ERROR ? Step::cut_off : Step::corrupt;
  }

 private:
  lzma_stream stream_ = LZMA_STREAM_INIT;
  bool ok_ = false;
};

/// zlib; a member that ends may be followed by another one.
class GzipDecoder {
 public:
  explicit GzipDecoder(Bytes packed) : rest_{packed} {
    constexpr int gzip_with_largest_window = 15 + 16;
    ok_ = inflateInit2(&stream_, gzip_with_largest_window) == Z_OK;
  }
  ~GzipDecoder() { inflateEnd(&stream_); }
  GzipDecoder(const GzipDecoder&) = delete;
  GzipDecoder& operator=(const GzipDecoder&) = delete;

  Step step(std::span<std::uint8_t> room, std::size_t& written) {
    if (!ok_) return Step::corrupt;
    constexpr std::size_t most = std::numeric_limits<uInt>::max();
    const uInt given = static_cast<uInt>(std::min(rest_.size(), most));
    stream_.next_in = const_cast<Bytef*>(rest_.data());  // zlib does not write to it
    stream_.avail_in = given;
    stream_.next_out = room.data();
    stream_.avail_out = static_cast<uInt>(room.size());
    const int result = inflate(&stream_, Z_NO_FLUSH);
    written = room.size() - stream_.avail_out;
    rest_ = part(rest_, given - stream_.avail_in);
    if (result == Z_STREAM_END) {
      if (compression_of(rest_) != Compression::gzip) return Step::end;
      return inflateReset(&stream_) == Z_OK ? Step::more : Step::corrupt;
    }
    if (result == Z_OK) return Step::more;
    return result == Z_BUF_ERROR ? Step::cut_off : Step::corrupt;
  }

 private:
  Bytes rest_;
  z_stream stream_{};
  bool ok_ = false;
};

template <class Decoder>
model::config::Result<Unpacked, std::string> run(Decoder& decoder, std::string_view suffix,
                                                 std::size_t limit) {
  constexpr std::size_t chunk = 1U << 18U;
  Unpacked unpacked;
  std::vector<std::uint8_t> room(chunk);
  for (Step step = Step::more; step == Step::more;) {
    std::size_t written = 0;
    step = decoder.step(room, written);
    if (unpacked.bytes.size() + written > limit) {
      return fmt::format("unpacks to more than {} MiB; unpack and split it first", limit >> 20U);
    }
    unpacked.bytes.insert(unpacked.bytes.end(), room.begin(),
                          room.begin() + static_cast<std::ptrdiff_t>(written));
    if (step == Step::cut_off) unpacked.damage = fmt::format("the {} data is cut off", suffix);
    if (step == Step::corrupt) unpacked.damage = fmt::format("the {} data is corrupt", suffix);
    if (step == Step::too_large) {
      unpacked.damage = fmt::format("the {} data needs more than {} MiB of memory to unpack",
                                    suffix, xz_memory_limit >> 20U);
    }
  }
  if (unpacked.bytes.empty()) {
    return unpacked.damage.empty() ? "unpacks to nothing" : unpacked.damage;
  }
  return unpacked;
}

}  // namespace

Compression compression_of(Bytes start) {
  const auto starts_with = [start](const auto& magic) {
    return start.size() >= magic.size() && std::equal(magic.begin(), magic.end(), start.begin());
  };
  if (starts_with(xz_magic)) return Compression::xz;
  return starts_with(gzip_magic) ? Compression::gzip : Compression::none;
}

model::config::Result<Unpacked, std::string> unpack(Bytes packed, Compression kind,
                                                    std::size_t limit) {
  if (kind == Compression::xz) {
    XzDecoder decoder{packed};
    return run(decoder, ".xz", limit);
  }
  if (kind == Compression::gzip) {
    GzipDecoder decoder{packed};
    return run(decoder, ".gz", limit);
  }
  if (packed.size() > limit) return fmt::format("has more than {} MiB", limit >> 20U);
  return Unpacked{{packed.begin(), packed.end()}, {}};
}

}  // namespace stormproof::capture
