// A host has a port for each number of a participant. Cyclone DDS that takes numbers by itself has
// ten of them (MaxAutoParticipantIndex 9), and the next participant does not start.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/doctor/reasons/ports.hpp"
#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "model/implementations.hpp"

namespace stormproof::doctor {

void no_number_is_left(const Contacts& contacts, std::vector<Reason>& found) {
  constexpr std::uint32_t last_number = 9;
  constexpr double if_another_should_be_there = 0.5;
  const auto& list = contacts.topology().participants;
  for (std::size_t h = 0; h < contacts.hosts().size(); ++h) {
    std::set<std::uint32_t> numbers;
    for (const std::size_t k : contacts.hosts()[h]) {
      if (list[k].vendor != model::vendor::cyclonedds) continue;
      for (const capture::UdpEnd& locator : list[k].locators) {
        if (const auto number = participant_of_port(locator.port)) numbers.insert(*number);
      }
    }
    const bool all = numbers.size() == last_number + 1 && *numbers.rbegin() == last_number;
    if (!all) continue;
    found.push_back(
        {"participant_numbers",
         fmt::format("{} has participants on all of the {} ports that Cyclone DDS takes "
                     "by itself (numbers 0 to {}): one more does not start there",
                     contacts.host_text(h), last_number + 1, last_number),
         if_another_should_be_there,
         "a larger <MaxAutoParticipantIndex>, on all hosts, or fewer processes", false});
  }
}

}  // namespace stormproof::doctor
