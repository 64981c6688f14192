// The network between two hosts failed for a while, and came back. A capture at the senders has all
// that was sent meanwhile, so what shows it is what is not said: readers that had acknowledged
// everything and begin anew, since a lease ended; HEARTBEATs that nobody answers, until everybody
// does again. A capture at one place shows a host that is not heard, and then is again.
#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>

#include "checker/evidence/capture/relapses.hpp"
#include "checker/evidence/doctor/reasons/old_identity.hpp"
#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

namespace {

using capture::EntityId;
using capture::Event;

constexpr std::int64_t second_ns = 1'000'000'000;
/// HEARTBEATs each way that nobody answers before it is no chance.
constexpr std::uint64_t enough = 10;
/// Of one writer to one reader in a second: what timers send. With more, DATA is being sent, and
/// answers may wait behind it.
constexpr std::uint64_t of_timers = 2;

/// A time without answers, between two that were given.
struct Gap {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  std::array<std::uint64_t, 2> asked{};  ///< HEARTBEATs that want an answer, each way
  std::map<std::tuple<std::size_t, std::size_t, EntityId>, std::uint64_t> by_relation{};

  [[nodiscard]] std::int64_t length_ns() const { return to_ns - from_ns; }
  [[nodiscard]] bool is_outage() const {
    const auto most = of_timers * static_cast<std::uint64_t>(length_ns() / second_ns);
    return length_ns() >= 2 * second_ns && std::ranges::min(asked) >= enough &&
           std::ranges::all_of(by_relation, [most](const auto& one) { return one.second <= most; });
  }
};

/// What two hosts said to each other; the first has the smaller number.
struct Between {
  std::set<std::pair<std::size_t, std::size_t>> anew{};  ///< participants: who forgot whom
  std::int64_t last_before_ns = 0;                       ///< what they had said last before
  std::int64_t again_ns = 0;                             ///< when the last of them began anew
  std::array<std::uint64_t, 2> forgot{};                 ///< relations, by the host of who forgot
  bool was_answered = false;
  Gap now{};      ///< since the last answer
  Gap longest{};  ///< of those in which enough was asked
};

class Listener {
 public:
  explicit Listener(const Contacts& contacts) : contacts_{contacts} {
    for (const auto& [who, writer] : writer_lives(contacts)) {
      if (writer.is_back()) restarted_.insert(who.first);
    }
    for (std::size_t k = 0; k < contacts.counting().classes.size(); ++k) {
      add(contacts.conversation().events[k]);
    }
    for (const capture::Relapse& one : capture::relapses(contacts.conversation())) forgets(one);
  }

  [[nodiscard]] const std::map<std::pair<std::size_t, std::size_t>, Between>& pairs() const {
    return pairs_;
  }

 private:
  void add(const Event& event) {
    if (event.traffic() != capture::Traffic::sedp || !event.destination) return;
    const auto from = contacts_.number_of(event.source);
    const auto to = contacts_.number_of(*event.destination);
    if (!from || !to) return;
    const std::size_t here = contacts_.topology().participants[*from].host;
    const std::size_t there = contacts_.topology().participants[*to].host;
    if (here == there) return;
    Between& pair = pairs_[std::minmax(here, there)];
    const std::size_t side = here < there ? 0 : 1;
    if (event.acknack() != nullptr) {
      answer(pair, event.time_ns);
    } else if (const auto* heartbeat = event.heartbeat(); heartbeat && !heartbeat->is_final) {
      ++pair.now.asked[side];
      ++pair.now.by_relation[{*from, *to, event.writer}];
    }
  }

  static void answer(Between& pair, std::int64_t time_ns) {
    pair.now.to_ns = time_ns;
    const bool is_longest = pair.now.length_ns() > pair.longest.length_ns();
    if (pair.was_answered && is_longest && pair.now.is_outage()) pair.longest = pair.now;
    pair.now = {time_ns, time_ns, {}, {}};
    pair.was_answered = true;
  }

  void forgets(const capture::Relapse& relapse) {
    const auto reader = contacts_.number_of(relapse.reader);
    const auto writer = contacts_.number_of(relapse.writer);
    if (!reader || !writer || restarted_.contains(*reader)) return;
    const std::size_t here = contacts_.topology().participants[*reader].host;
    const std::size_t there = contacts_.topology().participants[*writer].host;
    Between& pair = pairs_[std::minmax(here, there)];
    pair.anew.emplace(*reader, *writer);
    pair.last_before_ns = std::max(pair.last_before_ns, relapse.before_ns);
    pair.again_ns = std::max(pair.again_ns, relapse.again_ns);
    ++pair.forgot[here < there ? 0 : 1];
  }

