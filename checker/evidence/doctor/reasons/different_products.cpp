// Libraries of several vendors or versions. They discover each other by the standard; where some
// do not, this may be why.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

void different_products(const Contacts& contacts, std::vector<Reason>& found) {
  const auto& list = contacts.topology().participants;
  const auto name_of = [](const capture::Participant& one) {
    const std::string vendor = capture::vendor_name(one.vendor);
    return one.version.empty() ? vendor : vendor + " " + one.version;
  };
  std::map<std::string, std::size_t> products;
  std::set<capture::VendorId> vendors;
  for (const capture::Participant& one : list) {
    ++products[name_of(one)];
    vendors.insert(one.vendor);
  }
  if (products.size() < 2) return;
  // Only where descriptors are missing, and only between products.
  std::uint64_t between = 0;
  std::uint64_t within = 0;
  for (const capture::MissingKey& key : contacts.counting().missing) {
    const capture::Participant* from = contacts.topology().find(key.source);
    const capture::Participant* to = contacts.topology().find(key.destination);
    if (from == nullptr || to == nullptr) continue;
    (name_of(*from) == name_of(*to) ? within : between) += 1;
  }
  if (between == 0) return;
  std::vector<std::string> texts;
  for (const auto& [name, participants] : products) {
    texts.push_back(fmt::format("{} ({})", name, report::plural(participants, "participant")));
  }
  constexpr double alone = 0.7;
  constexpr double among_others = 0.3;
  found.push_back(
      {"products",
       fmt::format("{} take part: {}. {} are missing between them, {} within one of them",
                   vendors.size() > 1 ? "several vendors" : "several versions",
                   fmt::join(texts, ", "), report::plural(between, "descriptor"), within),
       within == 0 ? alone : among_others,
       "one RMW_IMPLEMENTATION and one ROS distribution for all; ROS supports no mixture of them"});
}

}  // namespace stormproof::doctor
