// The kernels that solve trees of joints side by side, as a table: one for each instruction set, chosen at run time,
// all giving the same bits.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/instantiate.hpp"
#include "isostep/core/simd.hpp"
#include "isostep/dynamics/joints/joint.hpp"
#include "isostep/dynamics/joints/tree_shape.hpp"

namespace isostep {

/// The lanes in which a limit holds a drive, one bit each, and those in which it will hold it next.
struct HeldLanes {
  std::uint32_t below, above, next_below, next_above;

  ISO_INLINE std::uint32_t now() const { return below | above; }
};

/// Up to W trees of one shape. Lanes without a tree repeat the first one and write nothing.
template <class S> struct TreeRun {
  TreeShape shape;
  const std::uint32_t* joints;       // in the step's constraints: W for every joint of the shape
  const std::uint32_t* rows;         // of SolverBodies: W for every body of the shape
  std::uint32_t* idle;               // for every node: the lanes in which it asks for nothing, one bit each
  std::uint32_t* clear;              // for every joint: the lanes in which no limit is reached in this sub-step
  HeldLanes* held;                   // for every drive of joints with stops
  std::uint32_t lanes;               // which of the W have a tree, one bit each
  unsigned char* memory;             // TreeMemory<S, W>
  MotionRow<Velocity<S>>* velocity;  // of SolverBodies
  const SolverMass<S>* mass;         // likewise
};

/// The kernels of one instruction set. A pass over trees without drives is one call. With drives it is several: between
/// them the laws of the drives set what their rows are and ask for, in TreeDriveLanes.
template <class S> struct TreeKernels {
  const char* name;
  std::int32_t width;
  /// Prepares the lanes from the constraints, once a step, and stores them back.
  void (*prepare)(const TreeRun<S>&, const JointConstraint<S>* joints);
  void (*store)(const TreeRun<S>&, JointConstraint<S>* joints);
  /// Begins a sub-step: gathers the present poses and velocities of bodies, and the state of joints with stops.
  void (*place)(const TreeRun<S>&, const JointConstraint<S>* joints, const JointStep<S>& step);
  /// JointTrees calls each once a sub-step. They read the rows of constraints, except for points and joints with stops.
  void (*warm_start)(const TreeRun<S>&, const JointConstraint<S>* joints, const JointStep<S>& step);
  void (*solve)(const TreeRun<S>&, const JointStep<S>& step);
  void (*relax)(const TreeRun<S>&, const JointStep<S>& step);

  void (*begin)(const TreeRun<S>&);
  /// Compute speeds and impulses of drives, and right-hand sides of equalities, without bias in the relaxed form.
  void (*find_right_sides)(const TreeRun<S>&, const JointStep<S>& step);
  void (*find_relaxed_right_sides)(const TreeRun<S>&, const JointStep<S>& step);
  /// Turns the drives' right-hand sides into their new speeds and impulses.
  void (*substitute)(const TreeRun<S>&);
  /// Return true if a drive of joints with stops is off its piece of the law, like JointTrees::judge_drives().
  bool (*judge)(const TreeRun<S>&, const JointStep<S>& step, bool may_hold);
  bool (*judge_relaxed)(const TreeRun<S>&, const JointStep<S>& step, bool may_hold);
  /// `restore` resets the pass to its start. `resume` then factorises with impulses, scales and give of new pieces.
  void (*restore)(const TreeRun<S>&);
  void (*resume)(const TreeRun<S>&);
  void (*end)(const TreeRun<S>&);
};

/// Returns the kernels for `simd`. Null if the CPU or the build lacks it; never null for `best`.
template <class S> const TreeKernels<S>* tree_kernels(Simd simd);

#define ISO_DECLARE_TREE_KERNELS(S)         \
  ISO_DECLARE_KERNEL_TABLES(TreeKernels<S>) \
  template <> const TreeKernels<S>* tree_kernels<S>(Simd simd);
ISO_FOR_EACH_SCALAR(ISO_DECLARE_TREE_KERNELS)

}  // namespace isostep