  const Contacts& contacts_;
  std::set<std::size_t> restarted_;  ///< their readers are new ones, whatever the network does
  std::map<std::pair<std::size_t, std::size_t>, Between> pairs_;
};

std::string forgotten_text(const Contacts& contacts, std::size_t one, std::size_t other,
                           const Between& pair) {
  const std::string first = contacts.host_text(one);
  const std::string second = contacts.host_text(other);
  std::string who = fmt::format("participants of {} and {} forgot each other", first, second);
  if (pair.forgot[0] == 0 || pair.forgot[1] == 0) {
    const bool is_first = pair.forgot[0] > 0;
    who = fmt::format("participants of {} forgot those of {}, which kept them",
                      is_first ? first : second, is_first ? second : first);
  }
  return fmt::format(
      "{} ({}): they had said everything by {} and began anew until {}. A lease had ended, so "
      "nothing came through for about as long",
      who, report::plural(pair.anew.size(), "pair"), contacts.time_text(pair.last_before_ns),
      contacts.time_text(pair.again_ns));
}

void not_answered(const Contacts& contacts, const Listener& listener, std::vector<Reason>& found) {
  for (const auto& [hosts, pair] : listener.pairs()) {
    const std::string remedy =
        "look at the network of these hosts at that time: roaming, power save, an access point "
        "that "
        "restarts";
    if (!pair.anew.empty()) {
      found.push_back({"outage", forgotten_text(contacts, hosts.first, hosts.second, pair), 0.9,
                       remedy + "; with a longer lease nobody is forgotten meanwhile", false});
    } else if (pair.longest.length_ns() > 0) {
      found.push_back(
          {"outage",
           fmt::format("{} and {} did not answer each other from {} to {}, {} and {} HEARTBEATs "
                       "long, and did again afterwards: nothing came through",
                       contacts.host_text(hosts.first), contacts.host_text(hosts.second),
                       contacts.time_text(pair.longest.from_ns),
                       contacts.time_text(pair.longest.to_ns), pair.longest.asked[0],
                       pair.longest.asked[1]),
           0.8, remedy, false});
    }
  }
}

/// Hosts of which nothing was captured for a while, though others were.
void not_heard(const Contacts& contacts, std::vector<Reason>& found) {
  struct Silence {
    std::int64_t last_ns = INT64_MIN;
    std::int64_t from_ns = 0;
    std::int64_t to_ns = 0;
    std::uint64_t others = 0;            ///< events of others since it was heard last
    std::uint64_t others_meanwhile = 0;  ///< in the longest silence
  };
  std::vector<Silence> hosts(contacts.hosts().size());
  for (std::size_t k = 0; k < contacts.counting().classes.size(); ++k) {
    const Event& event = contacts.conversation().events[k];
    const auto from = contacts.number_of(event.source);
    if (!from) continue;
    const std::size_t here = contacts.topology().participants[*from].host;
    for (std::size_t h = 0; h < hosts.size(); ++h) {
      if (h != here) ++hosts[h].others;
    }
    Silence& own = hosts[here];
    if (own.last_ns != INT64_MIN && event.time_ns - own.last_ns > own.to_ns - own.from_ns) {
      own.from_ns = own.last_ns;
      own.to_ns = event.time_ns;
      own.others_meanwhile = own.others;
    }
    own.last_ns = event.time_ns;
    own.others = 0;
  }
  for (std::size_t h = 0; h < hosts.size(); ++h) {
    std::int64_t pause_ns = 0;
    for (const std::size_t k : contacts.hosts()[h]) {
      pause_ns = std::max(pause_ns, longest_pause_ns(contacts, k));
    }
    const Silence& own = hosts[h];
    if (own.to_ns - own.from_ns <= pause_ns || own.others_meanwhile < 3) continue;
    found.push_back(
        {"outage",
         fmt::format("nothing was heard of {} from {} to {}, longer than its "
                     "participants ever wait between two announcements, and then it was",
                     contacts.host_text(h), contacts.time_text(own.from_ns),
                     contacts.time_text(own.to_ns)),
         0.9, "look at its network at that time, or whether it was suspended", false});
  }
}

}  // namespace

void network_failed(const Contacts& contacts, std::vector<Reason>& found) {
  not_answered(contacts, Listener{contacts}, found);
  not_heard(contacts, found);
}

}  // namespace stormproof::doctor
