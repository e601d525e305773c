// The contact kernels as a table: one for each instruction set, chosen at run time, all giving the same bits.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/instantiate.hpp"
#include "isostep/core/simd.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/dynamics/solvers/contact_block.hpp"
#include "isostep/math/softness.hpp"

namespace isostep {

/// Holds the parameters of one pass over the contacts.
template <class S> struct ContactPass {
  Softness<S> softness;
  S rate;                      // [1/s] sub-steps a second
  Velocity<S> push_speed;      // [m/s] overlap is pushed apart no faster than this
  Velocity<S> max_separation;  // [m] beyond this a gap counts as this, so that rate times gap fits
  Velocity<S> max_load;        // [m/s] a heavier load counts as this for friction, so that its cone fits the format
};

/// A run of blocks of one shape: W contacts of one point count each, no two of which write the same body.
template <class S> struct BlockRun {
  void* blocks;  // ContactBlock or RollingBlock<S, W, P>
  const BlockBodies* bodies;
  std::int32_t count;
  MotionRow<Velocity<S>>* velocity;
  const MotionRow<Velocity<S>>* displacement;
};

/// Contacts of one shape to be made into blocks, with all of their state and geometry that solving needs.
template <class S> struct PrepareRun {
  void* blocks;         // as in BlockRun, to be filled
  BlockBodies* bodies;  // a block, to be filled
  std::int32_t count;   // contacts
  std::int32_t points;  // of each
  bool rolling;
  const std::uint32_t* order;  // which contacts, W a block
  const Contact<S>* contacts;
  const ContactGeometry<S>* geometry;
  const MotionRow<Velocity<S>>* velocity;
  const SolverMass<S>* mass;
  S penetration_bias;  // [1] an overlap counts as deeper by this much of itself
  S most_bias;         // [m] but by no more than this
};

/// Blocks of one shape whose impulses are stored in their contacts.
template <class S> struct StoreRun {
  const void* blocks;
  std::int32_t count;   // contacts
  std::int32_t points;  // of each
  bool rolling;
  const std::uint32_t* order;  // which contacts, W a block
  Contact<S>* contacts;
  Velocity<S>* step_impulses;  // [m/s] a contact, what its points pushed over the step
};

/// The number of a kernel's variants; a variant's index is rolling * 4 + points - 1.
inline constexpr int kContactVariants = 2 * kMaxContactPoints;

template <class S> struct ContactKernels {
  const char* name;
  std::int32_t width;
  void (*prepare)(const PrepareRun<S>&);
  void (*store)(const StoreRun<S>&);
  void (*warm_start[kContactVariants])(const BlockRun<S>&);
  void (*solve[kContactVariants])(const BlockRun<S>&, const ContactPass<S>&);
  void (*relax[kContactVariants])(const BlockRun<S>&, const ContactPass<S>&);
};

/// Returns the kernels for `simd`. Null if the CPU or the build lacks it; never null for `best`. Every scalar has its
/// own full specialisation, a strong symbol.
template <class S> const ContactKernels<S>* contact_kernels(Simd simd);

#define ISO_DECLARE_CONTACT_KERNELS(S)         \
  ISO_DECLARE_KERNEL_TABLES(ContactKernels<S>) \
  template <> const ContactKernels<S>* contact_kernels<S>(Simd simd);
ISO_FOR_EACH_SCALAR(ISO_DECLARE_CONTACT_KERNELS)

}  // namespace isostep
