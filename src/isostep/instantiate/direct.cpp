// The direct solver for every shipped scalar, and its systems for the two numbers that those are written in.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/direct.inl"

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solvers/direct_system.inl"

namespace isostep {

template class DirectSystem<Exact<double>>;
template class DirectSystem<Fixed<std::int64_t, 62>>;

#define ISO_INSTANTIATE(S) template class DirectSolver<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
