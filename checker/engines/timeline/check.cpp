// Which property is decided by which function, and the border that no exception crosses.
#include <array>
#include <exception>

#include <fmt/core.h>
#include <z3++.h>

#include "checker/engines/timeline/findings.hpp"
#include "checker/engines/timeline/timeline.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::timeline {
namespace {

using Decide = props::Finding (*)(const Question&);

constexpr std::array<std::string_view, 4> ids{"live.completion", "live.quiescence",
                                              "storm.single-copy", "storm.free-threshold"};
constexpr std::array<Decide, 4> functions{completion_finding, quiescence_finding,
                                          single_copy_finding, free_threshold_finding};

props::Finding failed(const std::string& why) {
  props::Finding finding;
  finding.engine = "timelines";
  finding.how = "inconclusive: " + why;
  return finding;
}

props::Finding guarded(Decide decide, const Question& question) {
  try {
    return decide(question);
  } catch (const z3::exception& error) {
    return failed(std::string{"z3: "} + error.msg());
  } catch (const std::exception& error) {
    return failed(error.what());
  }
}

}  // namespace

void run_contradicts(props::Finding& finding, const checker::CheckRequest& request,
                     const std::string& why) {
  if (request.mutant == nullptr) {
    dispute(finding, why);
  } else {
    finding.kind = props::VerdictKind::violated;
  }
}

std::string measured_text(const exact::Measured& measured) {
  return fmt::format("in the run of this scenario the largest delay is {}, and {} packets are lost",
                     props::time_text(measured.largest_delay), measured.lost);
}

std::span<const std::string_view> decidable() { return ids; }

checker::Findings check(std::span<const std::string_view> properties,
                        const checker::CheckRequest& request) {
  checker::Findings findings;
  std::optional<exact::Measured> measured;
  for (const std::string_view property : properties) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      if (ids[k] != property) continue;
      if (request.on_progress && !request.on_progress(property)) return findings;
      if (!measured) measured = exact::measure(request.scenario, request);
      findings.emplace_back(ids[k], guarded(functions[k], {request, *measured}));
    }
  }
  return findings;
}

}  // namespace stormproof::timeline
