// PreparedJoints<S>: the joints of one step as a solver works on them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "isostep/dynamics/joints/joint_impulse.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

/// The joints of a step, in the order of the context.
template <class S> class PreparedJoints {
 public:
  ISO_INLINE void prepare(const StepContext<S>& context, const SolverBodies<S>& bodies) {
    joints_.resize(context.joint_properties.size());
    auto axes = context.axis_drives;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const JointEnds<S>& ends = context.joint_ends[i];
      std::size_t own = 0;
      while (own < axes.size() && axes[own].joint == i) ++own;
      prepare_joint(context.joint_properties[i], context.joint_states[i], ends.a, ends.b, bodies, joints_[i],
                    axes.first(own));
      axes = axes.subspan(own);
    }
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
