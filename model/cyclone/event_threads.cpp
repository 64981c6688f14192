// Messages of Cyclone DDS, and the queues in which they wait.
#include "model/cyclone/event_threads.hpp"

#include <algorithm>
#include <utility>

namespace stormproof::model::cyclone {

namespace {
constexpr std::uint32_t bits_per_word = 32;
}

EventThreads::EventThreads(const RunState& run)
    : steps_of_{run},
      samples_{run.scenario, run.topology},
      stride_{writers_per_participant(run.topology)},
      writers_(std::size_t{stride_} * run.topology.participant_count()) {
  for (Number i = 0; i < run.topology.participant_count(); ++i) {
    threads_.emplace_back(run.profiles.of(i).sedp);
  }
}

std::uint32_t EventThreads::samples_of(Number w) const {
  const Number slot = w % stride_;
  if (slot == writer::liveliness) return samples_.signs_of_life(w / stride_);
  if (slot > writer::liveliness) return 0;
  return samples_.count(w / stride_, stream_of(slot));
}

void EventThreads::match(Number r) {
  Writer& writer = writers_[writer_of(r)];
  writer.readers.insert(std::ranges::lower_bound(writer.readers, r), r);
  ++writer.version;
}

void EventThreads::unmatch(Number r) {
  Writer& writer = writers_[writer_of(r)];
  std::erase(writer.readers, r);
  ++writer.version;
}

Destination EventThreads::readers_of(Number w) const {
  const Writer& writer = writers_[w];
  Destination to{.is_set = true, .addresses = {}, .writer = w, .version = writer.version};
  const bool is_mixed = steps_of_.profiles.are_mixed();
  const bool sends = has_group(w / stride_);
  const auto is_in_group = [&](Number r) {
    return is_mixed ? has_group(ends_of(r).destination) : sends;
  };
  const std::size_t all = writer.readers.size();
  std::size_t in_group = sends ? all : 0;
  if (is_mixed && sends) {
    in_group = static_cast<std::size_t>(std::ranges::count_if(writer.readers, is_in_group));
  }
  const bool by_group = in_group > 1;
  if (by_group) to.addresses.push_back(group);
  if (by_group && in_group == all) return to;
  for (const Number r : writer.readers) {
    if (!by_group || !is_in_group(r)) to.addresses.push_back(ends_of(r).destination);
  }
  return to;
}

/// A message about a writer of `owner`.
Message EventThreads::message(Submessage&& content, Number owner, Number slot, std::int64_t bytes) {
  Message m;
  m.content = std::move(content);
  m.content.participant = owner;
  m.content.writer = slot;
  m.bytes = bytes;
  m.of_user = slot >= writer::first_topic;
  return m;
}

Message EventThreads::heartbeat(Number w, Number announced, std::int64_t count,
                                bool directed) const {
  Submessage content;
  content.kind = Submessage::Kind::heartbeat;
  content.directed = directed;
  content.sample = announced;
  content.count = count;
  return message(std::move(content), w / stride_, w % stride_, heartbeat_bytes);
}

Message EventThreads::data(Number w, Number sample) const {
  Submessage content;
  content.kind = Submessage::Kind::data;
  content.sample = sample;
  const Number slot = w % stride_;
  if (slot > writer::subscriptions) {
    return message(std::move(content), w / stride_, slot, data_bytes(slot, sample));
  }
  const Sample said = samples_.of(w / stride_, stream_of(slot), sample);
  return message(
      std::move(content), w / stride_, slot,
      said.deletes ? timestamp_bytes + deletion_bytes : data_bytes(slot, said.descriptor));
}

/// Without a list if the samples are in a row.
Message EventThreads::gap(Number r, DescriptorSet&& samples) const {
  Number end_of_first = samples.lowest();
  while ((samples.word(end_of_first / 64) >> end_of_first % 64 & 1) != 0) ++end_of_first;
  const Number bits = end_of(samples) - end_of_first;
  Submessage content;
  content.kind = Submessage::Kind::gap;
  content.bitmap = std::move(samples);
  Message m = message(std::move(content), ends_of(r).source, r % stride_,
                      gap_bytes + bitmap_word_bytes * ((bits + bits_per_word - 1) / bits_per_word));
  m.to = Destination::only(ends_of(r).destination);
  return m;
}

Message EventThreads::announcement(Number i) const {
  Submessage content;
  content.kind = Submessage::Kind::spdp;
  return message(std::move(content), i, 0,
                 has_group(i) ? announcement_with_multicast_bytes : announcement_bytes);
}

Message EventThreads::acknack(Number r, Submessage&& content, Number known) const {
  content.kind = Submessage::Kind::acknack;
  const Number bits = content.bitmap.empty() ? 0 : known - content.sample;
  const Number words = (bits + bits_per_word - 1) / bits_per_word;
  return message(std::move(content), ends_of(r).source, r % stride_,
                 acknack_bytes + bitmap_word_bytes * words);
}

void EventThreads::enqueue(Number i, Message&& m) {
  if (m.retransmission) ++threads_[i].queued_repairs;
  threads_[i].queue.push_back(std::move(m));
}

bool EventThreads::take_queued(Thread& thread) {
  if (thread.queue.empty()) return false;
  if (thread.queue.front().retransmission) --thread.queued_repairs;
  thread.given.push_back(std::move(thread.queue.front()));
  thread.queue.pop_front();
  return true;
}

bool EventThreads::is_queued(Number r, Number sample, bool for_it) const {
  return std::ranges::any_of(threads_[ends_of(r).source].queue, [&](const Message& m) {
    return repeats(m, r, sample) && (!for_it || m.to.is_only(ends_of(r).destination));
  });
}

void EventThreads::send_to_all_instead(Number r, Number sample) {
  for (Message& m : threads_[ends_of(r).source].queue) {
    if (!repeats(m, r, sample)) continue;
    if (!m.to.is_set && !m.to.is_only(ends_of(r).destination)) m.to = readers_of(writer_of(r));
  }
}

void EventThreads::let_answer_go(Number i) {
  std::optional<KeptAnswer>& kept = threads_[i].kept;
  if (!kept) return;
  enqueue(i, std::move(kept->message));
  kept.reset();
}

void EventThreads::begin_to_send(Thread& thread) const {
  Bundle bundle = thread.packer.take_open();
  thread.left.assign(bundle.to.addresses.begin(), bundle.to.addresses.end());
  thread.bytes = bundle.bytes;
  thread.contents = std::make_shared<const std::vector<Submessage>>(std::move(bundle.contents));
}

}  // namespace stormproof::model::cyclone
