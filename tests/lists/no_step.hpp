// The World<float> of own_world.hpp takes no step: it has no kernels.
// SPDX-License-Identifier: MIT
#pragma once

#include "own_world.hpp"

namespace isostep {
template <> const BodyKernels<float>* body_kernels<float>(Simd) { return nullptr; }
template <> const ContactKernels<float>* contact_kernels<float>(Simd) { return nullptr; }
template <> const PairKernels<float>* pair_kernels<float>(Simd) { return nullptr; }
template <> const TreeKernels<float>* tree_kernels<float>(Simd) { return nullptr; }
}  // namespace isostep
