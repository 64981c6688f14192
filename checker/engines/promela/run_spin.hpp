// Runs SPIN on a model as programs of their own: spin writes a verifier, the C compiler builds it,
// and it runs once for each claim of the model and once for deadlocks, up to the first error. No
// shell takes part.
#pragma once

#include <cstdint>
#include <string>

#include "model/config/tree/result.hpp"

namespace stormproof::promela {

/// What the verifier found over all its runs.
struct SpinRun {
  bool ok = false;           ///< every run was exhaustive and found no error
  std::uint64_t states = 0;  ///< stored states, summed over the runs
  double seconds = 0;        ///< time of the runs, without generation and compilation
  std::string error;         ///< the first claim that fails and how, if not ok
};

/// Whether both spin and a C compiler (gcc) are on PATH.
[[nodiscard]] bool spin_is_available();

/// Verifies the model `promela`. Files are written to `folder`, which must exist: the model
/// (model.pml), the verifier, what each program printed, and a trail for an error. The error of the
/// result says which program is absent or failed; a violated claim is not an error of that kind.
/// A run that needs more than 4 GiB or 10 minutes ends unfinished: then `ok` is false.
[[nodiscard]] model::config::Result<SpinRun, std::string> run_spin(const std::string& promela,
                                                                   const std::string& folder);

}  // namespace stormproof::promela
