// The checks, one function each.
#include "tests/live/report/judgement.hpp"

#include <fmt/core.h>

namespace stormproof::live {

namespace {

using Remarks = std::vector<std::string>;

void check_captures(const RunRecord& run, Remarks& remarks) {
  for (std::size_t host = 0; host < run.captures.size(); ++host) {
    const CaptureReport& capture = run.captures[host];
    if (capture.packets == 0) {
      remarks.push_back(fmt::format("the capture of host {} is empty", host));
    }
    if (capture.dropped != 0) {
      remarks.push_back(
          fmt::format("the capture of host {} lost {} packets", host, capture.dropped));
    }
    if (capture.interface_dropped != 0) {
      remarks.push_back(fmt::format("the interface of host {} dropped {} packets before the link",
                                    host, capture.interface_dropped));
    }
  }
}

void note_socket_drops(const RunRecord& run, std::vector<std::string>& notes) {
  for (std::size_t host = 0; host < run.captures.size(); ++host) {
    if (run.captures[host].socket_dropped == 0) continue;
    notes.push_back(fmt::format("{} datagrams that arrived at host {} found a full socket buffer",
                                run.captures[host].socket_dropped, host));
  }
}

void check_data(const RunRecord& run, Remarks& remarks) {
  const std::int64_t expected = run.expected_initial();
  if (run.counts.initial_data != expected && !run.sedp_multicast) {
    remarks.push_back(
        fmt::format("{} initial DATA were sent; expected {}{}", run.counts.initial_data,
                    run.has_server() ? "" : "N_H·(N_H−1)·N_P²·(17+N_E) = ", expected));
  }
  // With a server only what somebody needs is required.
  if (!run.has_server() && run.required_keys != expected) {
    remarks.push_back(fmt::format("the captured topology requires {} descriptor keys; expected {}",
                                  run.required_keys, expected));
  }
  if (run.missing_keys != 0) {
    remarks.push_back(fmt::format("{} required descriptor keys were not sent", run.missing_keys));
  }
}

void check_conformance(const RunRecord& run, Remarks& remarks) {
  if (run.conformance == "does_not_conform") {
    remarks.push_back("the captures are no behaviour of the profile: conformance.txt says why");
  }
}

void check_topology(const RunRecord& run, Remarks& remarks) {
  const auto expected = static_cast<std::size_t>(run.hosts * run.participants_per_host);
  if (run.captured.size() != expected) {
    remarks.push_back(
        fmt::format("{} participants were captured; expected {}", run.captured.size(), expected));
  }
  const std::int64_t publications = 9 + (run.endpoints_per_participant + 1) / 2;
  const std::int64_t subscriptions = 8 + run.endpoints_per_participant / 2;
  for (std::size_t index = 0; index < run.captured.size(); ++index) {
    const CapturedParticipant& participant = run.captured[index];
    if (participant.publications != publications || participant.subscriptions != subscriptions) {
      remarks.push_back(fmt::format(
          "captured participant {} has {} publications and {} subscriptions; expected {} and {}",
          index, participant.publications, participant.subscriptions, publications, subscriptions));
    }
  }
}

void name_the_incomplete(const RunRecord& run, Remarks& remarks) {
  std::size_t complete = 0;
  for (const ParticipantReport& participant : run.participants) {
    if (participant.is_complete()) ++complete;
  }
  remarks.push_back(fmt::format("{} of {} participants were complete after {:.3f} s", complete,
                                run.hosts * run.participants_per_host,
                                static_cast<double>(run.waited_ns) * 1e-9));
  for (const ParticipantReport& participant : run.participants) {
    if (participant.is_complete()) continue;
    if (participant.matches == participant.matches_expected &&
        participant.discovered == participant.discovered_expected) {
      remarks.push_back("one had everything, but too late");
      continue;
    }
    remarks.push_back(fmt::format("one had {} of {} matches and {} of {} endpoints",
                                  participant.matches, participant.matches_expected,
                                  participant.discovered, participant.discovered_expected));
  }
}

}  // namespace

Judgement judge(const RunRecord& run) {
  Judgement judgement;
  note_socket_drops(run, judgement.notes);
  check_captures(run, judgement.remarks);
  if (!run.is_complete()) {
    name_the_incomplete(run, judgement.remarks);
    judgement.outcome = Outcome::incomplete;
    return judgement;
  }
  check_data(run, judgement.remarks);
  // What goes through a server of the same host is in no capture.
  if (!run.has_server()) check_topology(run, judgement.remarks);
  check_conformance(run, judgement.remarks);
  if (!judgement.remarks.empty()) judgement.outcome = Outcome::check_failed;
  return judgement;
}

}  // namespace stormproof::live
