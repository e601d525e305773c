// DART's solver with the friction and the restitution of pairs that isostep has, and groups that do not collide.
// SPDX-License-Identifier: MIT
#pragma once

#include <dart/collision/CollisionResult.hpp>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/DynamicJointConstraint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <unordered_map>

#include "peer_scene.hpp"

namespace isostep::bench {

/// Names the body of each node of DART.
using DartOwners = std::unordered_map<const dart::dynamics::BodyNode*, const PeerBody*>;

/// DART's default solver, which finds contacts with its Bullet detector. By itself DART takes the smaller friction of a
/// pair and the product of its restitutions, so contacts are made here, each with numbers of its own.
class DartSolver : public dart::constraint::BoxedLcpConstraintSolver {
 public:
  /// `owners` stays where it is.
  explicit DartSolver(const DartOwners& owners);

  void add_joint(const std::shared_ptr<dart::constraint::DynamicJointConstraint>& joint);
  /// The two do not collide with each other.
  void keep_apart(const dart::dynamics::BodyNode* a, const dart::dynamics::BodyNode* b);
  /// Finds the contacts of the step that follows.
  void touch();

 protected:
  void solveConstrainedGroup(dart::constraint::ConstrainedGroup& group) override;

 private:
  const PeerBody& owner(const dart::collision::CollisionObject& object) const;
  void add(dart::collision::Contact& contact);

  const DartOwners& owners_;
  dart::collision::CollisionOption option_;
  dart::collision::CollisionResult touching_;  // constraints refer to it during the step
  std::size_t joints_ = 0;                     // they precede the contacts among the constraints
};

}  // namespace isostep::bench
