// The peers that this build knows and this machine has.
// SPDX-License-Identifier: MIT
#include "engine.hpp"

namespace isostep::bench {

std::vector<Maker> peer_makers() {
  std::vector<Maker> all;
#if defined(ISOSTEP_BENCH_NODE)
  all = node_makers();
#endif
#if defined(ISOSTEP_BENCH_BULLET)
  all.push_back({"bullet", false, make_bullet});
  all.push_back({"bullet-best", false, make_bullet_best});
#endif
#if defined(ISOSTEP_BENCH_ODE)
  all.push_back({"ode", false, make_ode});
  all.push_back({"ode-best", false, make_ode_best});
#endif
#if defined(ISOSTEP_BENCH_DART)
  all.push_back({"dart", false, make_dart});
#endif
  return all;
}

}  // namespace isostep::bench
