// Merging of the words of one relation.
#include "model/trace/transition_list.hpp"

namespace stormproof::model::trace {

void TransitionList::add(const MachineRef& machine, std::string_view event, std::string_view before,
                         std::string_view after, std::uint32_t word, std::uint64_t descriptors) {
  Entry* entry = descriptors == 0 ? nullptr : find(machine, event, before, after);
  if (entry == nullptr) {
    entry = &append();
    entry->machine = machine;
    entry->event = event;
    entry->before = before;
    entry->after = after;
  }
  if (descriptors == 0) return;
  if (entry->words.size() <= word) entry->words.resize(word + 1);
  entry->words[word] |= descriptors;
}

TransitionList::Entry* TransitionList::find(const MachineRef& machine, std::string_view event,
                                            std::string_view before, std::string_view after) {
  for (std::size_t k = used_; k-- > 0;) {
    Entry& entry = entries_[k];
    const bool same_step = entry.machine.machine == machine.machine &&
                           entry.machine.subject == machine.subject && entry.event == event;
    if (!same_step) return nullptr;
    if (entry.before == before && entry.after == after) return &entry;
  }
  return nullptr;
}

TransitionList::Entry& TransitionList::append() {
  if (used_ == entries_.size()) entries_.emplace_back();
  Entry& entry = entries_[used_++];
  entry.words.clear();
  return entry;
}

}  // namespace stormproof::model::trace
