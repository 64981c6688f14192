// Laws about one run: whoever watches it says whether it is as it should be, in a run of its own up
// to the time limit, because what follows discovery shows more, or beside others who watch the same
// one.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "model/trace/replay.hpp"
#include "props/laws/law.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::props {

template <class Watch>
[[nodiscard]] std::unique_ptr<Monitor> watched_by(const model::Scenario& scenario) {
  return attentive<Watch>(scenario);
}

template <class Watch>
[[nodiscard]] std::optional<std::string> observed(const model::Scenario& scenario,
                                                  const Simulate& simulate) {
  model::Scenario whole = scenario;
  whole.run_until = model::RunUntil::time_limit;
  const auto watch = watched_by<Watch>(whole);
  watch->finish(model::trace::known_until(simulate(whole, watch.get()), whole));
  if (!watch->violation()) return std::nullopt;
  return watch->violation()->reason;
}

template <class Watch>
[[nodiscard]] constexpr Law watched_law(std::string_view id, std::string_view statement,
                                        bool (*applies)(const model::Scenario&)) {
  return {id, statement, applies, observed<Watch>, watched_by<Watch>};
}

}  // namespace stormproof::props
