// What faults mean, in words.
// SPDX-License-Identifier: MIT
#include "isostep/core/fault.hpp"

namespace isostep {

const char* fault_text(Fault fault) {
  switch (fault) {
    case Fault::none: return "no fault";
    case Fault::stale_id: return "the id names nothing";
    case Fault::not_finite: return "a number is not finite";
    case Fault::out_of_range: return "a number is beyond the scalar's limits";
    case Fault::bad_shape: return "the sizes, normals or parts make no shape";
    case Fault::bad_mass: return "nothing can have this mass or inertia";
    case Fault::bad_argument: return "a flag, count, ratio or enumerator is not one";
    case Fault::shape_in_use: return "something still names it";
    case Fault::not_dynamic: return "no force moves it";
  }
  return "unknown fault";
}

}  // namespace isostep
