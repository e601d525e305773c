// The address that tells one thread from another.
// SPDX-License-Identifier: MIT
#include "isostep/core/one_at_a_time.hpp"

namespace isostep {

const void* this_thread() {
  static thread_local const char here = 0;
  return &here;
}

}  // namespace isostep
