// The joints of a scene as Bullet has them.
// SPDX-License-Identifier: MIT
#pragma once

#include "bullet_shapes.hpp"

namespace isostep::bench {

/// `a` is Bullet's fixed body where the joint has the world. Throws SceneError with the reason where Bullet has none.
std::unique_ptr<btTypedConstraint> bullet_joint(const PeerJoint& joint, btRigidBody& a, btRigidBody& b, double hz);
/// `a` and `b` turn on the hinges that the gear names. Their speeds alone: Bullet does not bring back what slipped.
std::unique_ptr<btTypedConstraint> bullet_gear(const PeerGear& gear, const std::vector<PeerJoint>& joints,
                                               btRigidBody& a, btRigidBody& b);

}  // namespace isostep::bench
