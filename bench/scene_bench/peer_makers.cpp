// The peers that this build knows and this machine has.
// SPDX-License-Identifier: MIT
#include "engine.hpp"

namespace isostep::bench {

std::vector<Maker> peer_makers() {
  std::vector<Maker> all;
#if defined(ISOSTEP_BENCH_RAPIER)
  for (const Maker& maker : rapier_makers()) all.push_back(maker);
#endif
#if defined(ISOSTEP_BENCH_BULLET)
  all.push_back({"bullet", false, make_bullet});
#endif
#if defined(ISOSTEP_BENCH_ODE)
  all.push_back({"ode", false, make_ode});
#endif
  return all;
}

}  // namespace isostep::bench
