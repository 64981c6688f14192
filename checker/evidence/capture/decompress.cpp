// liblzma and zlib behind one loop: give input, take output until the bound.
#include "checker/evidence/capture/decompress.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <lzma.h>
#include <zlib.h>

namespace stormproof::capture {

/// What became of a step of unpacking.
enum class Step : std::uint8_t { more, end, cut_off, corrupt, too_large };

class Decoder {
 public:
  Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  virtual ~Decoder() = default;
  /// Fills `room` as far as possible; `written` is how far.
  virtual Step step(std::span<std::uint8_t> room, std::size_t& written) = 0;
  [[nodiscard]] virtual std::string_view suffix() const = 0;
};

namespace {

constexpr std::array<std::uint8_t, 6> xz_magic{0xfd, '7', 'z', 'X', 'Z', 0};
constexpr std::array<std::uint8_t, 2> gzip_magic{0x1f, 0x8b};
/// For the dictionary of an xz stream; the largest preset needs 65 MiB.
constexpr std::uint64_t xz_memory_limit = 256ULL << 20U;

/// liblzma; concatenated streams are its own business.
class XzDecoder final : public Decoder {
 public:
  explicit XzDecoder(Packed packed) : packed_{std::move(packed)} {
    ok_ = lzma_stream_decoder(&stream_, xz_memory_limit, LZMA_CONCATENATED) == LZMA_OK;
  }
  ~XzDecoder() override { lzma_end(&stream_); }

  Step step(std::span<std::uint8_t> room, std::size_t& written) override {
    if (!ok_) return Step::corrupt;
    if (stream_.avail_in == 0 && !ended_) {
      const Bytes more = packed_();
      stream_.next_in = more.data();
      stream_.avail_in = more.size();
      ended_ = more.empty();
    }
    stream_.next_out = room.data();
    stream_.avail_out = room.size();
    const lzma_ret result = lzma_code(&stream_, ended_ ? LZMA_FINISH : LZMA_RUN);
    written = room.size() - stream_.avail_out;
    if (result == LZMA_OK) return Step::more;
    if (result == LZMA_STREAM_END) return Step::end;
    if (result == LZMA_MEMLIMIT_ERROR) return Step::too_large;
    return result == LZMA_BUF_ERROR ? Step::cut_off : Step::corrupt;
  }
  [[nodiscard]] std::string_view suffix() const override { return ".xz"; }

 private:
  Packed packed_;
  lzma_stream stream_ = LZMA_STREAM_INIT;
  bool ok_ = false;
  bool ended_ = false;
};

/// zlib; a member that ends may be followed by another one.
class GzipDecoder final : public Decoder {
 public:
  explicit GzipDecoder(Packed packed) : packed_{std::move(packed)} {
    constexpr int gzip_with_largest_window = 15 + 16;
    ok_ = inflateInit2(&stream_, gzip_with_largest_window) == Z_OK;
  }
  ~GzipDecoder() override { inflateEnd(&stream_); }

  Step step(std::span<std::uint8_t> room, std::size_t& written) override {
    if (!ok_) return Step::corrupt;
    have(1);
    const Bytes rest = part(chunk_, used_);
    const uInt given =
        static_cast<uInt>(std::min<std::size_t>(rest.size(), std::numeric_limits<uInt>::max()));
    stream_.next_in = const_cast<Bytef*>(rest.data());  // zlib does not write to it
    stream_.avail_in = given;
    stream_.next_out = room.data();
    stream_.avail_out = static_cast<uInt>(room.size());
    const int result = inflate(&stream_, Z_NO_FLUSH);
    written = room.size() - stream_.avail_out;
    used_ += given - stream_.avail_in;
    if (result == Z_STREAM_END) {
      have(gzip_magic.size());
      if (compression_of(part(chunk_, used_)) != Compression::gzip) return Step::end;
      return inflateReset(&stream_) == Z_OK ? Step::more : Step::corrupt;
    }
    if (result == Z_OK) return Step::more;
    return result == Z_BUF_ERROR ? Step::cut_off : Step::corrupt;
  }
  [[nodiscard]] std::string_view suffix() const override { return ".gz"; }

 private:
  /// Takes more until there are so many bytes, if there are.
  void have(std::size_t bytes) {
    while (chunk_.size() - used_ < bytes) {
      const Bytes more = packed_();
      if (more.empty()) return;
      chunk_.erase(chunk_.begin(), chunk_.begin() + static_cast<std::ptrdiff_t>(used_));
      used_ = 0;
      chunk_.insert(chunk_.end(), more.begin(), more.end());
    }
  }

  Packed packed_;
  std::vector<std::uint8_t> chunk_;
  std::size_t used_ = 0;
  z_stream stream_{};
  bool ok_ = false;
};

}  // namespace

Compression compression_of(Bytes start) {
  const auto starts_with = [start](const auto& magic) {
    return start.size() >= magic.size() && std::equal(magic.begin(), magic.end(), start.begin());
  };
  if (starts_with(xz_magic)) return Compression::xz;
  return starts_with(gzip_magic) ? Compression::gzip : Compression::none;
}

Unpacking::Unpacking(Packed packed, Compression kind, std::uint64_t limit) : limit_{limit} {
  if (kind == Compression::xz) {
    decoder_ = std::make_unique<XzDecoder>(std::move(packed));
  } else {
    decoder_ = std::make_unique<GzipDecoder>(std::move(packed));
  }
}

Unpacking::~Unpacking() = default;

std::size_t Unpacking::read(std::span<std::uint8_t> room) {
  std::size_t written = 0;
  while (!has_ended_ && written == 0) {
    const Step step = decoder_->step(room, written);
    unpacked_ += written;
    has_ended_ = step != Step::more;
    if (step == Step::cut_off) damage_ = fmt::format("the {} data is cut off", decoder_->suffix());
    if (step == Step::corrupt) damage_ = fmt::format("the {} data is corrupt", decoder_->suffix());
    if (step == Step::too_large) {
      damage_ = fmt::format("the {} data needs more than {} MiB of memory to unpack",
                            decoder_->suffix(), xz_memory_limit >> 20U);
    }
    if (unpacked_ <= limit_) continue;
    damage_ = fmt::format("unpacks to more than {} MiB; unpack and split it first", limit_ >> 20U);
    has_ended_ = true;
    is_too_long_ = true;
    return 0;
  }
  return written;
}

model::config::Result<Unpacked, std::string> unpack(Bytes packed, Compression kind,
                                                    std::size_t limit) {
  if (kind == Compression::none) {
    if (packed.size() > limit) return fmt::format("has more than {} MiB", limit >> 20U);
    return Unpacked{{packed.begin(), packed.end()}, {}};
  }
  constexpr std::size_t chunk = 1U << 18U;
  Unpacking unpacking{[rest = packed]() mutable { return std::exchange(rest, Bytes{}); }, kind,
                      limit};
  Unpacked unpacked;
  std::vector<std::uint8_t> room(chunk);
  while (const std::size_t read = unpacking.read(room)) {
    unpacked.bytes.insert(unpacked.bytes.end(), room.begin(),
                          room.begin() + static_cast<std::ptrdiff_t>(read));
  }
  if (unpacking.is_too_long()) return unpacking.damage();
  unpacked.damage = unpacking.damage();
  if (unpacked.bytes.empty()) {
    return unpacked.damage.empty() ? "unpacks to nothing" : unpacked.damage;
  }
  return unpacked;
}

}  // namespace stormproof::capture
