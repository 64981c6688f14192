// Who is there, whether everything is, and how much it took.
#include "checker/evidence/doctor/doctor.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "checker/evidence/doctor/advise.hpp"
#include "checker/evidence/doctor/expense.hpp"
#include "checker/evidence/doctor/reasons/began_late.hpp"
#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::doctor {

namespace {

using capture::Conversation;
using capture::Event;
using capture::GuidPrefix;
using model::config::Result;

std::vector<Product> products_of(const capture::Topology& topology) {
  std::map<std::pair<std::string, std::string>, std::size_t> count;
  for (const capture::Participant& one : topology.participants) {
    ++count[{capture::vendor_name(one.vendor), one.version}];
  }
  std::vector<Product> products;
  for (const auto& [name, participants] : count) {
    products.push_back({name.first, name.second, participants});
  }
  std::ranges::stable_sort(products, std::ranges::greater{}, &Product::participants);
  return products;
}

/// The paper's failure-free count from the capture alone: every required key once, one HEARTBEAT
/// and one ACKNACK for each relation, and as many announcements as introduce everybody.
model::Counts failure_free(const capture::Topology& topology, const capture::Counting& counting) {
  const std::uint64_t all = topology.participants.size();
  std::uint64_t pairs = 0;
  for (const capture::Participant& one : topology.participants) {
    for (const capture::Participant& other : topology.participants) {
      if (one.host != other.host || (topology.hosts == 1 && &one != &other)) ++pairs;
    }
  }
  constexpr std::uint64_t streams = 2;
  model::Counts counts;
  counts.initial_data = counting.required;
  counts.heartbeat = counts.acknack = streams * pairs;
  counts.spdp_multicast = all * all;
  counts.spdp_unicast = all * pairs / 2;
  if (topology.has_server()) {
    // Whatever is told is told once, each with a HEARTBEAT, and acknowledged.
    counts.initial_data = counting.counts.initial_data;
    counts.heartbeat = counts.acknack = counts.initial_data;
  }
  return counts;
}

std::uint64_t announcements_after(const Conversation& conversation,
                                  const capture::Counting& counting) {
  std::uint64_t later = 0;
  if (!counting.last_initial_ns) return later;
  for (std::size_t k = 0; k < counting.classes.size(); ++k) {
    const auto one = counting.classes[k];
    const bool is_spdp =
        one == model::MessageClass::spdp_multicast || one == model::MessageClass::spdp_unicast;
    if (is_spdp && conversation.events[k].time_ns > *counting.last_initial_ns) ++later;
  }
  return later;
}

/// Each capture by itself, against all of them together.
std::vector<Heard> who_heard_whom(const Conversation& conversation) {
  std::vector<Heard> heard;
  if (conversation.captures.size() < 2) return heard;
  std::map<capture::Address, std::size_t> host;
  for (const capture::Participant& one : conversation.topology.participants) {
    for (const capture::Address& address : one.addresses) host[address] = one.host;
  }
  std::vector<std::uint64_t> sent(conversation.topology.hosts, 0);
  for (const capture::DatagramRecord& one : conversation.datagrams) {
    if (const auto from = host.find(one.source.address); from != host.end()) ++sent[from->second];
  }
  for (const capture::CaptureInfo& capture : conversation.captures) {
    Heard one{capture.name, {}};
    for (std::size_t h = 0; h < sent.size(); ++h) one.hosts.push_back({h, 0, sent[h]});
    for (const auto& [address, datagrams] : capture.sources) {
      const auto from = host.find(address);
      if (from != host.end()) one.hosts[from->second].datagrams += datagrams;
    }
    heard.push_back(std::move(one));
  }
  return heard;
}

void judge(Report& report, const model::WirelessProfile* channel) {
  const capture::Topology& topology = report.conversation.topology;
  const bool has_keys = report.counting.required > 0;
  const auto late = std::ranges::find(report.reasons, "began_late", &Reason::id);
  const bool began_late = late != report.reasons.end();
  const bool is_incomplete = report.missing > 0 && !began_late;
  if (has_keys) {
    const Discovered when = discovered(report.conversation, report.counting, report.limits);
    report.took = expense_of(report.conversation, report.counting, report.failure_free, when,
                             is_incomplete, channel);
    report.storm = exact::is_storm(report.took, report.limits);
    const auto& last_told_ns = report.counting.last_initial_ns;
    if (when.is_late(when.known_ns) && last_told_ns && !when.is_late(*last_told_ns)) {
      report.known_late_ns = when.known_ns - report.conversation.first_ns;
    }
    report.amplified = exact::is_amplified(
        static_cast<double>(report.messages() + report.counting.lookup_messages()) /
        static_cast<double>(std::max<std::uint64_t>(report.failure_free.total(), 1)));
  }
  const bool do_not_match = std::ranges::any_of(
      report.reasons, [](const Reason& one) { return one.id.starts_with("unequal_"); });
  if (report.what_keeps_apart() != nullptr) {
    report.health = Health::incomplete;
  } else if (topology.participants.size() < 2) {
    report.why_unknown = fmt::format("the capture shows {}; discovery takes two",
                                     report::plural(topology.participants.size(), "participant"));
  } else if (!has_keys) {
    report.why_unknown =
        "the capture shows participants and none of their endpoints: it began when "
        "they knew each other, or they never did";
  } else if (is_incomplete) {
    report.health = Health::incomplete;
  } else if (report.storm) {
    report.health = Health::storm;
  } else if (began_late) {
    report.why_unknown = late->sentence;
  } else {
    report.health = do_not_match ? Health::unmatched : Health::healthy;
  }
}

}  // namespace

