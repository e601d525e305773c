// A program of the tests that includes this compiles World<float> from its copy of the headers. Its kernels are those
// of the library, which know nothing of records and commands. One that takes steps includes own_step.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#ifndef ISOSTEP_OWN_SCALARS
#error "define ISOSTEP_OWN_SCALARS before the first include"
#endif

#include "isostep/collision/broadphase/pairs.inl"
#include "isostep/collision/broadphase/tree.inl"
#include "isostep/dynamics/records/record_store.inl"
#include "isostep/geometry/mass_properties.inl"
#include "isostep/geometry/validate.inl"
#include "isostep/instantiate/contact_systems.inl"
#include "isostep/instantiate/event_systems.inl"
#include "isostep/instantiate/executing_commands.inl"
#include "isostep/instantiate/island_systems.inl"
#include "isostep/instantiate/motion_systems.inl"
#include "isostep/store/state_validator.inl"
#include "isostep/world/engine_step.inl"
#include "isostep/world/world.inl"

namespace isostep {
template <> const BodyKernels<float>* body_kernels<float>(Simd);
template <> const ContactKernels<float>* contact_kernels<float>(Simd);
template <> const PairKernels<float>* pair_kernels<float>(Simd);
template <> const TreeKernels<float>* tree_kernels<float>(Simd);
ISO_FOR_EACH_COMMAND(ISO_INSTANTIATE_EXECUTE, float)
ISO_BROKEN_RULE_OF(, float)
}  // namespace isostep
