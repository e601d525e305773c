// StepTools<S>: what a step computes with. None of it changes a bit of a result.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/pair_kernels.hpp"
#include "isostep/core/task_runner.hpp"
#include "isostep/dynamics/joints/tree_kernels.hpp"
#include "isostep/dynamics/solvers/body_kernels.hpp"
#include "isostep/dynamics/solvers/contact_kernels.hpp"

namespace isostep {

/// Holds the kernels of one instruction set, and the threads that help.
template <class S> struct StepTools {
  const ContactKernels<S>* contact_kernels;
  const PairKernels<S>* pair_kernels;
  const TreeKernels<S>* tree_kernels;
  const BodyKernels<S>* body_kernels;
  TaskRunner runner;

  /// Returns false, with no change, if the CPU or the build lacks the instruction set.
  ISO_INLINE bool use_simd(Simd simd) {
    const ContactKernels<S>* kernels = isostep::contact_kernels<S>(simd);
    if (kernels == nullptr) return false;
    contact_kernels = kernels;
    pair_kernels = isostep::pair_kernels<S>(simd);
    tree_kernels = isostep::tree_kernels<S>(simd);
    body_kernels = isostep::body_kernels<S>(simd);
    return true;
  }
};

}  // namespace isostep
