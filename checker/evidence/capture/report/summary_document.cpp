// The summary for people: is everything there, how many messages of which class, what else shares
// the channel, and who took part.
#include <algorithm>
#include <numeric>

#include <fmt/core.h>

#include "checker/evidence/capture/summary.hpp"
#include "checker/evidence/capture/timeline.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::capture {

namespace {

using report::Column;
using report::Facts;
using report::grouped;
using report::plural;
using report::Section;
using report::Table;

constexpr auto to_the_right = Column::Align::right;

std::string elapsed(std::int64_t ns) {
  return report::duration(model::Nanoseconds{std::max<std::int64_t>(ns, 0)});
}

/// `value` of at most `most` as a bar of at most `width` columns.
std::string bar(std::uint64_t value, std::uint64_t most, double width) {
  const double share =
      static_cast<double>(value) / static_cast<double>(std::max<std::uint64_t>(most, 1));
  return std::string(static_cast<std::size_t>(share * width + 0.5), '#');
}

Facts captures(const Summary& summary) {
  const Conversation& conversation = summary.conversation;
  const Counting& counting = summary.counting;
  const Topology& topology = conversation.topology;
  Facts facts;
  for (const CaptureInfo& one : conversation.captures) {
    facts.rows.emplace_back(
        "capture", fmt::format("{}: {} packets, {} RTPS datagrams{}", one.name,
                               grouped(one.packets), grouped(one.datagrams),
                               one.merged > 0 ? fmt::format(", {} of them in another capture, too",
                                                            grouped(one.merged))
                                              : ""));
  }
  facts.rows.emplace_back(
      "discovery",
      fmt::format("{}, {}, {} descriptor keys required{}", plural(topology.hosts, "host"),
                  plural(topology.participants.size(), "participant"), grouped(counting.required),
                  topology.hosts == 1 ? "" : " across hosts"));
  facts.rows.emplace_back(
      "counted",
      fmt::format(
          "{} from the first packet on{}", elapsed(summary.end_ns() - conversation.first_ns),
          counting.after_cut > 0
              ? fmt::format("; {} later datagrams are left out", grouped(counting.after_cut))
              : ""));
  return facts;
}

std::string completeness(const Summary& summary) {
  const Counting& counting = summary.counting;
  if (counting.last_initial_ns) {
    return fmt::format(
        "Every required descriptor key is there; the last one was sent first after {}.",
        elapsed(*counting.last_initial_ns - summary.conversation.first_ns));
  }
  if (counting.required == 0) return "No descriptor key is required: nobody to tell, or nothing.";
  return fmt::format("MISSING: {} of {} required descriptor keys were never sent in this capture.",
                     grouped(counting.missing_count), grouped(counting.required));
}

report::Bullets missing(const Summary& summary) {
  constexpr std::size_t most_shown = 5;
  const Topology& topology = summary.conversation.topology;
  const auto number = [&](const GuidPrefix& prefix) {
    const Participant* found = topology.find(prefix);
    return found == nullptr ? to_string(prefix) : std::to_string(topology.index_of(*found));
  };
  report::Bullets bullets;
  for (const MissingKey& key : summary.counting.missing) {
    if (bullets.items.size() == most_shown) {
      bullets.items.emplace_back("…");
      break;
    }
    bullets.items.emplace_back(fmt::format("{} {} of participant {} to participant {}",
                                           stream_of(key.writer), key.sequence_number,
                                           number(key.source), number(key.destination)));
  }
  return bullets;
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

Section messages(const Counting& counting) {
  Table table{{{"class"},
               {"messages", to_the_right},
               {"bytes of submessages", to_the_right},
               {"alone in a datagram, UDP payload (least / median / most)"}},
              {}};
  const auto entries = counting.counts.entries();
  for (std::size_t k = 0; k < message_class_count; ++k) {
    table.rows.push_back(
        {{words_of(static_cast<MessageClass>(k)), grouped(entries[k].value),
          grouped(counting.sizes[k].submessage_bytes), size_range(counting.sizes[k].single)}});
  }
  if (counting.counts.of_server() > 0) {
    const auto of_server = [&](const char* what, std::uint64_t value) {
      table.rows.push_back({{what, grouped(value), "", ""}});
    };
    of_server("DATA(p)", counting.counts.pdp_data);
    of_server("HEARTBEAT(p)", counting.counts.pdp_heartbeat);
    of_server("ACKNACK(p)", counting.counts.pdp_acknack);
    of_server("GAP (in no total)", counting.counts.gap);
  }
  if (counting.counts.lookup > 0) {
    table.rows.push_back(
        {{"lookup (in no total)", grouped(counting.counts.lookup),
          grouped(counting.lookup_requests.data_bytes + counting.lookup_replies.data_bytes), ""}});
  }
  table.rows.push_back({{"total", grouped(counting.counts.total()), "", ""}});
  report::Bullets notes{{fmt::format("in {} datagrams, {} frames, {} bytes with link headers",
                                     grouped(counting.datagrams), grouped(counting.frames),
                                     grouped(counting.wire_bytes))}};
  const auto note = [&notes](std::uint64_t value, const char* what) {
    if (value > 0) notes.items.emplace_back(grouped(value) + " " + what);
  };
  note(counting.same_host.total(), "messages to the sender's own host are left out");
  note(counting.multicast_data, "SEDP DATA by multicast: their keys have no destination");
  note(counting.unknown_destination, "messages to an address that no participant announced");
  return {"Messages", "messages", {std::move(table), std::move(notes)}};
}

Table kinds_of(const char* what,
               const std::vector<std::pair<const char*, std::uint64_t>>& figures) {
  Table table{{{what}, {"messages", to_the_right}}, {}};
  for (const auto& [name, value] : figures) table.rows.push_back({{name, grouped(value)}});
  return table;
}

Section kinds(const Counting& counting) {
  const HeartbeatFigures& heartbeats = counting.heartbeats;
  const AcknackFigures& acknacks = counting.acknacks;
  const auto of = [&](HeartbeatKind kind) { return heartbeats.of(kind); };
  return {"HEARTBEATs and ACKNACKs",
          "kinds",
          {kinds_of("HEARTBEAT",
                    {{"relation-open, to one reader", of(HeartbeatKind::relation_open)},
                     {"reply to an initial ACKNACK", of(HeartbeatKind::reply)},
                     {"piggyback on DATA to one reader", of(HeartbeatKind::directed_piggyback)},
                     {"others to one reader", of(HeartbeatKind::directed)},
                     {"fan-out, periodic", of(HeartbeatKind::fan_out_periodic)},
                     {"fan-out, piggyback", of(HeartbeatKind::fan_out_piggyback)},
                     {"fan-out, cause not known", of(HeartbeatKind::fan_out)},
                     {"empty (nothing written yet)", heartbeats.empty}}),
           kinds_of("ACKNACK", {{"initial (nothing known yet)", acknacks.initial},
                                {"· of these, asking for a HEARTBEAT", acknacks.preemptive},
                                {"negative (asks for DATA)", acknacks.negative},
                                {"· sequence numbers asked for", acknacks.requested},
                                {"positive", acknacks.positive}})}};
}

Section other_traffic(const Counting& counting) {
  Table table{{{"what shares the channel"},
               {"DATA", to_the_right},
               {"HEARTBEAT", to_the_right},
               {"ACKNACK", to_the_right},
               {"GAP", to_the_right}},
              {}};
  for (const Traffic traffic : all_traffic) {
    const TrafficFigures& figures = counting.traffic[static_cast<std::size_t>(traffic)];
    if (traffic == Traffic::type_lookup && figures.bytes == 0) continue;  // before Fast DDS 3
    std::string data = grouped(figures.data);
    if (figures.data_frag > 0) data += fmt::format(" (+{} DATA_FRAG)", grouped(figures.data_frag));
    table.rows.push_back({{name_of(traffic), std::move(data), grouped(figures.heartbeat),
                           grouped(figures.acknack), grouped(figures.gap)}});
  }
  Section section{"Traffic", "traffic", {std::move(table)}};
  if (counting.data_per_datagram.empty()) return section;
  std::uint64_t most = 0;
  for (const auto& [data, datagrams] : counting.data_per_datagram) most = std::max(most, datagrams);
  Table histogram{{{"SEDP DATA per datagram", to_the_right}, {"datagrams", to_the_right}, {""}},
                  {}};
  for (const auto& [data, datagrams] : counting.data_per_datagram) {
    histogram.rows.push_back({{grouped(data), grouped(datagrams), bar(datagrams, most, 40)}});
  }
  section.blocks.emplace_back(std::move(histogram));
  return section;
}

/// A name from the capture, without what a terminal might obey.
std::string printable(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return c < ' ' || c > '~'; }, '?');
  return name;
}

