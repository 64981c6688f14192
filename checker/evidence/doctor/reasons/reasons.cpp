// The table.
#include "checker/evidence/doctor/reasons/reasons.hpp"

#include <array>

namespace stormproof::doctor {

namespace {

using Row = void (*)(const Contacts&, std::vector<Reason>&);
constexpr std::array<Row, 14> rows{
    different_domains, one_host_is_heard,  same_machine_id, no_answers,     unreachable_addresses,
    local_host_only,   different_products, unequal_qos,     ports_of_peers, no_number_is_left,
    old_identity,      network_failed,     went_away,       began_late};

}  // namespace

std::vector<Reason> reasons(const Contacts& contacts) {
  std::vector<Reason> found;
  for (const Row row : rows) row(contacts, found);
  return found;
}

}  // namespace stormproof::doctor
