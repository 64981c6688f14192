// One comment for each datagram; of several equal remarks it has one, with their number.
#include "checker/evidence/doctor/annotations.hpp"

#include <vector>

#include <fmt/format.h>

#include "checker/evidence/doctor/repairs.hpp"

namespace stormproof::doctor {

namespace {

using capture::HeartbeatKind;

const char* said_of(RepairKind kind) {
  switch (kind) {
    case RepairKind::acknowledged:
      return "needless_repairs, of DATA that the reader had acknowledged";
    case RepairKind::under_way:
      return "needless_repairs, of DATA that was still under way";
    case RepairKind::lost:
      return "loss, DATA again that was lost";
    case RepairKind::forgotten:
      return "forgotten, DATA again for a reader that begins anew";
  }
  return "";
}

/// Nothing of those that every discovery has.
const char* said_of(HeartbeatKind kind) {
  switch (kind) {
    case HeartbeatKind::directed_piggyback:
    case HeartbeatKind::fan_out_piggyback:
      return "piggyback, a HEARTBEAT because DATA was sent";
    case HeartbeatKind::fan_out_periodic:
    case HeartbeatKind::fan_out:
      return "heartbeat_timer, a HEARTBEAT because somebody has not acknowledged everything";
    case HeartbeatKind::relation_open:
    case HeartbeatKind::reply:
    case HeartbeatKind::directed:
      break;
  }
  return "";
}

}  // namespace

Annotations annotations(const capture::Conversation& conversation,
                        const capture::Counting& counting) {
  std::map<std::uint64_t, std::map<std::string, std::size_t>> remarks;  // with their number
  const auto add = [&](std::size_t position, const std::string& remark) {
    if (remark.empty()) return;
    const std::uint32_t datagram = conversation.events[position].datagram;
    ++remarks[conversation.datagrams[datagram].packet][remark];
  };
  const Repairs repairs = find_repairs(conversation, counting, counting.until_ns);
  for (const auto& [position, kind] : repairs.kinds) add(position, said_of(kind));
  for (const auto& [position, kind] : counting.kinds) {
    if (counting.classes[position]) add(position, said_of(kind));
  }
  for (std::size_t k = 0; k < counting.classes.size(); ++k) {
    if (conversation.events[k].traffic() == capture::Traffic::type_lookup) {
      add(k, "type_lookups, a question about a type, or its answer");
    }
  }
  Annotations comments;
  for (const auto& [packet, said] : remarks) {
    std::string& comment = comments[packet];
    for (const auto& [remark, count] : said) {
      comment += (comment.empty() ? "stormproof: " : "; ") + remark;
      if (count > 1) comment += fmt::format(" ({} times)", count);
    }
  }
  return comments;
}

}  // namespace stormproof::doctor
