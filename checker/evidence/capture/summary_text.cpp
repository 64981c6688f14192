// The summary for people.
#include <algorithm>
#include <vector>

#include <fmt/core.h>

#include "checker/evidence/capture/summary.hpp"
#include "checker/evidence/capture/timeline.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::capture {

namespace {

using report::grouped;
using report::left;
using report::right;

std::string elapsed(std::int64_t ns) {
  return report::duration(model::Nanoseconds{std::max<std::int64_t>(ns, 0)});
}

std::string heading(const Summary& summary) {
  const Conversation& conversation = summary.conversation;
  const Counting& counting = summary.counting;
  const Topology& topology = conversation.topology;
  std::string text;
  for (const CaptureInfo& one : conversation.captures) {
    text += fmt::format("{}: {} packets, {} RTPS datagrams", one.name, grouped(one.packets),
                        grouped(one.datagrams));
    if (one.merged > 0) {
      text += fmt::format(", {} of them in another capture, too", grouped(one.merged));
    }
    text += '\n';
  }
  text += fmt::format("{} host{}, {} participants, {} descriptor keys required{}\n", topology.hosts,
                      topology.hosts == 1 ? "" : "s", topology.participants.size(),
                      grouped(counting.required), topology.hosts == 1 ? "" : " across hosts");
  text += fmt::format("Counted: {} from the first packet on",
                      elapsed(summary.end_ns() - conversation.first_ns));
  if (counting.after_cut > 0) {
    text += fmt::format("; {} later datagrams are left out", grouped(counting.after_cut));
  }
  return text + ".\n";
}

std::string completeness(const Summary& summary) {
  constexpr std::size_t most_shown = 5;
  const Counting& counting = summary.counting;
  const Topology& topology = summary.conversation.topology;
  if (counting.last_initial_ns) {
    return fmt::format(
        "Every required descriptor key is there; the last one was sent first after "
        "{}.\n",
        elapsed(*counting.last_initial_ns - summary.conversation.first_ns));
  }
  if (counting.required == 0) return "No descriptor key is required: nobody to tell, or nothing.\n";
  std::string text =
      fmt::format("MISSING: {} of {} required descriptor keys were never sent in this capture:\n",
                  grouped(counting.missing_count), grouped(counting.required));
  for (std::size_t k = 0; k < std::min(counting.missing.size(), most_shown); ++k) {
    const MissingKey& key = counting.missing[k];
    const auto number = [&](const GuidPrefix& prefix) {
      const Participant* found = topology.find(prefix);
      return found == nullptr ? to_string(prefix) : std::to_string(topology.index_of(*found));
    };
    text += fmt::format("  {} {} of participant {} to participant {}\n", stream_of(key.writer),
                        key.sequence_number, number(key.source), number(key.destination));
  }
  if (counting.missing.size() > most_shown) text += "  …\n";
  return text;
}

/// "452 / 460 / 532": least, median and most of the single datagrams.
std::string size_range(const std::map<std::uint32_t, std::uint64_t>& sizes) {
  if (sizes.empty()) return "–";
  std::uint64_t all = 0;
  for (const auto& [size, datagrams] : sizes) all += datagrams;
  std::uint64_t below = 0;
  std::uint32_t median = 0;
  for (const auto& [size, datagrams] : sizes) {
    below += datagrams;
    median = size;
    if (below * 2 >= all) break;
  }
  return fmt::format("{} / {} / {}", sizes.begin()->first, median, sizes.rbegin()->first);
}

std::string messages(const Counting& counting) {
  std::string text =
      "\nmessages                    count   submessages    alone in a datagram, UDP payload\n"
      "                                        (bytes)    (bytes: least / median / most)\n";
  const auto entries = counting.counts.entries();
  for (std::size_t k = 0; k < message_class_count; ++k) {
    text += fmt::format("  {} {} {}    {}\n", left(words_of(static_cast<MessageClass>(k)), 16),
                        right(grouped(entries[k].value), 14),
                        right(grouped(counting.sizes[k].submessage_bytes), 13),
                        size_range(counting.sizes[k].single));
  }
  text += fmt::format("  {} {}\n", left("total", 16), right(grouped(counting.counts.total()), 14));
  text += fmt::format("  in {} datagrams, {} frames, {} bytes with link headers\n",
                      grouped(counting.datagrams), grouped(counting.frames),
                      grouped(counting.wire_bytes));
  const auto note = [&text](std::uint64_t value, const char* what) {
    if (value > 0) text += fmt::format("  {} {}\n", grouped(value), what);
  };
  note(counting.same_host.total(), "messages to the sender's own host are left out");
  note(counting.multicast_data, "SEDP DATA by multicast: their keys have no destination");
  note(counting.unknown_destination, "messages to an address that no participant announced");
  return text;
}

using Line = std::pair<std::string, std::uint64_t>;

std::string list(const char* title, const std::vector<Line>& lines) {
  std::string text = fmt::format("\n{}\n", title);
  for (const auto& [name, value] : lines) {
    text += fmt::format("  {} {}\n", left(name, 40), right(grouped(value), 12));
  }
  return text;
}

std::string heartbeats(const HeartbeatFigures& figures) {
  const auto of = [&](HeartbeatKind kind) { return figures.of(kind); };
  return list("HEARTBEATs",
              {{"relation-open, to one reader", of(HeartbeatKind::relation_open)},
               {"reply to an initial ACKNACK", of(HeartbeatKind::reply)},
               {"piggyback on DATA to one reader", of(HeartbeatKind::directed_piggyback)},
               {"others to one reader", of(HeartbeatKind::directed)},
               {"fan-out, periodic", of(HeartbeatKind::fan_out_periodic)},
               {"fan-out, piggyback", of(HeartbeatKind::fan_out_piggyback)},
               {"fan-out, cause not known", of(HeartbeatKind::fan_out)},
               {"empty (nothing written yet)", figures.empty}});
}

std::string acknacks(const AcknackFigures& figures) {
  return list("ACKNACKs", {{"initial (nothing known yet)", figures.initial},
                           {"  of these, asking for a HEARTBEAT", figures.preemptive},
                           {"negative (asks for DATA)", figures.negative},
                           {"  sequence numbers asked for", figures.requested},
                           {"positive", figures.positive}});
}

std::string other_traffic(const Counting& counting) {
  std::string text = "\nwhat shares the channel        DATA  HEARTBEAT    ACKNACK        GAP\n";
  for (const Traffic traffic : all_traffic) {
    const TrafficFigures& figures = counting.traffic[static_cast<std::size_t>(traffic)];
    const std::string data =
        figures.data_frag == 0
            ? grouped(figures.data)
            : fmt::format("{} (+{} DATA_FRAG)", grouped(figures.data), grouped(figures.data_frag));
    text += fmt::format("  {} {} {} {} {}\n", left(name_of(traffic), 20), right(data, 12),
                        right(grouped(figures.heartbeat), 10), right(grouped(figures.acknack), 10),
                        right(grouped(figures.gap), 10));
  }
  return text;
}

std::string histogram(const Counting& counting) {
  if (counting.data_per_datagram.empty()) return "";
  constexpr double width = 40;
  std::uint64_t most = 1;
  for (const auto& [data, datagrams] : counting.data_per_datagram) most = std::max(most, datagrams);
  std::string text = "\nSEDP DATA per datagram   datagrams\n";
  for (const auto& [data, datagrams] : counting.data_per_datagram) {
    const double share = static_cast<double>(datagrams) / static_cast<double>(most);
    text += fmt::format("  {} {}  {}\n", right(grouped(data), 20), right(grouped(datagrams), 11),
                        std::string(static_cast<std::size_t>(share * width + 0.5), '#'));
  }
  return text;
}

std::string over_time(const Summary& summary) {
  constexpr std::size_t rows = 20;
  constexpr double width = 30;
  const Timeline line = timeline(summary.conversation, summary.counting, summary.end_ns(), rows);
  const auto sum = [](const auto& step) {
    std::uint64_t total = 0;
    for (const std::uint64_t value : step) total += value;
    return total;
  };
  std::uint64_t most = 1;
  for (const auto& step : line.steps) most = std::max(most, sum(step));
  std::string text = "\nuntil            SPDP   initial    repair  HEARTBEAT   ACKNACK\n";
  for (std::size_t k = 0; k < line.steps.size(); ++k) {
    const auto& step = line.steps[k];
    const auto of = [&](MessageClass one) { return step[static_cast<std::size_t>(one)]; };
    const double share = static_cast<double>(sum(step)) / static_cast<double>(most);
    text += fmt::format(
        "  {} {} {} {} {} {}  {}\n",
        right(elapsed(static_cast<std::int64_t>(k + 1) * line.step_ns), 10),
        right(grouped(of(MessageClass::spdp_multicast) + of(MessageClass::spdp_unicast)), 8),
        right(grouped(of(MessageClass::initial_data)), 9),
        right(grouped(of(MessageClass::repair_data)), 9),
        right(grouped(of(MessageClass::heartbeat)), 10),
        right(grouped(of(MessageClass::acknack)), 9),
        std::string(static_cast<std::size_t>(share * width + 0.5), '#'));
  }
  return text;
}

/// A name from the capture, without what a terminal might obey.
std::string printable(const std::string& name) {
  std::string text = name;
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

std::string participants(const Conversation& conversation) {
  std::string text =
      "\nparticipants               from                vendor       pub  sub  name\n";
  const auto& list = conversation.topology.participants;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Participant& one = list[k];
    std::string addresses;
    for (const Address& address : one.addresses) {
      addresses += (addresses.empty() ? "" : ", ") + to_string(address);
    }
    text += fmt::format("  {} on host {}  {}  {}  {} {} {}  {}\n", right(std::to_string(k), 2),
                        one.host, left(to_string(one.prefix).substr(0, 8), 8), left(addresses, 18),
                        left(vendor_name(one.vendor), 11),
                        right(std::to_string(one.announced(entity::publications_writer)), 4),
                        right(std::to_string(one.announced(entity::subscriptions_writer)), 4),
                        printable(one.name));
  }
  return text;
}

std::string remarks(const Conversation& conversation) {
  if (conversation.remarks.empty()) return "";
  std::string text = "\nremarks\n";
  for (const Remark& one : conversation.remarks) {
    text += report::paragraph(
        "  ", fmt::format("{} × {}; the first: {}", grouped(one.count), one.what, one.first));
  }
  return text;
}

}  // namespace

std::string to_text(const Summary& summary) {
  const Counting& counting = summary.counting;
  return heading(summary) + completeness(summary) + messages(counting) +
         heartbeats(counting.heartbeats) + acknacks(counting.acknacks) + other_traffic(counting) +
         histogram(counting) + over_time(summary) + participants(summary.conversation) +
         remarks(summary.conversation);
}

}  // namespace stormproof::capture
