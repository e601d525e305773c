// The engine for a scalar of one's own: a file of a program includes this and says ISO_INSTANTIATE_ENGINE(the scalar).
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/instantiate.inl"
#include "isostep/collision/continuous/plane_impact.inl"
#include "isostep/collision/continuous/shape_impact.inl"
#include "isostep/collision/continuous/time_of_impact.inl"
#include "isostep/collision/narrowphase/collide.inl"
#include "isostep/collision/narrowphase/epa.inl"
#include "isostep/collision/narrowphase/gjk.inl"
#include "isostep/collision/narrowphase/pair_scalar.inl"
#include "isostep/collision/narrowphase/polyhedra.inl"
#include "isostep/collision/narrowphase/round_polyhedron.inl"
#include "isostep/collision/query/closest_point.inl"
#include "isostep/collision/query/ray_cast.inl"
#include "isostep/collision/query/shape_cast.inl"
#include "isostep/collision/query/solid_cast.inl"
#include "isostep/draw/debug_draw.inl"
#include "isostep/dynamics/joints/joint_alone.inl"
#include "isostep/dynamics/joints/joint_tree.inl"
#include "isostep/dynamics/joints/tree_kernel.inl"
#include "isostep/dynamics/records/record_store.inl"
#include "isostep/dynamics/solvers/body_kernel.inl"
#include "isostep/dynamics/solvers/contact_kernel.inl"
#include "isostep/dynamics/solvers/island_solver.inl"
#include "isostep/geometry/baked/hull_content.inl"
#include "isostep/geometry/baked/polyhedron.inl"
#include "isostep/geometry/baked/polyhedron_surface.inl"
#include "isostep/geometry/baked/rounded_polyhedron.inl"
#include "isostep/geometry/mass_properties.inl"
#include "isostep/geometry/mass_tensor.inl"
#include "isostep/geometry/submersion.inl"
#include "isostep/geometry/validate.inl"
#include "isostep/instantiate/acting_records.inl"
#include "isostep/instantiate/contact_systems.inl"
#include "isostep/instantiate/event_systems.inl"
#include "isostep/instantiate/executing_commands.inl"
#include "isostep/instantiate/island_systems.inl"
#include "isostep/instantiate/motion_systems.inl"
#include "isostep/instantiate/world_queries.inl"
#include "isostep/math/instantiate.inl"
#include "isostep/particles/instantiate.inl"
#include "isostep/scalar/math.inl"
#include "isostep/store/chosen_broad_phase.inl"
#include "isostep/store/state_validator.inl"
#include "isostep/world/engine_fields.inl"
#include "isostep/world/engine_step.inl"
#include "isostep/world/resimulation/step_memory.inl"
#include "isostep/world/world.inl"
#if !defined(ISOSTEP_NO_BOOK)
#include "isostep/book/instantiate.inl"
#endif

