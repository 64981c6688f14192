// Merging of the words of one relation.
#include "model/trace/transition_list.hpp"

namespace stormproof::model::trace {

void TransitionList::add(const Transition& fired) {
  Entry* entry = fired.descriptors == 0 ? nullptr : find(fired);
  if (entry == nullptr) {
    entry = &append();
    entry->machine = fired.machine;
    entry->event = fired.event;
    entry->before = fired.before;
    entry->after = fired.after;
  }
  if (fired.descriptors == 0) return;
  if (entry->words.size() <= fired.first_word) entry->words.resize(fired.first_word + 1);
  entry->words[fired.first_word] |= fired.descriptors;
}

TransitionList::Entry* TransitionList::find(const Transition& fired) {
  for (std::size_t k = used_; k-- > 0;) {
    Entry& entry = entries_[k];
    const bool same_step = entry.machine.machine == fired.machine.machine &&
                           entry.machine.subject == fired.machine.subject &&
                           entry.event == fired.event;
    if (!same_step) return nullptr;
    if (entry.before == fired.before && entry.after == fired.after) return &entry;
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
