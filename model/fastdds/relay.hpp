// The writers of a Discovery Server, as data: what each has in its history and for whom, and the
// two queues of the one thread that sends. What happens to them when is the rules' business
// (fsm/composition/server.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "fsm/change_for_reader.hpp"
#include "fsm/stepper.hpp"
#include "model/fastdds/database.hpp"
#include "model/fastdds/relayed.hpp"

namespace stormproof::model::fastdds {

class RelayWriter {
 public:
  /// A change in the list of a reader.
  struct Entry {
    fsm::StateId state = fsm::Stepper<fsm::ChangeForReader>::initial;
    bool sent = false;
  };
  struct Reader {
    std::int64_t low = 0;
    std::map<std::int64_t, Entry> list;
  };

  [[nodiscard]] bool empty() const { return history.empty(); }
  /// What a HEARTBEAT announces: the numbers of the history, not those of what has left it since.
  [[nodiscard]] std::int64_t first() const {
    return history.empty() ? next : history.begin()->first;
  }
  [[nodiscard]] std::int64_t last() const {
    return history.empty() ? next - 1 : history.rbegin()->first;
  }
  /// The number of the item in the history, or 0.
  [[nodiscard]] std::int64_t number_of(Item item) const {
    const auto found = numbers.find(item);
    return found == numbers.end() ? 0 : found->second;
  }
  /// Takes the item out of the history and of all lists.
  void remove(Item item) {
    const std::int64_t number = number_of(item);
    if (number == 0) return;
    numbers.erase(item);
    history.erase(number);
    for (auto& [relation, reader] : about) reader.list.erase(number);
  }
  /// Appends the item to the history, which has it no more. Returns its number.
  std::int64_t append(Item item) {
    history.emplace(next, item);
    numbers.emplace(item, next);
    return next++;
  }

  std::map<std::int64_t, Item> history;
  std::map<Item, std::int64_t> numbers;
  std::int64_t next = 1;
  std::int64_t heartbeats = 0;            ///< sent so far
  std::vector<std::uint32_t> readers;     ///< relations, in match order
  std::map<std::uint32_t, Reader> about;  ///< by relation
};

/// What the sending thread has to do: new changes first, then those to be sent again.
class SendingQueues {
 public:
  struct Entry {
    std::uint32_t relay = 0;
    Item item = 0;
    bool operator==(const Entry&) const = default;
  };
  [[nodiscard]] bool empty() const { return fresh_.empty() && again_.empty(); }
  void add(Entry entry) { fresh_.push_back(entry); }
  /// Unless it is in one of the queues.
  void add_again(Entry entry) {
    if (has(fresh_, entry) || has(again_, entry)) return;
    again_.push_back(entry);
  }
  void remove(Entry entry) {
    std::erase(fresh_, entry);
    std::erase(again_, entry);
  }
  /// The next one; there must be one.
  Entry take() {
    std::deque<Entry>& queue = fresh_.empty() ? again_ : fresh_;
    const Entry entry = queue.front();
    queue.pop_front();
    return entry;
  }

 private:
  static bool has(const std::deque<Entry>& queue, Entry entry) {
    return std::ranges::find(queue, entry) != queue.end();
  }

  std::deque<Entry> fresh_;
  std::deque<Entry> again_;
};

}  // namespace stormproof::model::fastdds