/// World<S>, ParticleWorld<S> and what the public headers beneath them declare, for an S = Fixed<Rep, FracBits> that is
/// not a shipped one.
/// One file a scalar; isostep_add_scalar in CMake writes such a file and gives it the flags that exactness needs.
/// Contacts are solved by the kernels of one lane: wider ones need files with flags of their own. Functions of Unit<S>
/// are in the library.
#define ISO_INSTANTIATE_ENGINE(...)                                                                 \
  namespace isostep {                                                                               \
  using OwnScalar = __VA_ARGS__;                                                                    \
  static_assert(Scalar<OwnScalar> && kIsFixed<OwnScalar>, "the engine needs a fixed-point format"); \
  ISO_SCALAR_MATH_OF(, OwnScalar)                                                                   \
  ISO_SCALAR_MATH_BETWEEN(, OwnScalar)                                                              \
  ISO_MATH_OF(, OwnScalar)                                                                          \
  ISO_HULL_CONTENT_OF(, OwnScalar)                                                                  \
  ISO_CONTENT_OF(, OwnScalar)                                                                       \
  ISO_MASS_PROPERTIES_OF(, OwnScalar)                                                               \
  ISO_MASS_TENSOR_OF(, OwnScalar)                                                                   \
  ISO_SUBMERSION_OF(, OwnScalar)                                                                    \
  ISO_VALIDATE_OF(, OwnScalar)                                                                      \
  ISO_COLLIDE_OF(, OwnScalar)                                                                       \
  ISO_HULL_PAIRS_OF(, OwnScalar)                                                                    \
  ISO_SURFACE_PAIRS_OF(, OwnScalar)                                                                 \
  ISO_SURFACE_QUERIES_OF(, OwnScalar)                                                               \
  ISO_ROUND_TRIANGLE_OF(, OwnScalar)                                                                \
  ISO_POLYHEDRON_TRIANGLE_OF(, OwnScalar)                                                           \
  ISO_RAY_CAST_OF(, OwnScalar)                                                                      \
  ISO_SOLID_CAST_OF(, OwnScalar)                                                                    \
  ISO_CLOSEST_POINT_OF(, OwnScalar)                                                                 \
  ISO_HULL_SOLID_OF(, OwnScalar)                                                                    \
  ISO_POLYHEDRON_SURFACE_OF(, OwnScalar)                                                            \
  ISO_ROUNDED_POLYHEDRON_OF(, OwnScalar)                                                            \
  ISO_POLYHEDRA_OF(, OwnScalar)                                                                     \
  ISO_ROUNDED_POLYHEDRA_OF(, OwnScalar)                                                             \
  ISO_SOLID_PAIRS_OF(, OwnScalar)                                                                   \
  ISO_SOLID_TRIANGLE_OF(, OwnScalar)                                                                \
  ISO_GJK_OF(, OwnScalar)                                                                           \
  ISO_ROUND_POLYHEDRON_OF(, OwnScalar)                                                              \
  ISO_EPA_OF(, OwnScalar)                                                                           \
  ISO_SHAPE_CAST_OF(, OwnScalar)                                                                    \
  ISO_TIME_OF_IMPACT_OF(, OwnScalar)                                                                \
  ISO_PLANE_IMPACT_OF(, OwnScalar)                                                                  \
  ISO_SHAPE_IMPACT_OF(, OwnScalar)                                                                  \
  ISO_BOX_TREES_OF(OwnScalar)                                                                       \
  ISO_CHOSEN_BROAD_PHASE_OF(, OwnScalar)                                                            \
  ISO_DECLARE_CONTACT_KERNELS(OwnScalar)                                                            \
  ISO_DEFINE_SCALAR_CONTACT_KERNELS(OwnScalar)                                                      \
  template <> const ContactKernels<OwnScalar>* contact_kernels<OwnScalar>(Simd simd) {              \
    const bool here = simd == Simd::best || simd == Simd::scalar;                                   \
    return here ? detail::kernel_table<ContactKernels<OwnScalar>, Simd::scalar>() : nullptr;        \
  }                                                                                                 \
  ISO_DECLARE_BODY_KERNELS(OwnScalar)                                                               \
  ISO_DEFINE_SCALAR_BODY_KERNELS(OwnScalar)                                                         \
  template <> const BodyKernels<OwnScalar>* body_kernels<OwnScalar>(Simd) {                         \
    return detail::kernel_table<BodyKernels<OwnScalar>, Simd::scalar>();                            \
  }                                                                                                 \
  ISO_DECLARE_PAIR_KERNELS(OwnScalar)                                                               \
  ISO_DEFINE_SCALAR_PAIR_KERNELS(OwnScalar)                                                         \
  template <> const PairKernels<OwnScalar>* pair_kernels<OwnScalar>(Simd) {                         \
    return detail::kernel_table<PairKernels<OwnScalar>, Simd::scalar>();                            \
  }                                                                                                 \
  ISO_DECLARE_TREE_KERNELS(OwnScalar)                                                               \
  ISO_DEFINE_SCALAR_TREE_KERNELS(OwnScalar)                                                         \
  template <> const TreeKernels<OwnScalar>* tree_kernels<OwnScalar>(Simd simd) {                    \
    const bool here = simd == Simd::best || simd == Simd::scalar;                                   \
    return here ? detail::kernel_table<TreeKernels<OwnScalar>, Simd::scalar>() : nullptr;           \
  }                                                                                                 \
  template class JointTrees<OwnScalar>;                                                             \
  ISO_IF_BOOK(ISO_BOOK_OF(OwnScalar))                                                               \
  template class IslandSolver<OwnScalar>;                                                           \
  ISO_INSTANTIATE_PARTICLES(OwnScalar)                                                              \
  ISO_INSTANTIATE_WORLD_QUERIES(OwnScalar)                                                          \
  ISO_INSTANTIATE_ACTING_RECORDS(OwnScalar)                                                         \
  ISO_INSTANTIATE_CONTACT_SYSTEMS(OwnScalar)                                                        \
  ISO_INSTANTIATE_ISLAND_SYSTEMS(OwnScalar)                                                         \
  ISO_INSTANTIATE_MOTION_SYSTEMS(OwnScalar)                                                         \
  ISO_INSTANTIATE_EVENT_SYSTEMS(OwnScalar)                                                          \
  ISO_INSTANTIATE_WORLD_STEP(OwnScalar)                                                             \
  ISO_INSTANTIATE_STEP_MEMORY(OwnScalar)                                                            \
  ISO_INSTANTIATE_RECORD_STORE(OwnScalar)                                                           \
  ISO_INSTANTIATE_COMMANDS(OwnScalar)                                                               \
  ISO_BROKEN_RULE_OF(, OwnScalar)                                                                   \
  ISO_INSTANTIATE_WORLD(OwnScalar)                                                                  \
  ISO_DEBUG_DRAW_OF(, OwnScalar)                                                                    \
  }
