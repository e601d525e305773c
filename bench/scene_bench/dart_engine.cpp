// DART: every body a skeleton with a free joint, Dantzig's solver of boxed LCPs, the Bullet detector.
// SPDX-License-Identifier: MIT
#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/WeldJointConstraint.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/simulation/World.hpp>
#include <string>
#include <tuple>

#include "dart_contacts.hpp"
#include "peer.hpp"

namespace isostep::bench {
namespace {

namespace dynamics = dart::dynamics;

/// Bullet's detector, as DART uses it, takes 3.7 GB and a minute before the first step of 10 781 bodies.
constexpr std::size_t kMostBodies = 11000;

Eigen::Vector3d dart_vector(Vec3<double> v) { return {v.x, v.y, v.z}; }
Vec3<double> ours(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Isometry3d dart_pose(Vec3<double> position, Quat<double> q) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = dart_vector(position);
  pose.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
  return pose;
}

dynamics::ShapePtr shape_of(const PeerPart& part) {
  const double height = 2 * part.half_height;
  switch (part.type) {
    case ShapeType::sphere: return std::make_shared<dynamics::SphereShape>(part.radius);
    case ShapeType::capsule: return std::make_shared<dynamics::CapsuleShape>(part.radius, height);
    case ShapeType::cylinder: return std::make_shared<dynamics::CylinderShape>(part.radius, height);
    case ShapeType::cone: return std::make_shared<dynamics::ConeShape>(part.radius, height);
    case ShapeType::half_space: return std::make_shared<dynamics::PlaneShape>(dart_vector(part.normal), part.offset);
    case ShapeType::hull: throw scenes::SceneError("", "DART has no hulls of points");
    case ShapeType::mesh:
    case ShapeType::height_field: throw scenes::SceneError("", "DART is given no meshes and no height fields");
    default: return std::make_shared<dynamics::BoxShape>(dart_vector(part.half_extents * 2.0));
  }
}
/// DART's capsules, cylinders and cones stand along z, ours along y.
Quat<double> upright(ShapeType type) {
  const double half = sqrt(0.5);
  const bool turned = type == ShapeType::capsule || type == ShapeType::cylinder || type == ShapeType::cone;
  return turned ? Quat<double>{-half, 0, 0, half} : Quat<double>::identity();
}

struct DartBody {
  dynamics::SkeletonPtr skeleton;
  dynamics::FreeJoint* joint = nullptr;
  dynamics::BodyNode* node = nullptr;

  void move(const Eigen::Isometry3d& pose, Vec3<double> velocity, Vec3<double> angular_velocity) const {
    joint->setTransform(pose);  // first, for velocities are kept in the axes of the body
    joint->setLinearVelocity(dart_vector(velocity));
    joint->setAngularVelocity(dart_vector(angular_velocity));
  }
};

void add_shapes(dynamics::BodyNode& node, const PeerBody& from) {
  for (const PeerPart& part : from.parts) {
    auto* shape = node.createShapeNodeWith<dynamics::CollisionAspect, dynamics::DynamicsAspect>(shape_of(part));
    shape->setRelativeTransform(dart_pose(part.position, part.orientation * upright(part.type)));
  }
}
/// DART damps a joint by forces, which its implicit step takes.
void set_damping(dynamics::FreeJoint& joint, const PeerBody& from) {
  const double inertia[] = {from.inertia.x, from.inertia.y, from.inertia.z};
  for (std::size_t i = 0; i < 3; ++i) {
    joint.setDampingCoefficient(i, from.angular_damping * inertia[i]);
    joint.setDampingCoefficient(3 + i, from.linear_damping * from.mass);
  }
}

class DartEngine : public Peer {
 public:
  explicit DartEngine(const scenes::Scene& scene) : Peer(scene), world_(dart::simulation::World::create()) {
    if (!gears().empty()) throw scenes::SceneError("", "DART has no gears between free bodies");
    if (bodies().size() > kMostBodies)
      throw scenes::SceneError("",
                               "DART is given no scene of more than 11 000 bodies: its memory grows as their square");
    auto solver = std::make_unique<DartSolver>(owners_);
    solver_ = solver.get();
    world_->setConstraintSolver(std::move(solver));
    world_->setTimeStep(1 / hz());
    world_->setGravity(dart_vector(gravity()));
    for (const PeerBody& body : bodies()) bodies_.push_back(make(body));
    for (const PeerJoint& joint : joints()) connect(joint);
  }

  void step() override {
    check_range();
    for (const PeerForce& force : forces()) bodies_[force.body].node->addExtForce(dart_vector(force.force));
    solver_->touch();
    world_->step();
  }

  std::string settings() const override { return "boxed LCP by Dantzig, Bullet detector"; }

