// The numbers of W trees of one shape side by side, as the tree kernel keeps them for a step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "isostep/dynamics/joints/tree_shape.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

/// Symmetric matrices are their xx, xy, xz, yy, yz, zz; others nine entries by rows.
template <class S, int W> struct TreeBodyLanes {
  Velocity<S> linear[3][W], angular[3][W];  // [m/s], [rad/s] for the length of a pass
  S centre[3][W];                           // [m] now
  Unit<S> rotation[9][W];                   // body to world, now
  S kappa[6][W];                            // [1/m^2] now
  S felt[6][W];                             // [1/m^2] as the joints see it, tension in it
  S tension[6][W];                          // [m^2] geometric stiffness h^2 / mass, where there is enough of it
  S pull[W];                                // [m^2] sum of the joints' h^2 f.r / mass
  S calm[W];                                // [m^2] up to this such a sum changes nothing
};
template <class S, int W> struct TreeJointLanes {
  S frame_a[3][W], frame_b[3][W];  // [m] where the joint is, body axes
  S share_a[W], share_b[W];        // [1] MassShare
  S arm_a[3][W], arm_b[3][W];      // [m] the same, world axes, now
  S pull_a[W], pull_b[W];          // [m^2]
  S turn_a[9][W], turn_b[9][W];    // [1/m] angular velocity per impulse, before the mass share: column i for axis i
  S inverse[6][W];                 // [1] of D; until then what earlier eliminations have left of K
  Velocity<S> error[3][W];         // [m]
  Velocity<S> impulse[3][W];       // [m/s] accumulated
  Velocity<S> curve[3][W];         // [m/s] of what the arms' turning adds to the speed
  Velocity<S> right[3][W];         // [m/s] right-hand sides, then solutions
};
template <class S, int W> struct TreeLinkLanes {
  S down[9][W];  // [1] K_ji, i = the joint that has the link, j = `to`
  S up[9][W];    // [1] K_ij, then D_i^-1 K_ij
};

template <class S, int W> struct TreeMemory {
  TreeBodyLanes<S, W>* bodies;
  TreeJointLanes<S, W>* joints;
  TreeLinkLanes<S, W>* links;

  static ISO_INLINE TreeMemory of(void* memory, const TreeShape& shape) {
    auto* bodies = static_cast<TreeBodyLanes<S, W>*>(memory);
    auto* joints = reinterpret_cast<TreeJointLanes<S, W>*>(bodies + shape.bodies.size());
    return {bodies, joints, reinterpret_cast<TreeLinkLanes<S, W>*>(joints + shape.joints.size())};
  }
};
/// Lanes and nothing between: W trees take W times the bytes of one.
template <class S> ISO_INLINE std::size_t tree_bytes(const TreeShape& shape) {
  return shape.bodies.size() * sizeof(TreeBodyLanes<S, 1>) + shape.joints.size() * sizeof(TreeJointLanes<S, 1>) +
         shape.links.size() * sizeof(TreeLinkLanes<S, 1>);
}

}  // namespace isostep