const char* name_of(Health health) {
  switch (health) {
    case Health::healthy:
      return "healthy";
    case Health::storm:
      return "storm";
    case Health::incomplete:
      return "incomplete";
    case Health::unmatched:
      return "unmatched";
    case Health::unknown:
      return "unknown";
  }
  return "";
}

const Reason* Report::what_keeps_apart() const {
  const auto found = std::ranges::find_if(
      reasons, [](const Reason& one) { return one.keeps_apart && one.probability >= 0.5; });
  return found == reasons.end() ? nullptr : &*found;
}

Report examine(const Conversation& conversation, std::int64_t until_ns,
               const model::WirelessProfile* channel, const model::Limits& limits) {
  Report report{conversation};
  report.limits = limits;
  report.counting = capture::count(conversation, until_ns);
  const capture::Counting& counting = report.counting;
  report.products = products_of(conversation.topology);
  report.failure_free = failure_free(conversation.topology, counting);
  report.later_announcements = announcements_after(conversation, counting);
  report.known_before = known_before(conversation, counting);
  report.there_before = there_before(conversation);
  report.missing = counting.missing_count - report.known_before;
  if (counting.last_initial_ns) {
    report.completion_ns = *counting.last_initial_ns - conversation.first_ns;
  }
  report.has_server = conversation.topology.has_server();
  report.lookups_prevail = counting.lookup_messages() > report.messages();
  report.types = capture::unknown_types(conversation.topology);
  report.machines = one_machines(conversation.topology);
  report.reasons = reasons(Contacts{conversation, counting});
  judge(report, channel);
  report.causes = causes(conversation, counting, report.failure_free);
  report.heard = who_heard_whom(conversation);
  report.no_advice = "it was not asked for";
  return report;
}

Result<Report> diagnose(const Conversation& conversation, const Request& request) {
  std::optional<model::WirelessProfile> channel;
  if (!request.wireless.empty()) {
    auto named = model::config::read_wireless_profile(request.wireless, {},
                                                      model::config::SpecPath::standard());
    if (!named) return named.error();
    channel = *std::move(named);
  }
  Report report =
      examine(conversation, request.until_ns, channel ? &*channel : nullptr, request.limits);
  if (report.products.empty()) return report;
  const std::vector<std::string> profiles = profiles_of(report.products.front());
  find_presets(profiles, request, report);
  if (report.health == Health::healthy && !report.amplified) {
    report.no_advice = "nothing has to change";
  } else if (report.what_keeps_apart() != nullptr || report.health == Health::unmatched) {
    report.no_advice = "no setting of discovery helps against this";
  } else if (report.health == Health::unknown) {
    report.no_advice = report.why_unknown;
  } else if (report.counting.required == 0) {
    report.no_advice = "nothing can be predicted of hosts that send each other nothing";
  } else if (report.lookups_prevail) {
    if (request.advise) switch_lookups_off(profiles, request, report);
    report.no_advice = "what prevails are lookups of types; capture again without them";
  } else if (report.has_server) {
    report.no_advice = "captures with a Discovery Server are not tuned yet; validate predicts them";
  } else if (request.advise) {
    report.no_advice.clear();
    if (auto error = advise(profiles, request, report)) return *std::move(error);
  }
  return report;
}

}  // namespace stormproof::doctor
