// Prints one JSON object per event and line.
#include "model/trace/perfetto_events.hpp"

#include <ostream>

#include "model/trace/json_text.hpp"
#include "model/trace/scenario_names.hpp"

namespace stormproof::model::trace {

PerfettoEvents::PerfettoEvents(std::ostream& out) : out_{out} {
  append(text_, R"({"displayTimeUnit":"ns","otherData":{"program":")", program_name(),
         R"("},"traceEvents":[)");
}

void PerfettoEvents::start(char phase, Track track, Nanoseconds at) {
  append(text_, first_ ? "\n" : ",\n", R"({"ph":")", std::string_view{&phase, 1}, R"(","pid":)",
         track.process);
  if (track.thread != 0) append(text_, R"(,"tid":)", track.thread);
  text_ += R"(,"ts":)";
  append_microseconds(text_, at);
  first_ = false;
}

void PerfettoEvents::process_name(std::uint32_t process, std::string_view name) {
  start('M', {process, 0}, {});
  append(text_, R"(,"name":"process_name","args":{"name":)", json_string(name), "}}");
  start('M', {process, 0}, {});
  append(text_, R"(,"name":"process_sort_index","args":{"sort_index":)", process, "}}");
}

void PerfettoEvents::thread_name(Track track, std::string_view name) {
  start('M', track, {});
  append(text_, R"(,"name":"thread_name","args":{"name":)", json_string(name), "}}");
  start('M', track, {});
  append(text_, R"(,"name":"thread_sort_index","args":{"sort_index":)", track.thread, "}}");
}

void PerfettoEvents::begin_slice(Track track, Nanoseconds at, const char* category,
                                 std::string_view name, std::string_view args) {
  start('B', track, at);
  append(text_, R"(,"cat":")", category, R"(","name":")", name, "\"");
  if (!args.empty()) append(text_, R"(,"args":{)", args, "}");
  text_ += '}';
}

void PerfettoEvents::end_slice(Track track, Nanoseconds at) {
  start('E', track, at);
  text_ += '}';
}

void PerfettoEvents::flow(const Flow& flow, Track track, Nanoseconds at) {
  start(static_cast<char>(flow.phase), track, at);
  append(text_, R"(,"cat":")", flow.category, R"(","name":")", flow.category, R"(","id":)", flow.id,
         flow.phase == FlowPhase::end ? R"(,"bp":"e"})" : "}");
}

void PerfettoEvents::counter(std::uint32_t process, Nanoseconds at, std::string_view name,
                             std::string_view values) {
  start('C', {process, 0}, at);
  append(text_, R"(,"name":)", json_string(name), R"(,"args":{)", values, "}}");
}

void PerfettoEvents::flush(bool last) {
  if (last) text_ += "\n]}\n";
  out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
  text_.clear();
}

}  // namespace stormproof::model::trace
