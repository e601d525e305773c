// PreparedJoints<S>: the joints of one step as a solver works on them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "isostep/core/lower_bound.hpp"
#include "isostep/dynamics/joints/joint_impulse.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

/// The joints of a step, in the order of the context.
template <class S> class PreparedJoints {
 public:
  /// Makes room for the joints of a step, then prepares joints first..end-1. Ranges may be prepared side by side.
  ISO_INLINE void begin(const StepContext<S>& context) { joints_.resize(context.joint_properties.size()); }
  ISO_INLINE void prepare(const StepContext<S>& context, const SolverBodies<S>& bodies, std::size_t first,
                          std::size_t end) {
    auto axes = context.axis_drives;
    axes = axes.subspan(lower_bound(axes.size(), [&](std::size_t i) { return axes[i].joint < first; }));
    for (std::size_t i = first; i < end; ++i) {
      const JointEnds<S>& ends = context.joint_ends[i];
      std::size_t own = 0;
      while (own < axes.size() && axes[own].joint == i) ++own;
      prepare_joint(context.joint_properties[i], context.joint_states[i], ends.a, ends.b, bodies, joints_[i],
                    axes.first(own));
      axes = axes.subspan(own);
    }
  }
  ISO_INLINE void prepare_all(const StepContext<S>& context, const SolverBodies<S>& bodies) {
    begin(context);
    prepare(context, bodies, 0, joints_.size());
  }
  ISO_INLINE void store(const StepContext<S>& context) const {
    for (std::size_t i = 0; i < joints_.size(); ++i) store_joint(joints_[i], context.joint_states[i]);
  }

  /// Adds the joints' impulses of each sub-step to context.joint_impulses, if it is not empty.
  ISO_INLINE void add_impulses(const StepContext<S>& context) const {
    for (std::size_t i = 0; i < context.joint_impulses.size(); ++i) {
      if (joints_[i].holds) detail::add_impulses(joints_[i], context.joint_impulses[i]);
    }
  }

  ISO_INLINE std::size_t size() const { return joints_.size(); }
  ISO_INLINE JointConstraint<S>& operator[](std::size_t i) { return joints_[i]; }
  ISO_INLINE std::span<JointConstraint<S>> all() { return joints_; }

  /// Visits the joints; once solved, only their impulses: solver_fields.inl.
  template <class Visit> void visit_scratch(const Visit& visit, bool solved);

 private:
  std::vector<JointConstraint<S>> joints_;
};

}  // namespace isostep
