// Groups copies by their count, which all copies of a HEARTBEAT share.
#include "checker/evidence/conform/cyclone_sent.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform::cyclone {

namespace {

/// A HEARTBEAT goes to a reader once.
std::optional<Unexplained> collect(const WriterRelations& writer, std::vector<Sent>& all) {
  std::map<std::uint32_t, Sent> by_count;
  for (std::size_t r = 0; r < writer.relations.size(); ++r) {
    const Relation& relation = *writer.relations[r];
    std::set<std::uint32_t> with_data;
    for (const Submessage& one : relation.sent) {
      if (one.descriptor) with_data.insert(one.datagram);
    }
    std::set<std::uint32_t> counts;
    for (const Submessage& one : relation.sent) {
      if (!one.heartbeat) continue;
      if (!counts.insert(one.heartbeat->count).second) {
        return conform::unexplained_in(relation, one.event, Fault::heartbeat_count,
                                       fmt::format("HEARTBEAT {} again", one.heartbeat->count),
                                       "the counts of a writer's HEARTBEATs grow", {});
      }
      Sent& sent = by_count[one.heartbeat->count];
      if (sent.events.empty() || one.time_ns < sent.time_ns) sent.time_ns = one.time_ns;
      if (sent.events.empty()) sent.heartbeat = *one.heartbeat;
      sent.events.insert(one.event);
      sent.is_multicast = sent.is_multicast || one.is_multicast;
      sent.is_with_data = sent.is_with_data || with_data.contains(one.datagram);
      if (!one.is_multicast) sent.receivers.insert(r);
    }
  }
  for (auto& [count, sent] : by_count) all.push_back(std::move(sent));
  return std::nullopt;
}

/// By its count, which it gets when it is made, none announces less than one before.
std::optional<Unexplained> ranges(const WriterRelations& writer, const std::vector<Sent>& sent) {
  std::uint32_t most = 0;
  for (const Sent& one : sent) {
    if (one.heartbeat.announced < most || one.heartbeat.first > 1) {
      return unexplained_in(writer, one, Fault::heartbeat_range,
                            fmt::format("HEARTBEAT {} announces {} to {}", one.heartbeat.count,
                                        one.heartbeat.first, one.heartbeat.announced),
                            fmt::format("an earlier one announced 1 to {}", most), {});
    }
    most = one.heartbeat.announced;
  }
  return std::nullopt;
}

/// What names nobody goes to all readers that there are: with multicast to the group, if these
/// are two or more, otherwise to each, and readers become more.
std::optional<Unexplained> copies(const Context& context, const WriterRelations& writer,
                                  const std::vector<Sent>& sent) {
  std::set<std::size_t> known;
  for (const Sent& one : sent) {
    if (one.is_named() || one.is_multicast || one.is_with_data) continue;
    const bool is_for_group =
        context.dds.allow_multicast == model::AllowMulticast::always && one.receivers.size() > 1;
    const bool is_cut_off =
        one.time_ns + context.bounds.most_send_lag_ns + most_apart_ns > context.dialogue.end_ns;
    if (is_for_group || (!is_cut_off && !std::ranges::includes(one.receivers, known))) {
      return unexplained_in(writer, one, Fault::heartbeat_copies,
                            fmt::format("HEARTBEAT {} goes to {} readers by unicast",
                                        one.heartbeat.count, one.receivers.size()),
                            is_for_group ? "with multicast it would go to the group"
                                         : fmt::format("an earlier one went to {}", known.size()),
                            {});
    }
    known.insert(one.receivers.begin(), one.receivers.end());
  }
  return std::nullopt;
}

}  // namespace

Unexplained unexplained_in(const WriterRelations& writer, const Sent& one, Fault kind,
                           std::string what, std::string nearest, std::vector<Need> needs) {
  const std::size_t r = one.receivers.empty() ? 0 : *one.receivers.begin();
  Unexplained result =
      conform::unexplained_in(*writer.relations[r], one.event(), kind, std::move(what),
                              std::move(nearest), std::move(needs));
  result.place.destination.reset();
  return result;
}

std::optional<Unexplained> gather(const Context& context, const WriterRelations& writer,
                                  std::vector<Sent>& sent) {
  if (auto fault = collect(writer, sent)) return fault;
  if (auto fault = ranges(writer, sent)) return fault;
  std::ranges::stable_sort(sent, {}, [](const Sent& one) {
    return std::pair{one.time_ns, one.event()};
  });
  return copies(context, writer, sent);
}

}  // namespace stormproof::conform::cyclone