 protected:
  /// DART's bodies do not sleep.
  Motion motion(std::size_t i) const override {
    const dynamics::BodyNode& node = *bodies_[i].node;
    const Eigen::Isometry3d& pose = node.getTransform();
    const Eigen::Quaterniond q(pose.linear());
    return {ours(pose.translation()), ours(node.getLinearVelocity()), ours(node.getAngularVelocity()),
            normalise(Quat<double>{q.x(), q.y(), q.z(), q.w()}), true};
  }
  void replace(std::size_t i, const PeerBody& by) override {
    world_->removeSkeleton(bodies_[i].skeleton);
    owners_.erase(bodies_[i].node);
    bodies_[i] = make(by);
  }
  void launch(std::size_t i, Vec3<double> velocity) override {
    bodies_[i].move(bodies_[i].node->getTransform(), velocity, {0, 0, 0});
  }
  /// DART knows gravity whole or not at all.
  void drive(int frame) override {
    for (std::size_t i = 0; i < bodies().size(); ++i) {
      const PeerBody& body = bodies()[i];
      if (body.type == BodyType::kinematic) move_on(bodies_[i], body, frame / hz());
      if (body.type != BodyType::dynamic || body.gravity_scale == 1) continue;
      bodies_[i].node->addExtForce(dart_vector(gravity() * (body.mass * (body.gravity_scale - 1))));
    }
  }

 private:
  /// Where joints come far apart an assertion in Debian's library ends the whole program.
  void check_range() const {
    constexpr double kFastest = 1e4, kFurthest = 1e5;  // [m/s], [m]
    for (const DartBody& body : bodies_) {
      const double speed = body.node->getLinearVelocity().norm();
      const double way = body.node->getTransform().translation().norm();
      if (!(speed < kFastest && way < kFurthest)) throw Lost("DART throws a body out of the scene");
    }
  }
  /// A body that no force moves is immobile. Its velocity counts where it touches others; `time` [s] says its place.
  static void move_on(const DartBody& body, const PeerBody& from, double time) {
    const double speed = sqrt(dot(from.angular_velocity, from.angular_velocity));
    Eigen::Isometry3d pose = dart_pose(from.position + from.velocity * time, from.orientation);
    if (speed > 0) {
      const Eigen::AngleAxisd turn(speed * time, dart_vector(from.angular_velocity * (1 / speed)));
      pose.linear() = turn.toRotationMatrix() * pose.linear();
    }
    body.move(pose, from.velocity, from.angular_velocity);
  }
  DartBody make(const PeerBody& from) {
    DartBody made;
    made.skeleton = dynamics::Skeleton::create(std::to_string(made_++));  // DART prints names it meets twice
    std::tie(made.joint, made.node) = made.skeleton->createJointAndBodyNodePair<dynamics::FreeJoint>();
    made.skeleton->setMobile(from.type == BodyType::dynamic);
    if (from.type == BodyType::dynamic) {
      const Eigen::Matrix3d inertia = dart_vector(from.inertia).asDiagonal();
      made.node->setInertia(dynamics::Inertia(from.mass, Eigen::Vector3d::Zero(), inertia));
      set_damping(*made.joint, from);
    }
    made.move(dart_pose(from.position, from.orientation), from.velocity, from.angular_velocity);
    owners_[made.node] = &from;
    if (from.collide) add_shapes(*made.node, from);
    world_->addSkeleton(made.skeleton);
    return made;
  }

  using Joint = std::shared_ptr<dart::constraint::DynamicJointConstraint>;

  dynamics::BodyNode* node(int body) const { return body < 0 ? nullptr : bodies_[static_cast<std::size_t>(body)].node; }
  Joint ball(const PeerJoint& joint) const {
    using Ball = dart::constraint::BallJointConstraint;
    if (joint.cone > 0) throw scenes::SceneError("", "DART has no cone between free bodies");
    const Eigen::Vector3d at = node(joint.b)->getTransform() * dart_vector(joint.on_b.position);
    if (joint.a < 0) return std::make_shared<Ball>(node(joint.b), at);
    return std::make_shared<Ball>(node(joint.a), node(joint.b), at);
  }
  Joint weld(const PeerJoint& joint) const {
    using Weld = dart::constraint::WeldJointConstraint;
    if (joint.a < 0) return std::make_shared<Weld>(node(joint.b));
    return std::make_shared<Weld>(node(joint.a), node(joint.b));
  }
  void connect(const PeerJoint& joint) {
    switch (joint.type) {
      case JointType::ball: solver_->add_joint(ball(joint)); break;
      case JointType::fixed: solver_->add_joint(weld(joint)); break;
      default: throw scenes::SceneError("", "DART joins free bodies by balls and welds alone");
    }
    if (!joint.collide && joint.a >= 0) solver_->keep_apart(node(joint.a), node(joint.b));
  }

  DartOwners owners_;
  dart::simulation::WorldPtr world_;
  DartSolver* solver_ = nullptr;  // the world's
  std::vector<DartBody> bodies_;
  int made_ = 0;  // skeletons
};

}  // namespace

std::unique_ptr<Engine> make_dart(const scenes::Scene& scene, const EngineOptions&) {
  return std::make_unique<DartEngine>(scene);
}

}  // namespace isostep::bench
