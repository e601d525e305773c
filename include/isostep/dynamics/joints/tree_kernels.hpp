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

/// The lanes in which a drive is on each piece of its law, one bit each. Others are free.
struct PieceLanes {
  std::uint32_t lower, upper, driven, forwards, backwards;

  /// The drive's speed is fixed.
  ISO_INLINE std::uint32_t fixed() const { return lower | upper | driven; }
  ISO_INLINE std::uint32_t pushed() const { return forwards | backwards; }
  ISO_INLINE void clear(std::uint32_t lanes) {
    lower &= ~lanes;
    upper &= ~lanes;
    driven &= ~lanes;
    forwards &= ~lanes;
    backwards &= ~lanes;
  }
  /// Returns the lanes in which two drives are on different pieces.
  ISO_INLINE std::uint32_t differs(const PieceLanes& o) const {
    return (lower ^ o.lower) | (upper ^ o.upper) | (driven ^ o.driven) | (forwards ^ o.forwards) |
           (backwards ^ o.backwards);
  }
};
/// A drive of W trees: its pieces now and those to try next, and the lanes in which it has a motor, or is a servo.
struct DriveLanes {
  PieceLanes now, next;
  std::uint32_t motors, servos;
};

/// Up to W trees of one shape. Lanes without a tree repeat the first one and write nothing.
template <class S> struct TreeRun {
  TreeShape shape;
  const std::uint32_t* joints;       // in the step's constraints: W for every joint of the shape
  const std::uint32_t* rows;         // of SolverBodies: W for every body of the shape
  std::uint32_t* idle;               // for every node: the lanes in which it asks for nothing, one bit each
  std::uint32_t* clear;              // for every joint: the lanes in which no limit is reached in this sub-step
  std::uint32_t* stale;              // for every joint: the lanes in which its rows must be written
  DriveLanes* drives;                // for every drive
  std::uint32_t lanes;               // which of the W have a tree, one bit each
  unsigned char* memory;             // TreeMemory<S, W>
  MotionRow<Velocity<S>>* velocity;  // of SolverBodies
  const SolverMass<S>* mass;         // likewise
};

/// The kernels of one instruction set.
template <class S> struct TreeKernels {
  const char* name;
  std::int32_t width;
  /// Prepares the lanes from the constraints, once a step, and stores them back.
  void (*prepare)(const TreeRun<S>&, const JointConstraint<S>* joints);
  void (*store)(const TreeRun<S>&, JointConstraint<S>* joints);
  /// Begins a sub-step: gathers the present poses and velocities of bodies, and the state of joints with stops.
  void (*place)(const TreeRun<S>&, const JointConstraint<S>* joints, const JointStep<S>& step);
  /// JointTrees calls each once a sub-step. `linearise` reads rows and laws of constraints, except for points, joints
  /// with stops and joints that follow and are not stale. Before `warm_start` JointTrees sets what loose joints feel of
  /// the tension at their bodies.
  void (*linearise)(const TreeRun<S>&, const JointConstraint<S>* joints, const JointStep<S>& step);
  void (*warm_start)(const TreeRun<S>&);
  void (*solve)(const TreeRun<S>&, const JointStep<S>& step);
  void (*relax)(const TreeRun<S>&, const JointStep<S>& step);
};

/// Returns the kernels for `simd`. Null if the CPU or the build lacks it; never null for `best`.
template <class S> const TreeKernels<S>* tree_kernels(Simd simd);

#define ISO_DECLARE_TREE_KERNELS(S)         \
  ISO_DECLARE_KERNEL_TABLES(TreeKernels<S>) \
  template <> const TreeKernels<S>* tree_kernels<S>(Simd simd);
ISO_FOR_EACH_SCALAR(ISO_DECLARE_TREE_KERNELS)

}  // namespace isostep