Section remarks(const Conversation& conversation) {
  report::Bullets bullets;
  for (const Remark& one : conversation.remarks) {
    bullets.items.emplace_back(
        fmt::format("{} × {}; the first: {}", grouped(one.count), one.what, one.first));
  }
  return {"Remarks", "remarks", {std::move(bullets)}};
}

}  // namespace

Section over_time(const Summary& summary) {
  constexpr std::size_t rows = 20;
  const Timeline line = timeline(summary.conversation, summary.counting, summary.end_ns(), rows);
  const auto sum = [](const auto& step) {
    return std::accumulate(step.begin(), step.end(), std::uint64_t{0});
  };
  std::uint64_t most = 0;
  for (const auto& step : line.steps) most = std::max(most, sum(step));
  Table table{{{"until", to_the_right},
               {"SPDP", to_the_right},
               {"initial DATA", to_the_right},
               {"repair DATA", to_the_right},
               {"HEARTBEAT", to_the_right},
               {"ACKNACK", to_the_right},
               {""}},
              {}};
  for (std::size_t k = 0; k < line.steps.size(); ++k) {
    const auto& step = line.steps[k];
    const auto of = [&](MessageClass one) { return step[static_cast<std::size_t>(one)]; };
    table.rows.push_back(
        {{elapsed(static_cast<std::int64_t>(k + 1) * line.step_ns),
          grouped(of(MessageClass::spdp_multicast) + of(MessageClass::spdp_unicast)),
          grouped(of(MessageClass::initial_data)), grouped(of(MessageClass::repair_data)),
          grouped(of(MessageClass::heartbeat)), grouped(of(MessageClass::acknack)),
          bar(sum(step), most, 24)}});
  }
  return {"Over time",
          "time",
          {std::move(table),
           {report::Drawing{to_svg(summary), "Discovery messages in the capture", "timeline"},
            report::Audience::page}}};
}

