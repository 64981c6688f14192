// A TAP device: a network interface whose other end is this process. The interface may be moved
// into another network namespace; the process keeps its end, and when it closes it the interface
// is gone, so an access point that dies leaves nothing behind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "model/config/tree/result.hpp"

namespace stormproof::live {

class TapDevice {
 public:
  /// Creates the interface `name` (1 … 15 bytes, not in use) with this MTU, and with room for many
  /// frames between two reads. The error says what failed and what it needs.
  [[nodiscard]] static model::config::Result<TapDevice, std::string> create(const std::string& name,
                                                                            std::int64_t mtu_bytes);

  TapDevice(TapDevice&& other) noexcept;
  TapDevice& operator=(TapDevice&&) = delete;
  ~TapDevice();

  /// For poll; reading and writing never block.
  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  /// One frame that the kernel has sent, into `buffer`; its length, or nothing if there is none.
  [[nodiscard]] std::optional<std::size_t> read(std::span<std::byte> buffer) const;
  /// Hands a frame to the kernel, as received; false if it does not take it (the interface is
  /// down).
  [[nodiscard]] bool write(std::span<const std::byte> frame) const;

 private:
  TapDevice(int descriptor, std::string name) : descriptor_{descriptor}, name_{std::move(name)} {}

  int descriptor_;
  std::string name_;
};

}  // namespace stormproof::live
