// The event queue against an unsorted list that is searched, and the source queue against a list of
// packets, one entry for each copy.
#include <algorithm>
#include <deque>
#include <tuple>

#include "model/engine/event_queue.hpp"
#include "model/engine/source_queue.hpp"
#include "tests/model/stateful/engine_subject.hpp"

namespace stormproof::model::stateful {

namespace {

// ---- Event queue: the next event is the least (time, class, insertion number).

enum QueueCall : std::size_t { schedule_ahead, schedule_anywhere, schedule_in_class, take_next };
constexpr std::int64_t last_kind = static_cast<std::int64_t>(event_kind_count) - 1;

struct Scheduled {
  std::int64_t time = 0;
  int event_class = 0;
  std::uint64_t insertion = 0;
  EventKind kind{};
};

std::string event_words(const Scheduled& e) {
  return std::string{name_of(e.kind)} + " at " + std::to_string(e.time) + ", class " +
         std::to_string(e.event_class) + ", insertion " + std::to_string(e.insertion);
}

/// The event that a call schedules: (kind, time, class).
Scheduled wanted(const Call& call, std::int64_t now) {
  Scheduled e;
  e.kind = static_cast<EventKind>(call.payload[0]);
  e.time = call.event == schedule_anywhere ? call.payload[1] : now + call.payload[1];
  e.event_class = call.event == schedule_in_class ? static_cast<int>(call.payload[2])
                                                  : static_cast<int>(class_of(e.kind));
  return e;
}

class EventList final : public PlainModel<EventList> {
 public:
  explicit EventList(Wrong wrong) : wrong_{wrong} {}
  [[nodiscard]] bool possible(const Call& call) const override {
    return call.event != take_next || !events_.empty();
  }
  std::string react(const Call& call) override {
    std::string text;
    if (call.event == take_next) {
      const auto first =
          std::min_element(events_.begin(), events_.end(),
                           [&](const Scheduled& a, const Scheduled& b) { return key(a) < key(b); });
      now_ = first->time;
      text = event_words(*first) + "; ";
      events_.erase(first);
    } else {
      Scheduled e = wanted(call, now_);
      e.insertion = inserted_++;
      if (wrong_ != Wrong::forgets_one || inserted_ % 10 != 0) events_.push_back(e);
    }
    return text + std::to_string(events_.size()) + " left";
  }

 private:
  [[nodiscard]] std::tuple<std::int64_t, int, std::int64_t> key(const Scheduled& e) const {
    const auto insertion = static_cast<std::int64_t>(e.insertion);
    return {e.time, wrong_ == Wrong::class_ignored ? 0 : e.event_class,
            wrong_ == Wrong::latest_first ? -insertion : insertion};
  }

  Wrong wrong_;
  std::vector<Scheduled> events_;
  std::uint64_t inserted_ = 0;
  std::int64_t now_ = 0;
};

class EventQueueUnderTest final : public Reactor {
 public:
  std::string react(const Call& call) override {
    std::string text;
    if (call.event == take_next) {
      const Event e = queue_.pop();
      now_ = e.time.count();
      text = event_words({now_, static_cast<int>(e.event_class()), e.insertion(), e.kind}) + "; ";
    } else {
      const Scheduled e = wanted(call, now_);
      queue_.schedule_as(static_cast<EventClass>(e.event_class), Nanoseconds{e.time}, e.kind, 0, 0);
    }
    return text + std::to_string(queue_.size()) + " left";
  }

 private:
  EventQueue queue_;
  std::int64_t now_ = 0;
};

// ---- Source queue: first in, first out; a copy is admitted when the queue is empty or its bytes
// fit into what is left of W; nothing is ever dropped.

enum SourceCall : std::size_t { pushed, admitted, released };
constexpr std::int64_t queue_bytes = 4'000;
constexpr std::int64_t payloads[] = {68, 420, 1'472, 1'473, 3'000, 9'000};

struct Copy {
  std::uint64_t number = 0;
  std::int64_t demand = 0;
};

std::string source_words(const std::vector<std::uint64_t>& out, std::int64_t bytes,
                         std::size_t backlog) {
  return "admitted " + in_words(out) + ", " + std::to_string(bytes) + " B, backlog " +
         std::to_string(backlog);
}

class SourceList final : public PlainModel<SourceList> {
 public:
  explicit SourceList(Wrong wrong) : wrong_{wrong} {}
  [[nodiscard]] bool possible(const Call& call) const override {
    return call.event != released || !inside_.empty();
  }
  std::string react(const Call& call) override {
    std::vector<std::uint64_t> out;
    if (call.event == pushed) {
      push(payloads[call.payload[0]], call.payload[1] + 1);
    } else if (call.event == admitted) {
      while (!backlog_.empty() && fits(next())) {
        inside_.push_back(next());
        out.push_back(next().number);
        wrong_ == Wrong::last_in_first_out ? backlog_.pop_back() : backlog_.pop_front();
      }
      if (wrong_ == Wrong::drops_when_full) backlog_.clear();
    } else {
      const auto k = static_cast<std::size_t>(call.payload[0]) % inside_.size();
      inside_.erase(inside_.begin() + static_cast<std::ptrdiff_t>(k));
    }
    return source_words(out, bytes(), backlog_.size());
  }

