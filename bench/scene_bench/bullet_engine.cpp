// Bullet (float), as its manual sets it up.
// SPDX-License-Identifier: MIT
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <algorithm>
#include <cmath>

#include "bullet_joints.hpp"
#include "bullet_queries.hpp"
#include "bullet_shapes.hpp"
#include "peer.hpp"

namespace isostep::bench {
namespace {

/// Bodies of one group do not meet; a body's user index is its group. Beside the rule of the library.
struct GroupFilter : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
    if ((a->m_collisionFilterGroup & b->m_collisionFilterMask) == 0) return false;
    if ((b->m_collisionFilterGroup & a->m_collisionFilterMask) == 0) return false;
    const int group = static_cast<const btCollisionObject*>(a->m_clientObject)->getUserIndex();
    return group <= 0 || group != static_cast<const btCollisionObject*>(b->m_clientObject)->getUserIndex();
  }
};

/// The larger, as ours; by itself Bullet multiplies.
btScalar restitution_of_pair(const btCollisionObject* a, const btCollisionObject* b) {
  return btMax(a->getRestitution(), b->getRestitution());
}
/// The damping as Bullet wants it: the share lost in a second at `rate` [1/s].
btScalar damping(double rate) { return bt(1 - std::exp(-rate)); }

/// Shapes first, so that they go last.
struct BulletBody {
  std::vector<BulletShape> shapes;
  std::unique_ptr<btDefaultMotionState> path;  // of a kinematic body
  std::unique_ptr<btRigidBody> body;
};

