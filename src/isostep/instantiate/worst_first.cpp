// The worst-first resolver for the shipped scalars.
// SPDX-License-Identifier: MIT
#include "isostep/particles/solvers/worst_first.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) template class WorstFirst<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
