// The bodies that every solver moves, for the shipped scalars.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/body_rows.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) template class BodyRows<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
