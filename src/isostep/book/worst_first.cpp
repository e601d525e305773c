// The worst-first resolver of rigid bodies for the shipped scalars.
// SPDX-License-Identifier: MIT
#include "isostep/book/worst_first.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) template class WorstFirstResolver<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
