// The commands of the program. Each declares its options and says, below its help, what its exit
// codes mean.
#pragma once

namespace stormproof::cli {

class Frame;

void declare_simulate(Frame& frame);
void declare_check(Frame& frame);
void declare_diff(Frame& frame);
void declare_compare_discovery(Frame& frame);
void declare_launch(Frame& frame);
void declare_survive(Frame& frame);
void declare_fix(Frame& frame);
void declare_fuzz(Frame& frame);
void declare_sensitivity(Frame& frame);
void declare_sweep(Frame& frame);
void declare_tune(Frame& frame);
void declare_reproduce(Frame& frame);
void declare_coverage(Frame& frame);
void declare_init(Frame& frame);
void declare_doctor(Frame& frame);
void declare_watch(Frame& frame);
void declare_capture(Frame& frame);
void declare_annotate(Frame& frame);  ///< after the group `capture`
void declare_conform(Frame& frame);
void declare_validate(Frame& frame);
void declare_properties(Frame& frame);
void declare_profile(Frame& frame);
void declare_replay(Frame& frame);
void declare_draw(Frame& frame);
void declare_mutate(Frame& frame);
void declare_museum(Frame& frame);
void declare_list(Frame& frame);
void declare_help(Frame& frame);

/// All of them, in the order of the help.
void declare_commands(Frame& frame);

}  // namespace stormproof::cli
