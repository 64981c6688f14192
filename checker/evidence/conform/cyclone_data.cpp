// DATA of a writer of Cyclone DDS: a sample goes to each reader once when it is created, and then
// at most as often as readers have asked for it. A request that is merged with a queued one makes
// that one go to all; requests of readers on the writer's own host are not in the capture.
#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/cyclone.hpp"
#include "checker/evidence/conform/senders.hpp"
#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform::cyclone {

namespace {

/// A copy of DATA: by unicast to one reader, or to the group.
struct Copy {
  const Submessage* submessage = nullptr;
  std::vector<std::size_t> receivers{};  ///< index in WriterRelations
};

class Data {
 public:
  Data(const Context& context, const WriterRelations& writer, Ledger& ledger)
      : context_{context}, writer_{writer}, ledger_{ledger} {}

  std::optional<Unexplained> explain() {
    std::map<std::size_t, Copy> copies;  // by event, and so by time
    for (std::size_t r = 0; r < writer_.relations.size(); ++r) {
      for (const Submessage& one : writer_.relations[r]->sent) {
        if (!one.descriptor) continue;
        copies[one.event].submessage = &one;
        copies[one.event].receivers.push_back(r);
      }
    }
    for (const auto& [event, copy] : copies) {
      if (auto fault = explain(copy)) return fault;
    }
    return std::nullopt;
  }

 private:
  std::optional<Unexplained> explain(const Copy& copy) {
    const Submessage& one = *copy.submessage;
    const std::uint32_t d = *one.descriptor;
    const bool is_named = context_.dialogue.conversation.events[one.event].has_info_dst;
    // A copy to the group is one for each reader.
    std::size_t times = 0;
    for (const std::size_t r : copy.receivers) times = std::max(times, ++times_[{r, d, is_named}]);
    std::size_t own = 0;
    std::size_t all = 0;
    for (std::size_t r = 0; r < writer_.relations.size(); ++r) {
      const std::size_t requests = requests_of(r, d, one.time_ns);
      all += requests;
      if (r == copy.receivers.front()) own = requests;
    }
    return is_named ? to_one(copy, times, own) : to_all(copy, times, all);
  }

  /// By name, because this reader asked for it.
  std::optional<Unexplained> to_one(const Copy& copy, std::size_t times, std::size_t requests) {
    if (times > requests) {
      return without_cause(copy, times,
                           fmt::format("its reader has asked for it {} times until "
                                       "then",
                                       requests));
    }
    ledger_.explained(times == 1 ? Rule::data_pull : Rule::data_repair, sends::cyclone::requested);
    return std::nullopt;
  }

  /// When it is created; after that only as a retransmission that was queued for somebody else.
  std::optional<Unexplained> to_all(const Copy& copy, std::size_t times, std::size_t requests) {
    const bool merges = context_.dds.sedp.merge_queued_rexmit == model::MergeQueued::yes;
    if (times == 1) {
      ledger_.explained(Rule::data_push, sends::cyclone::pushed);
    } else if (merges && times <= requests + 1) {
      ledger_.explained(Rule::data_merged, sends::cyclone::requested);
    } else if (merges && context_.dialogue.has_neighbour[writer_.place().source]) {
      ledger_.explained(Rule::data_same_host, Sender{});
    } else {
      return without_cause(
          copy, times,
          merges ? fmt::format("it goes to all once when it is created, and {} requests for it can "
                               "have arrived",
                               requests)
                 : "it goes to all once, when it is created");
    }
    return std::nullopt;
  }

  Unexplained without_cause(const Copy& copy, std::size_t times, std::string nearest) const {
    const Submessage& one = *copy.submessage;
    Unexplained result =
        unexplained_in(*writer_.relations[copy.receivers.front()], one.event, Fault::data_cause,
                       fmt::format("DATA of descriptor {}, transmission {} to this reader",
                                   *one.descriptor, times),
                       std::move(nearest), {});
    result.place = ledger_.place.place;
    return result;
  }

  /// How often the reader has asked for it, as far as that can have arrived.
  [[nodiscard]] std::size_t requests_of(std::size_t r, std::uint32_t d,
                                        std::int64_t time_ns) const {
    return context_.arrived(*writer_.relations[r], time_ns,
                            [&](const Answer& answer) { return answer.asks_for(d); });
  }

  const Context& context_;
  const WriterRelations& writer_;
  Ledger& ledger_;
  /// By reader, descriptor, and whether it names the reader.
  std::map<std::tuple<std::size_t, std::uint32_t, bool>, std::size_t> times_;
};

}  // namespace

std::optional<Unexplained> explain_data(const Context& context, const WriterRelations& writer,
                                        Ledger& ledger) {
  return Data{context, writer, ledger}.explain();
}

}  // namespace stormproof::conform::cyclone
