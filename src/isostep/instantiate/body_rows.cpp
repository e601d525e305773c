// The bodies that every solver moves, and how they bounce, for the shipped scalars.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/body_rows.inl"

#include "isostep/dynamics/solvers/impacts.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)       \
  template class EnergyBound<S>; \
  template class BodyRows<S>;    \
  template class Impacts<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
