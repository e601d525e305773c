// World<S> for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/world/world.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) template class World<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

const char* fault_text(Fault fault) {
  switch (fault) {
    case Fault::none: return "no fault";
    case Fault::stale_id: return "the id names nothing";
    case Fault::not_finite: return "a number is not finite";
    case Fault::out_of_range: return "a number is beyond the scalar's limits";
    case Fault::bad_shape: return "the sizes, normals or parts make no shape";
    case Fault::bad_mass: return "no body can have this mass or inertia";
    case Fault::bad_argument: return "a flag, count, ratio or enumerator is not one";
    case Fault::shape_in_use: return "bodies still name the shape";
    case Fault::not_dynamic: return "no force moves this body";
  }
  return "unknown fault";
}

}  // namespace isostep
