// `stormproof conform`: whether captures of real discovery are a behaviour of a DDS profile.
#pragma once

#include "checker/cli/command_line.hpp"

namespace stormproof::cli {

void declare_conform(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
