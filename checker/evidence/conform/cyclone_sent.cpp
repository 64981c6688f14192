// What the HEARTBEATs of a writer say, and to whom.
#include "checker/evidence/conform/cyclone_sent.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform::cyclone {

namespace {

/// By its count, which it gets when it is made, none announces less than one before.
std::optional<Unexplained> ranges(const WriterRelations& writer,
                                  const std::vector<SentHeartbeat>& sent) {
  std::uint32_t most = 0;
  for (const SentHeartbeat& one : sent) {
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
                                  const std::vector<SentHeartbeat>& sent) {
  std::set<std::size_t> known;
  for (const SentHeartbeat& one : sent) {
    if (one.is_named() || one.is_multicast || one.is_behind_data) continue;
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

Unexplained unexplained_in(const WriterRelations& writer, const SentHeartbeat& one, Fault kind,
                           std::string what, std::string nearest, std::vector<Need> needs) {
  const std::size_t r = one.receivers.empty() ? 0 : *one.receivers.begin();
  Unexplained result =
      conform::unexplained_in(*writer.relations[r], *one.events.begin(), kind, std::move(what),
                              std::move(nearest), std::move(needs));
  result.place.destination.reset();
  return result;
}

std::optional<Unexplained> gather(const Context& context, const WriterRelations& writer,
                                  std::vector<SentHeartbeat>& sent) {
  SentHeartbeats all = sent_heartbeats(writer);
  if (all.repeated) {
    return conform::unexplained_in(*writer.relations[all.repeated->relation], all.repeated->event,
                                   Fault::heartbeat_count,
                                   fmt::format("HEARTBEAT {} again", all.repeated->heartbeat.count),
                                   "the counts of a writer's HEARTBEATs grow", {});
  }
  sent = std::move(all.all);
  std::ranges::sort(sent, {}, [](const SentHeartbeat& one) { return one.heartbeat.count; });
  if (auto fault = ranges(writer, sent)) return fault;
  std::ranges::sort(sent, {}, [](const SentHeartbeat& one) {
    return std::pair{one.time_ns, *one.events.begin()};
  });
  return copies(context, writer, sent);
}

}  // namespace stormproof::conform::cyclone
