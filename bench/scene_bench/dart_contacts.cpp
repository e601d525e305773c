// Contacts of DART, one by one.
// SPDX-License-Identifier: MIT
#include "dart_contacts.hpp"

#include <algorithm>
#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/bullet/BulletCollisionDetector.hpp>
#include <dart/constraint/ConstrainedGroup.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/dynamics/ShapeNode.hpp>
#include <limits>

#include "isostep/dynamics/contact.hpp"
#include "scenes/scene.hpp"

namespace isostep::bench {
namespace {

using dart::collision::CollisionObject;

constexpr std::size_t kMostRows = 3000;  // of a group; a step of as many takes seconds

/// DART's shapes may change; nothing here sees more of them than what they are made of.
dart::dynamics::ShapeNode& shape_of(const CollisionObject& object) {
  return const_cast<dart::dynamics::ShapeNode&>(*object.getShapeFrame()->asShapeNode());
}

/// Bodies of one group do not meet. Beside the rules of the library.
class GroupFilter : public dart::collision::BodyNodeCollisionFilter {
 public:
  explicit GroupFilter(const DartOwners& owners) : owners_(owners) {}

  bool ignoresCollision(const CollisionObject* a, const CollisionObject* b) const override {
    const std::uint32_t group = group_of(*a);
    return (group != 0 && group == group_of(*b)) || BodyNodeCollisionFilter::ignoresCollision(a, b);
  }

 private:
  std::uint32_t group_of(const CollisionObject& object) const {
    return owners_.at(shape_of(object).getBodyNodePtr().get())->group;
  }

  const DartOwners& owners_;
};

}  // namespace

DartSolver::DartSolver(const DartOwners& owners) : owners_(owners) {
  setCollisionDetector(dart::collision::BulletCollisionDetector::create());
  getCollisionOption().maxNumContacts = 0;  // DART itself looks for none
  option_ = {true, std::numeric_limits<std::size_t>::max(), std::make_shared<GroupFilter>(owners)};
}

void DartSolver::add_joint(const std::shared_ptr<dart::constraint::DynamicJointConstraint>& joint) {
  addConstraint(joint);
  ++joints_;
}

void DartSolver::keep_apart(const dart::dynamics::BodyNode* a, const dart::dynamics::BodyNode* b) {
  static_cast<GroupFilter&>(*option_.collisionFilter).addBodyNodePairToBlackList(a, b);
}

void DartSolver::touch() {
  mManualConstraints.resize(joints_);
  getCollisionGroup()->collide(option_, &touching_);
  for (std::size_t i = 0; i < touching_.getNumContacts(); ++i) {
    dart::collision::Contact& contact = touching_.getContact(i);
    const bool counts = contact.penetrationDepth >= 0 && !dart::collision::Contact::isZeroNormal(contact.normal);
    if (counts) add(contact);  // as DART chooses them
  }
}

/// DART's matrices are full.
void DartSolver::solveConstrainedGroup(dart::constraint::ConstrainedGroup& group) {
  if (group.getTotalDimension() > kMostRows) {
    throw scenes::SceneError("", "DART is given no pile of more than 1000 contacts: its time grows as their cube");
  }
  BoxedLcpConstraintSolver::solveConstrainedGroup(group);
}

const PeerBody& DartSolver::owner(const CollisionObject& object) const {
  return *owners_.at(shape_of(object).getBodyNodePtr().get());
}

/// DART reads coefficients when the constraint is made, and no later.
void DartSolver::add(dart::collision::Contact& contact) {
  const PeerBody &a = owner(*contact.collisionObject1), &b = owner(*contact.collisionObject2);
  auto &on_a = *shape_of(*contact.collisionObject1).getDynamicsAspect(),
       &on_b = *shape_of(*contact.collisionObject2).getDynamicsAspect();
  const double friction = mixed_friction(a.friction, b.friction);
  on_a.setFrictionCoeff(friction);
  on_b.setFrictionCoeff(friction);
  on_a.setRestitutionCoeff(std::max(a.restitution, b.restitution));
  on_b.setRestitutionCoeff(1);
  mManualConstraints.push_back(std::make_shared<dart::constraint::ContactConstraint>(contact, getTimeStep()));
}

}  // namespace isostep::bench
