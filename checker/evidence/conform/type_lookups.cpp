// Follows the samples of all TypeLookup writers in the order of their capture.
#include "checker/evidence/conform/type_lookups.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "checker/evidence/capture/type_lookup.hpp"

namespace stormproof::conform {

namespace {

using capture::Event;
using capture::GuidPrefix;
using capture::TypeHash;
using capture::TypeLookup;

struct Question {
  const TypeLookup* says = nullptr;
  std::size_t event = 0;
  std::optional<std::size_t> answer{};  ///< event
};

class Follower {
 public:
  explicit Follower(const Context& its) : its_{its} {}

  std::vector<Unexplained> run() {
    const auto& events = conversation().events;
    std::set<std::tuple<GuidPrefix, capture::EntityId, std::int64_t>> seen;
    for (std::size_t k = 0; k < events.size(); ++k) {
      const Event& event = events[k];
      if (event.time_ns > its_.dialogue.end_ns || event.is_same_host || event.data() == nullptr) {
        continue;
      }
      const std::tuple key{event.source, event.writer, event.data()->sequence_number};
      const auto lookup = conversation().lookups.find(key);
      if (lookup == conversation().lookups.end() || !seen.insert(key).second) continue;
      lookup->second.is_answer ? answer(k, lookup->second) : ask(k, lookup->second);
    }
    return std::move(faults_);
  }

 private:
  [[nodiscard]] const capture::Conversation& conversation() const {
    return its_.dialogue.conversation;
  }
  [[nodiscard]] const capture::Participant* find(const GuidPrefix& prefix) const {
    return conversation().topology.find(prefix);
  }
  /// Both are known, on two hosts: nothing between them is hidden.
  [[nodiscard]] bool are_apart(const GuidPrefix& a, const GuidPrefix& b) const {
    const capture::Participant* one = find(a);
    const capture::Participant* other = find(b);
    return one != nullptr && other != nullptr && one->host != other->host;
  }

  void ask(std::size_t k, const TypeLookup& says) {
    if (says.asker != conversation().events[k].source || !says.asked) return;
    for (const TypeHash& type : says.types) {
      says.is_about_dependencies ? ask_for_dependencies(k, says, type)
                                 : ask_for_type(k, says, type);
    }
    questions_[{says.asker, says.number}] = {&says, k, {}};
  }
  void ask_for_dependencies(std::size_t k, const TypeLookup& says, const TypeHash& type) {
    const std::int64_t time_ns = conversation().events[k].time_ns;
    const std::int64_t latest_ns = time_ns + its_.bounds.clock_error_ns;
    std::set<capture::EntityId> streams;  // on which others have it
    bool is_told = false;
    for (const capture::Participant& one : conversation().topology.participants) {
      for (const auto& [guid, endpoint] : one.endpoints) {
        if (endpoint.type_hash != type) continue;
        if (one.prefix != says.asker) {
          streams.insert(endpoint.announced_by);
          is_told = is_told || (one.prefix == *says.asked && endpoint.first_ns <= latest_ns);
        } else if (endpoint.first_ns < time_ns - its_.bounds.most_send_lag_ns) {
          return fault(k, "a question about a type of which the asker has announced an endpoint",
                       "who has created an endpoint knows its type");
        }
      }
    }
    if (are_apart(says.asker, *says.asked) && !is_told) {
      return fault(k, "a question about a type of which the asked has announced no endpoint",
                   "an endpoint's type is asked for when it has been announced");
    }
    const model::LookupUnit unit = its_.dds.version.typelookup_unit;
    const std::size_t most = unit == model::LookupUnit::type ? 1 : streams.size();
    if (++asked_[{says.asker, type}] > most && unit != model::LookupUnit::participant) {
      fault(k, "a question about a type that was asked for before",
            "a type is asked for once for each stream");
    }
  }
  void ask_for_type(std::size_t k, const TypeLookup& says, const TypeHash& type) {
    if (!are_apart(says.asker, *says.asked)) return;
    const bool is_due = std::ranges::any_of(questions_, [&](const auto& one) {
      const TypeLookup& before = *one.second.says;
      return before.asker == says.asker && before.asked == says.asked &&
             before.is_about_dependencies && std::ranges::count(before.types, type) > 0 &&
             one.second.answer;
    });
    if (is_due) return;
    fault(k, "a question about a type before its dependencies were answered",
          "a type is asked for when the answer about its dependencies has come");
  }
  void answer(std::size_t k, const TypeLookup& says) {
    const GuidPrefix& self = conversation().events[k].source;
    const auto found = questions_.find({says.asker, says.number});
    const bool fits = found != questions_.end() && found->second.says->asked == self &&
                      found->second.says->is_about_dependencies == says.is_about_dependencies;
    if (!fits) {
      if (!are_apart(self, says.asker)) return;
      return fault(k, "an answer about types that nobody has asked",
                   "an answer names the question that it is for");
    }
    if (found->second.answer) {
      return fault(k, "an answer to a question that has been answered",
                   "a question is answered once", *found->second.answer);
    }
    found->second.answer = k;
  }

  void fault(std::size_t k, std::string what, std::string nearest,
             std::optional<std::size_t> other = {}) {
    const Event& event = conversation().events[k];
    const auto& topology = conversation().topology;
    const capture::Participant* source = find(event.source);
    if (source == nullptr) return;
    const Place place{topology.index_of(*source), {}, event.writer};
    if (!faulty_.insert(place).second) return;
    std::vector<std::size_t> context{k};
    if (other) context.insert(context.begin(), *other);
    faults_.push_back({k,
                       Fault::lookup_cause,
                       place,
                       std::move(what),
                       std::move(nearest),
                       {{"a message that the capture does not show", {}, {}}},
                       std::move(context)});
  }

  const Context& its_;
  std::map<std::pair<GuidPrefix, std::int64_t>, Question> questions_{};
  std::map<std::pair<GuidPrefix, TypeHash>, std::size_t> asked_{};  ///< about dependencies
  std::set<Place> faulty_{};
  std::vector<Unexplained> faults_{};
};

}  // namespace

std::vector<Unexplained> faults_of_lookups(const Context& its) { return Follower{its}.run(); }

}  // namespace stormproof::conform
