// Messages over time.
#include "checker/evidence/capture/timeline.hpp"

#include <algorithm>

namespace stormproof::capture {

Timeline timeline(const Conversation& conversation, const Counting& counting, std::int64_t end_ns,
                  std::size_t steps) {
  const std::int64_t span = std::max<std::int64_t>(end_ns - conversation.first_ns, 0) + 1;
  const auto wanted = static_cast<std::int64_t>(std::max<std::size_t>(steps, 1));
  Timeline result;
  result.step_ns = (span + wanted - 1) / wanted;
  const std::int64_t needed = (span + result.step_ns - 1) / result.step_ns;
  result.steps.resize(static_cast<std::size_t>(needed));
  for (std::size_t k = 0; k < counting.classes.size(); ++k) {
    const std::optional<MessageClass> one = counting.classes[k];
    if (!one) continue;
    const std::int64_t since = conversation.events[k].time_ns - conversation.first_ns;
    ++result.steps[static_cast<std::size_t>(since / result.step_ns)][index_of(*one)];
  }
  return result;
}

}  // namespace stormproof::capture
