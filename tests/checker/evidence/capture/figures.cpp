// Counting by names.
#include "tests/checker/evidence/capture/figures.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <tuple>

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::capture::testing {

namespace {

/// Counts a dissection.
class TsharkCounter {
 public:
  explicit TsharkCounter(const Dissection& dissection) {
    for (const auto& [frame, one] : dissection) {
      for (const auto& submessage : one.submessages) {
        home_.emplace(submessage.source, one.from);
        // Whose address it is: learnt from datagrams with INFO_DST instead of SPDP.
        if (!submessage.destination.empty()) owner_[end_of(one)] = submessage.destination;
      }
    }
    for (const auto& [frame, one] : dissection) add(one);
  }
  [[nodiscard]] const Figures& figures() const { return figures_; }

 private:
  static std::string end_of(const DissectedDatagram& one) { return one.to + ":" + one.port; }

  void add(const DissectedDatagram& one) {
    ++figures_["datagrams"];
    figures_["frames"] += one.frames;
    figures_["wire bytes"] += one.wire_bytes;
    if (one.frames > 1) ++figures_["in fragments"];
    std::uint64_t data = 0;
    for (const DissectedSubmessage& submessage : one.submessages) {
      add_traffic(submessage);
      data += add_message(one, submessage, data > 0);
    }
    if (data > 0) ++figures_[std::to_string(data) + " SEDP DATA"];
  }

  void add_traffic(const DissectedSubmessage& one) {
    constexpr const char* kinds = "......AHG............DF";
    const unsigned kind = std::stoul(one.writer, nullptr, 16) & 0xffU;
    std::string traffic = (kind & 0xc0U) == 0xc0U ? "other" : "user";
    if (one.writer == "0x000200c2") traffic = "liveliness";
    if (one.writer == "0x000100c2") traffic = "spdp";
    if (one.writer == "0x000003c2" || one.writer == "0x000004c2") traffic = "sedp";
    ++figures_[traffic + " " + kinds[one.id]];
    figures_[traffic + " bytes"] += one.bytes;
    if (!one.destination.empty() && !one.is_user_data()) ++figures_["with INFO_DST"];
  }

  /// 1 if it is SEDP DATA that goes to another host.
  std::uint64_t add_message(const DissectedDatagram& datagram, const DissectedSubmessage& one,
                            bool is_behind_data) {
    const bool is_sedp = one.writer == "0x000003c2" || one.writer == "0x000004c2";
    if (one.writer == "0x000100c2" && one.id == 0x15) {
      ++figures_[datagram.is_multicast() ? "SPDP multicast" : "SPDP unicast"];
    }
    if (!is_sedp) return 0;
    std::string to = one.destination;
    if (to.empty()) to = datagram.is_multicast() ? "all" : owner_[end_of(datagram)];
    const auto host = home_.find(to);
    if (host != home_.end() && host->second == datagram.from) return 0;
    if (one.id == 0x15) {
      const bool is_new = keys_.insert({one.source, to, one.writer, one.numbers[0]}).second;
      ++figures_[is_new ? "initial DATA" : "repair DATA"];
      return 1;
    }
    if (one.id == 0x07) {
      ++figures_["HEARTBEAT"];
      if (is_behind_data) ++figures_["HEARTBEAT behind DATA"];
      if (one.numbers[1] < one.numbers[0]) ++figures_["empty HEARTBEAT"];
    }
    if (one.id == 0x06) add_acknack(one);
    return 0;
  }

  void add_acknack(const DissectedSubmessage& one) {
    ++figures_["ACKNACK"];
    const auto requested = static_cast<std::uint64_t>(std::ranges::count(one.bits, '1'));
    figures_["requested"] += requested;
    if (requested > 0) ++figures_["non-empty ACKNACK"];
    if (requested == 0) ++figures_[one.numbers[0] > 1 ? "positive ACKNACK" : "initial ACKNACK"];
  }

  std::map<std::string, std::string> home_;   ///< address of each GUID prefix
  std::map<std::string, std::string> owner_;  ///< GUID prefix at each address and port
  std::set<std::tuple<std::string, std::string, std::string, std::int64_t>> keys_;
  Figures figures_;
};

}  // namespace

Figures figures_of(const Conversation& conversation) {
  const Counting counting = count(conversation, std::numeric_limits<std::int64_t>::max());
  const AcknackFigures& acknacks = counting.acknacks;
  Figures figures{{"datagrams", counting.datagrams},
                  {"frames", counting.frames},
                  {"wire bytes", counting.wire_bytes},
                  {"SPDP multicast", counting.counts.spdp_multicast},
                  {"SPDP unicast", counting.counts.spdp_unicast},
                  {"initial DATA", counting.counts.initial_data},
                  {"repair DATA", counting.counts.repair_data},
                  {"HEARTBEAT", counting.counts.heartbeat},
                  {"HEARTBEAT behind DATA", counting.heartbeats.behind_data},
                  {"empty HEARTBEAT", counting.heartbeats.empty},
                  {"ACKNACK", counting.counts.acknack},
                  {"non-empty ACKNACK", acknacks.negative},
                  {"initial ACKNACK", acknacks.initial},
                  {"positive ACKNACK", acknacks.positive},
                  {"requested", acknacks.requested}};
  const std::array words{"spdp", "sedp", "liveliness", "other", "user"};
  for (std::size_t k = 0; k < words.size(); ++k) {
    const TrafficFigures& one = counting.traffic[k];
    const std::string word = words[k];
    figures[word + " D"] = one.data;
    figures[word + " F"] = one.data_frag;
    figures[word + " H"] = one.heartbeat;
    figures[word + " A"] = one.acknack;
    figures[word + " G"] = one.gap;
    figures[word + " bytes"] = one.bytes;
  }
  for (const auto& [data, datagrams] : counting.data_per_datagram) {
    figures[std::to_string(data) + " SEDP DATA"] = datagrams;
  }
  for (const DatagramRecord& one : conversation.datagrams) {
    if (one.frames > 1) ++figures["in fragments"];
  }
  for (const Event& event : conversation.events) {
    if (event.has_info_dst) ++figures["with INFO_DST"];
  }
  std::erase_if(figures, [](const auto& figure) { return figure.second == 0; });
  return figures;
}

Figures figures_of(const Dissection& dissection) {
  Figures figures = TsharkCounter{dissection}.figures();
  std::erase_if(figures, [](const auto& figure) { return figure.second == 0; });
  return figures;
}

}  // namespace stormproof::capture::testing
