// The events of Chrome's JSON trace format, which ui.perfetto.dev and chrome://tracing open:
// slices, flows (arrows between slices), counters and names. Slices are pairs of B and E, never X
// with a duration: readers convert microseconds to floating point, and B and E of the same instant
// stay equal under any rounding.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>

#include "model/units.hpp"

namespace stormproof::model::trace {

/// A row of the timeline.
struct Track {
  std::uint32_t process = 0;
  std::uint32_t thread = 0;  ///< not used twice, not even in different processes

  bool operator==(const Track&) const = default;
};

/// Where an arrow starts, passes through, or ends.
enum class FlowPhase : char { start = 's', step = 't', end = 'f' };

/// One arrow; `category` and `id` name it. The category is "packet" or "timer".
struct Flow {
  FlowPhase phase;
  const char* category;
  std::uint64_t id;
};

class PerfettoEvents {
 public:
  explicit PerfettoEvents(std::ostream& out);

  void process_name(std::uint32_t process, std::string_view name);
  void thread_name(Track track, std::string_view name);

  /// `args` is the inside of a JSON object, or empty.
  void begin_slice(Track track, Nanoseconds at, const char* category, std::string_view name,
                   std::string_view args);
  void end_slice(Track track, Nanoseconds at);
  /// Binds to the slice that is open on the track.
  void flow(const Flow& flow, Track track, Nanoseconds at);
  /// `values` is the inside of a JSON object of numbers; each of them is a counter of the process.
  void counter(std::uint32_t process, Nanoseconds at, std::string_view name,
               std::string_view values);

  /// Hands what has been printed to the stream. With `last`, completes the document.
  void flush(bool last = false);

 private:
  /// Starts the next event: phase, process, thread, time.
  void start(char phase, Track track, Nanoseconds at);

  std::ostream& out_;
  std::string text_;
  bool first_ = true;
};

}  // namespace stormproof::model::trace
