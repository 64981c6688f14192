// All laws, family by family.
#include <vector>

#include "props/laws/families.hpp"

namespace stormproof::props {

std::span<const Law> laws() {
  static const std::vector<Law> all = [] {
    std::vector<Law> list;
    for (const auto family : {repetition_laws, naming_laws, time_laws, byte_laws, workload_laws,
                              quiet_laws, obligation_laws, accounting_laws, causality_laws,
                              service_laws, bound_laws, adaptive_laws}) {
      const std::span<const Law> part = family();
      list.insert(list.end(), part.begin(), part.end());
    }
    return list;
  }();
  return all;
}

}  // namespace stormproof::props
