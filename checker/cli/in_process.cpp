// One frame for each command: requests live as long as it does.
#include "checker/cli/in_process.hpp"

#include <mutex>
#include <utility>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/cli/streams.hpp"

namespace stormproof::cli {

Reply reply_to(std::vector<std::string> words) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock{one_at_a_time};
  Diversion diversion;
  Frame frame{Process::shared};
  declare_commands(frame);
  Reply reply;
  reply.exit_code = frame.run(std::move(words));
  reply.printed = std::move(diversion.printed);
  reply.said = std::move(diversion.said);
  return reply;
}

void interrupt_command() { InterruptGuard::interrupt(); }

}  // namespace stormproof::cli