 private:
  [[nodiscard]] const Copy& next() const {
    return wrong_ == Wrong::last_in_first_out ? backlog_.back() : backlog_.front();
  }
  void push(std::int64_t payload, std::int64_t copies) {
    // Every fragment of up to 1,480 B of payload and UDP header takes 58 B more.
    const std::int64_t fragments = (payload + 8 + 1'479) / 1'480;
    for (std::int64_t k = 0; k < copies; ++k) {
      const bool counts = wrong_ != Wrong::copies_count_once || k == 0;
      if (counts) backlog_.push_back({number_, payload + 8 + 58 * fragments});
      ++number_;
    }
  }
  [[nodiscard]] std::int64_t bytes() const {
    std::int64_t sum = 0;
    for (const Copy& copy : inside_) sum += copy.demand;
    return sum;
  }
  [[nodiscard]] bool fits(const Copy& copy) const {
    if (wrong_ == Wrong::admits_one_more && bytes() < queue_bytes) return true;
    if (wrong_ == Wrong::never_admits_larger && copy.demand > queue_bytes) return false;
    return bytes() == 0 || bytes() + copy.demand <= queue_bytes;
  }

  Wrong wrong_;
  std::deque<Copy> backlog_;
  std::vector<Copy> inside_;
  std::uint64_t number_ = 0;
};

class SourceQueueUnderTest final : public Reactor {
 public:
  std::string react(const Call& call) override {
    std::vector<std::uint64_t> out;
    if (call.event == pushed) {
      Packet packet;
      packet.number = number_;
      packet.payload_bytes = static_cast<std::uint32_t>(payloads[call.payload[0]]);
      packet.copies = static_cast<std::uint32_t>(call.payload[1] + 1);
      number_ += packet.copies;
      queue_.push(std::move(packet), fragmentation_);
    } else if (call.event == admitted) {
      while (queue_.fitting(Bytes{queue_bytes}) > 0) {
        inside_.push_back(queue_.head_demand());
        queue_.admit_head(fragmentation_);
        Packet packet;
        queue_.take(packet, [](const Packet&, std::uint32_t pair) { return pair; });
        out.push_back(packet.number);
      }
    } else {
      const auto k = static_cast<std::size_t>(call.payload[0]) % inside_.size();
      queue_.release(inside_[k]);
      inside_.erase(inside_.begin() + static_cast<std::ptrdiff_t>(k));
    }
    return source_words(out, queue_.admitted_bytes(), queue_.backlog_packets());
  }

 private:
  Fragmentation fragmentation_{WirelessProfile{}};
  SourceQueue queue_;
  std::vector<std::int64_t> inside_;
  std::uint64_t number_ = 0;
};

}  // namespace

std::vector<EngineSubject> queue_subjects() {
  return {engine_subject<EventList, EventQueueUnderTest>(
              "EventQueue",
              {{"schedule (kind, from now)", {last_kind, 4}},
               {"schedule (kind, at)", {last_kind, 30}},
               {"schedule (kind, from now, class)", {last_kind, 2, 2}},
               {"next"}},
              {Wrong::class_ignored, Wrong::latest_first, Wrong::forgets_one}),
          engine_subject<SourceList, SourceQueueUnderTest>(
              "SourceQueue",
              {{"packet (size, copies)", {std::size(payloads) - 1, 3}},
               {"admit what fits"},
               {"release", {9}}},
              {Wrong::admits_one_more, Wrong::never_admits_larger, Wrong::drops_when_full,
               Wrong::last_in_first_out, Wrong::copies_count_once})};
}

}  // namespace stormproof::model::stateful
