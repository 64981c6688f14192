// What was strange in a capture and was left out: counted by kind, each with the first place, so
// that a damaged or hostile file gives a short list instead of a crash or a wall of text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stormproof::capture {

struct Remark {
  std::string what;   ///< "IP fragments overlap"
  std::string first;  ///< "a.pcap, packet 17"
  std::uint64_t count = 0;

  bool operator==(const Remark&) const = default;
};

class Remarks {
 public:
  /// One more of `what`, which is one of few texts; the place of the first one is kept.
  void add(const char* what, const std::string& place, std::uint64_t count = 1) {
    for (Remark& remark : list_) {
      if (remark.what == what) {
        remark.count += count;
        return;
      }
    }
    list_.push_back({what, place, count});
  }
  [[nodiscard]] const std::vector<Remark>& list() const { return list_; }

 private:
  std::vector<Remark> list_;
};

}  // namespace stormproof::capture
