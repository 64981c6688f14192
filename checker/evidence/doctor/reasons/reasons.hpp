// The reasons that a capture shows, in the order in which they are decided: what keeps everybody
// apart comes before what concerns some, and what is certain before what is likely. Each is a file
// of its own; this is the one table of them.
#pragma once

#include <vector>

#include "checker/evidence/doctor/reasons/contacts.hpp"
#include "checker/evidence/doctor/reasons/reason.hpp"

namespace stormproof::doctor {

[[nodiscard]] std::vector<Reason> reasons(const Contacts& contacts);

// The rows of the table. Each adds what it finds.
void different_domains(const Contacts& contacts, std::vector<Reason>& found);
void one_host_is_heard(const Contacts& contacts, std::vector<Reason>& found);
void same_machine_id(const Contacts& contacts, std::vector<Reason>& found);
void no_answers(const Contacts& contacts, std::vector<Reason>& found);
void unreachable_addresses(const Contacts& contacts, std::vector<Reason>& found);
void local_host_only(const Contacts& contacts, std::vector<Reason>& found);
void different_products(const Contacts& contacts, std::vector<Reason>& found);
void unequal_qos(const Contacts& contacts, std::vector<Reason>& found);
void ports_of_peers(const Contacts& contacts, std::vector<Reason>& found);
void no_number_is_left(const Contacts& contacts, std::vector<Reason>& found);
void old_identity(const Contacts& contacts, std::vector<Reason>& found);
void network_failed(const Contacts& contacts, std::vector<Reason>& found);
void went_away(const Contacts& contacts, std::vector<Reason>& found);
void began_late(const Contacts& contacts, std::vector<Reason>& found);

}  // namespace stormproof::doctor
