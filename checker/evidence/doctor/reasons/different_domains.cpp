// Participants of different domains do not discover each other: another domain has other ports.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/evidence/doctor/reasons/ports.hpp"
#include "checker/evidence/doctor/reasons/reasons.hpp"

namespace stormproof::doctor {

namespace {

std::set<std::uint32_t> domains_of(const Contacts& contacts, std::size_t host) {
  std::set<std::uint32_t> domains;
  for (const std::size_t k : contacts.hosts()[host]) {
    domains.insert(contacts.of(k).domains.begin(), contacts.of(k).domains.end());
  }
  return domains;
}

}  // namespace

void different_domains(const Contacts& contacts, std::vector<Reason>& found) {
  std::map<std::uint32_t, std::set<std::size_t>> hosts;  // by domain
  std::set<std::size_t> with_others;
  for (std::size_t h = 0; h < contacts.hosts().size(); ++h) {
    for (const std::uint32_t domain : domains_of(contacts, h)) hosts[domain].insert(h);
  }
  if (hosts.size() < 2) return;
  for (const auto& [domain, some] : hosts) {
    if (some.size() > 1) with_others.insert(some.begin(), some.end());
  }
  std::vector<std::string> texts;
  bool is_alone = false;
  for (std::size_t h = 0; h < contacts.hosts().size(); ++h) {
    const auto domains = domains_of(contacts, h);
    if (domains.empty()) continue;
    is_alone = is_alone || !with_others.contains(h);
    texts.push_back(
        fmt::format("{} is in domain {}", contacts.host_text(h), fmt::join(domains, ", ")));
  }
  const bool some_alone =
      std::ranges::any_of(hosts, [](const auto& entry) { return entry.second.size() == 1; });
  if (texts.size() < 2 || !some_alone) return;
  constexpr double if_on_purpose = 0.3;
  constexpr std::size_t most = 8;
  const std::size_t more = texts.size() > most ? texts.size() - most : 0;
  texts.resize(std::min(texts.size(), most));
  found.push_back(
      {"domains",
       fmt::format("{}{}: participants of different domains do not hear each other "
                   "(domain d announces itself on port {} + {} d)",
                   fmt::join(texts, "; "), more > 0 ? fmt::format("; and {} more hosts", more) : "",
                   first_port, ports_of_domain),
       is_alone ? 1 : if_on_purpose,
       "the same ROS_DOMAIN_ID (or domain of the vendor's file) for all that shall see "
       "each other"});
}

}  // namespace stormproof::doctor
