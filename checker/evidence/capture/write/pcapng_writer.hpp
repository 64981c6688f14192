// Packets of a capture with comments, as pcapng (draft-ietf-opsawg-pcapng): times in nanoseconds,
// each packet as it was captured.
#pragma once

#include <functional>
#include <string_view>

#include "checker/evidence/capture/bytes.hpp"
#include "checker/evidence/capture/capture_file.hpp"

namespace stormproof::capture::write {

class PcapngWriter {
 public:
  using Sink = std::function<void(Bytes)>;

  /// Writes the blocks of the file and of its one interface, of a libpcap link type (DLT_…).
  PcapngWriter(Sink sink, int link_type);
  /// `comment` may be empty.
  void packet(const Packet& packet, std::string_view comment);

 private:
  Sink sink_;
};

}  // namespace stormproof::capture::write
