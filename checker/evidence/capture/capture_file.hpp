// A capture as a sequence of packets with times in nanoseconds: libpcap reads pcap and pcapng,
// compressed ones as they are unpacked.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/capture/bytes.hpp"
#include "checker/evidence/capture/decompress.hpp"
#include "model/config/tree/result.hpp"

struct pcap;

namespace stormproof::capture {

/// How much a compressed capture may unpack to, in bytes.
inline constexpr std::uint64_t unpack_limit = 1ULL << 36U;

struct Packet {
  std::uint64_t number = 0;           ///< from 1 on, as Wireshark shows it
  std::int64_t time_ns = 0;           ///< since 1970
  std::uint32_t original_length = 0;  ///< on the wire, in bytes, with the link header
  Bytes bytes{};                      ///< what was captured of it; valid until the next packet
};

class CaptureFile {
 public:
  /// An InputError says what is wrong with the file or with its link type.
  [[nodiscard]] static model::config::Result<CaptureFile> open(const std::string& path);
  /// `content` is what the file would hold; `limit` bounds what it may unpack to.
  [[nodiscard]] static model::config::Result<CaptureFile> from_memory(std::string name,
                                                                      Bytes content,
                                                                      std::size_t limit);

  /// Nothing at the end, and where the file is damaged.
  [[nodiscard]] std::optional<Packet> next();

  /// What is wrong at the place where the packets ended; empty if the file just ends.
  [[nodiscard]] const std::string& damage() const { return damage_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// The libpcap number of the link type, DLT_….
  [[nodiscard]] int link_type() const { return link_type_; }

 private:
  struct Closer {
    void operator()(pcap* handle) const;
  };

  CaptureFile() = default;
  [[nodiscard]] static model::config::Result<CaptureFile> over(CaptureFile file, std::FILE* stream);

  std::string name_;
  std::vector<std::uint8_t> content_;  ///< of a file read from memory
  std::unique_ptr<pcap, Closer> handle_;
  std::shared_ptr<Unpacking> unpacking_;  ///< of a compressed file
  std::string unpack_damage_;
  std::string damage_;
  int link_type_ = 0;
  std::uint64_t packets_ = 0;
};

}  // namespace stormproof::capture