Section participants(const Conversation& conversation) {
  Table table{{{"participant", to_the_right},
               {"host", to_the_right},
               {"prefix"},
               {"from"},
               {"vendor"},
               {"version"},
               {"pub", to_the_right},
               {"sub", to_the_right},
               {"name"}},
              {}};
  const auto& list = conversation.topology.participants;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Participant& one = list[k];
    std::string addresses;
    for (const Address& address : one.addresses) {
      addresses += (addresses.empty() ? "" : ", ") + to_string(address);
    }
    table.rows.push_back(
        {{std::to_string(k), std::to_string(one.host), to_string(one.prefix).substr(0, 8),
          std::move(addresses), vendor_name(one.vendor), one.version,
          std::to_string(one.announced(entity::publications_writer)),
          std::to_string(one.announced(entity::subscriptions_writer)), printable(one.name)}});
  }
  return {"Participants", "participants", {std::move(table)}};
}

report::Document document_of(const Summary& summary) {
  const Conversation& conversation = summary.conversation;
  const Counting& counting = summary.counting;
  report::Document document;
  document.title = "stormproof capture summarize";
  for (const CaptureInfo& one : conversation.captures) document.title += " " + one.name;
  document.tone = counting.last_initial_ns ? report::Tone::good
                  : counting.required == 0 ? report::Tone::plain
                                           : report::Tone::warn;
  document.answer = completeness(summary);
  if (!counting.missing.empty()) document.blocks.emplace_back(missing(summary));
  document.blocks.emplace_back(captures(summary));
  document.blocks.emplace_back(messages(counting));
  document.blocks.emplace_back(kinds(counting));
  document.blocks.emplace_back(other_traffic(counting));
  document.blocks.emplace_back(over_time(summary));
  document.blocks.emplace_back(participants(conversation));
  if (!conversation.remarks.empty()) document.blocks.emplace_back(remarks(conversation));
  return document;
}

}  // namespace stormproof::capture