class BulletEngine : public Peer {
 public:
  BulletEngine(const scenes::Scene& scene, bool best)
      : Peer(scene), dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    if (best) world_.getSolverInfo().m_numIterations = kBestIterations;
    gCalculateCombinedRestitutionCallback = restitution_of_pair;
    gContactAddedCallback = turn_to_surface;
    world_.getPairCache()->setOverlapFilterCallback(&filter_);
    world_.setGravity(bt(gravity()));
    for (const PeerBody& body : bodies()) {
      bodies_.push_back(make(body));
      add(bodies_.back(), body);
    }
    for (const PeerJoint& joint : joints()) connect(joint);
    for (const PeerGear& gear : gears()) connect(gear);
  }
  ~BulletEngine() override {
    for (const auto& joint : joints_) world_.removeConstraint(joint.get());
    for (const BulletBody& body : bodies_) world_.removeRigidBody(body.body.get());
  }

  /// No sub-steps of its own and no interpolation: exactly one step.
  void step() override {
    for (const PeerForce& force : forces()) bodies_[force.body].body->applyCentralForce(bt(force.force));
    world_.stepSimulation(bt(1 / hz()), 0);
  }

  std::string settings() const override {
    return std::to_string(world_.getSolverInfo().m_numIterations) + " iterations";
  }

  void take(const scenes::DrawnQueries& drawn) override { queries_.take(drawn); }
  std::optional<Answered> ask(Query query) override { return queries_.ask(world_, query); }

 protected:
  Motion motion(std::size_t i) const override {
    const btRigidBody& body = *bodies_[i].body;
    const btQuaternion q = body.getOrientation();
    return {ours(body.getCenterOfMassPosition()), ours(body.getLinearVelocity()), ours(body.getAngularVelocity()),
            normalise(Quat<double>{q.x(), q.y(), q.z(), q.w()}), body.isActive()};
  }
  void replace(std::size_t i, const PeerBody& by) override {
    world_.removeRigidBody(bodies_[i].body.get());
    bodies_[i] = make(by);
    add(bodies_[i], by);
  }
  void launch(std::size_t i, Vec3<double> velocity) override {
    bodies_[i].body->activate(true);
    bodies_[i].body->setLinearVelocity(bt(velocity));
    bodies_[i].body->setAngularVelocity({0, 0, 0});
  }
  /// Bullet asks a kinematic body's motion state where it will be at the end of the step.
  void drive(int frame) override {
    for (std::size_t i = 0; i < bodies().size(); ++i) {
      if (bodies()[i].type != BodyType::kinematic) continue;
      const Vec3<double> angular_velocity = bodies()[i].angular_velocity;
      const double speed = sqrt(dot(angular_velocity, angular_velocity)), time = (frame + 1) / hz();
      const btQuaternion turn =
          speed > 0 ? btQuaternion(bt(angular_velocity * (1 / speed)), bt(speed * time)) : btQuaternion::getIdentity();
      bodies_[i].path->setWorldTransform(
          btTransform(turn * bt(bodies()[i].orientation), bt(bodies()[i].position + bodies()[i].velocity * time)));
    }
  }

 private:
  static constexpr int kBestIterations = 50;  // well above the 20 that Bullet's wiki calls good quality

  /// A half-space is where its plane says, a cone is not where its centre of mass is.
  static bool is_in_place(const PeerPart& part) {
    return part.type == ShapeType::half_space || Pose<double>{part.position, part.orientation}.is_identity();
  }
  btCollisionShape* assemble(BulletBody& made, const PeerBody& from) {
    for (const PeerPart& part : from.parts) made.shapes.push_back(bullet_shape(part));
    if (from.parts.size() == 1 && is_in_place(from.parts.front())) return made.shapes.front().shape.get();
    auto compound = std::make_unique<btCompoundShape>();
    for (std::size_t i = 0; i < from.parts.size(); ++i) {
      compound->addChildShape(btTransform(bt(from.parts[i].orientation), bt(from.parts[i].position)),
                              made.shapes[i].shape.get());
    }
    made.shapes.emplace_back().shape = std::move(compound);
    return made.shapes.back().shape.get();
  }
  BulletBody make(const PeerBody& from) {
    BulletBody made;
    const btTransform pose(bt(from.orientation), bt(from.position));
    if (from.type == BodyType::kinematic) made.path = std::make_unique<btDefaultMotionState>(pose);
    btRigidBody::btRigidBodyConstructionInfo info(bt(from.mass), made.path.get(), assemble(made, from),
                                                  bt(from.inertia));
    info.m_startWorldTransform = pose;
    info.m_friction = bt(friction_of_one(from.friction));
    info.m_restitution = bt(from.restitution);
    info.m_linearDamping = damping(from.linear_damping);
    info.m_angularDamping = damping(from.angular_damping);
    made.body = std::make_unique<btRigidBody>(info);
    made.body->setLinearVelocity(bt(from.velocity));
    made.body->setAngularVelocity(bt(from.angular_velocity));
    made.body->setUserIndex(static_cast<int>(from.group));
    if (from.parts.front().surface != nullptr) {
      made.body->setCollisionFlags(made.body->getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    }
    if (from.type == BodyType::kinematic) {
      made.body->setCollisionFlags(made.body->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    }
    if (from.fast) sweep(*made.body, from);
    if (from.type != BodyType::static_ && !allow_sleep()) made.body->setActivationState(DISABLE_DEACTIVATION);
    return made;
  }
  /// Swept when it moves by more than it is thick, with a smaller sphere, as in Bullet's own demonstration.
  static void sweep(btRigidBody& body, const PeerBody& from) {
    double thickness = from.parts.front().thickness;
    for (const PeerPart& part : from.parts) thickness = std::min(thickness, part.thickness);
    body.setCcdMotionThreshold(bt(thickness));
    body.setCcdSweptSphereRadius(bt(0.2 * thickness));
  }
  /// Bullet multiplies the two coefficients of a pair.
  static double friction_of_one(double pair) { return sqrt(pair); }

  void add(const BulletBody& made, const PeerBody& from) {
    if (from.collide) {
      world_.addRigidBody(made.body.get());
    } else {
      world_.addRigidBody(made.body.get(), btBroadphaseProxy::DefaultFilter, 0);
    }
    if (from.gravity_scale != 1) made.body->setGravity(bt(gravity() * from.gravity_scale));
  }
  btRigidBody& body(int i) {
    return i < 0 ? btTypedConstraint::getFixedBody() : *bodies_[static_cast<std::size_t>(i)].body;
  }
  void connect(const PeerJoint& joint) {
    joints_.push_back(bullet_joint(joint, body(joint.a), body(joint.b), hz()));
    world_.addConstraint(joints_.back().get(), !joint.collide);
  }
  void connect(const PeerGear& gear) {
    btRigidBody &a = body(joints()[gear.joint_a].b), &b = body(joints()[gear.joint_b].b);
    joints_.push_back(bullet_gear(gear, joints(), a, b));
    world_.addConstraint(joints_.back().get());
  }

  GroupFilter filter_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<BulletBody> bodies_;
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
  BulletQueries queries_;
};

}  // namespace

std::unique_ptr<Engine> make_bullet(const scenes::Scene& scene, const EngineOptions&) {
  return std::make_unique<BulletEngine>(scene, false);
}
std::unique_ptr<Engine> make_bullet_best(const scenes::Scene& scene, const EngineOptions&) {
  return std::make_unique<BulletEngine>(scene, true);
}

}  // namespace isostep::bench
