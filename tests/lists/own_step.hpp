// The World<float> of own_world.hpp takes steps: its systems are compiled here too, its kernels are those of the
// library, which know nothing of records and commands.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/instantiate/acting_records.inl"
#include "isostep/instantiate/world_queries.inl"
#include "isostep/world/engine_fields.inl"
#include "own_world.hpp"

namespace isostep {
template <> const BodyKernels<float>* body_kernels<float>(Simd);
template <> const ContactKernels<float>* contact_kernels<float>(Simd);
template <> const PairKernels<float>* pair_kernels<float>(Simd);
template <> const TreeKernels<float>* tree_kernels<float>(Simd);
}  // namespace isostep
