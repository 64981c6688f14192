// The order of the help.
#include "checker/cli/commands.hpp"

namespace stormproof::cli {

void declare_commands(Frame& frame) {
  declare_init(frame);
  declare_simulate(frame);
  declare_check(frame);
  declare_fix(frame);
  declare_diff(frame);
  declare_compare_discovery(frame);
  declare_launch(frame);
  declare_survive(frame);
  declare_fuzz(frame);
  declare_sensitivity(frame);
  declare_sweep(frame);
  declare_tune(frame);
  declare_reproduce(frame);
  declare_coverage(frame);
  declare_doctor(frame);
  declare_watch(frame);
  declare_capture(frame);
  declare_annotate(frame);
  declare_conform(frame);
  declare_validate(frame);
  declare_properties(frame);
  declare_profile(frame);
  declare_replay(frame);
  declare_draw(frame);
  declare_mutate(frame);
  declare_museum(frame);
  declare_list(frame);
  declare_help(frame);
}

}  // namespace stormproof::cli
