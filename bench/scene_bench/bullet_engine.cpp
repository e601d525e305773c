// Bullet (float) in the scene benchmark, as its manual sets it up.
// SPDX-License-Identifier: MIT
#include <btBulletDynamicsCommon.h>

#include "peer.hpp"

namespace isostep::bench {
namespace {

btScalar bt(double x) { return static_cast<btScalar>(x); }
btVector3 bt(Vec3<double> v) { return {bt(v.x), bt(v.y), bt(v.z)}; }
btQuaternion bt(Quat<double> q) { return btQuaternion(bt(q.x), bt(q.y), bt(q.z), bt(q.w)).normalized(); }
Vec3<double> ours(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

std::unique_ptr<btCollisionShape> shape_of(const PeerPart& part) {
  switch (part.type) {
    case ShapeType::sphere: return std::make_unique<btSphereShape>(bt(part.radius));
    case ShapeType::capsule: return std::make_unique<btCapsuleShape>(bt(part.radius), bt(2 * part.half_height));
    default: return std::make_unique<btBoxShape>(bt(part.half_extents));
  }
}

/// Shapes first, so that they go last.
struct BulletBody {
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::unique_ptr<btDefaultMotionState> path;  // of a kinematic body
  std::unique_ptr<btRigidBody> body;
};

class BulletEngine : public Peer {
 public:
  explicit BulletEngine(const scenes::Scene& scene)
      : Peer(scene), dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    world_.setGravity(bt(gravity()));
    for (const PeerBody& body : bodies()) {
      bodies_.push_back(make(body));
      add(bodies_.back(), body);
    }
    for (const PeerJoint& joint : joints()) connect(joint);
  }
  ~BulletEngine() override {
    for (const auto& joint : joints_) world_.removeConstraint(joint.get());
    for (const BulletBody& body : bodies_) world_.removeRigidBody(body.body.get());
  }

  /// No sub-steps of its own and no interpolation: exactly one step of 1/60 s.
  void step() override { world_.stepSimulation(bt(1.0 / 60), 0); }

  bool all_asleep() const override {
    for (const BulletBody& body : bodies_) {
      if (!body.body->isStaticOrKinematicObject() && body.body->isActive()) return false;
    }
    return true;
  }
  std::string settings() const override {
    return std::to_string(world_.getSolverInfo().m_numIterations) + " iterations";
  }

 protected:
  Motion motion(std::size_t i) const override {
    const btRigidBody& body = *bodies_[i].body;
    const btQuaternion q = body.getOrientation();
    return {ours(body.getCenterOfMassPosition()), ours(body.getLinearVelocity()), ours(body.getAngularVelocity()),
            normalise(Quat<double>{q.x(), q.y(), q.z(), q.w()})};
  }
  void replace(std::size_t i, const PeerBody& by) override {
    world_.removeRigidBody(bodies_[i].body.get());
    bodies_[i] = make(by);
    add(bodies_[i], by);
  }
  /// Bullet asks a kinematic body's motion state where it will be at the end of the step.
  void drive(int frame) override {
    for (std::size_t i = 0; i < bodies().size(); ++i) {
      if (bodies()[i].type != BodyType::kinematic) continue;
      const Vec3<double> spin = bodies()[i].spin;
      const double speed = sqrt(dot(spin, spin));
      const btQuaternion turn(bt(spin * (1 / speed)), bt(speed * (frame + 1) / 60));
      bodies_[i].path->setWorldTransform(btTransform(turn * bt(bodies()[i].orientation), bt(bodies()[i].position)));
    }
  }

 private:
  btCollisionShape* assemble(BulletBody& made, const PeerBody& from) {
    for (const PeerPart& part : from.parts) made.shapes.push_back(shape_of(part));
    if (from.parts.size() == 1) return made.shapes.front().get();
    auto compound = std::make_unique<btCompoundShape>();
    for (std::size_t i = 0; i < from.parts.size(); ++i) {
      compound->addChildShape(btTransform(bt(from.parts[i].orientation), bt(from.parts[i].position)),
                              made.shapes[i].get());
    }
    made.shapes.push_back(std::move(compound));
    return made.shapes.back().get();
  }
  BulletBody make(const PeerBody& from) {
    BulletBody made;
    const btTransform pose(bt(from.orientation), bt(from.position));
    if (from.type == BodyType::kinematic) made.path = std::make_unique<btDefaultMotionState>(pose);
    btRigidBody::btRigidBodyConstructionInfo info(bt(from.mass), made.path.get(), assemble(made, from),
                                                  bt(from.inertia));
    info.m_startWorldTransform = pose;
    info.m_friction = bt(friction_of_one(from.friction));
    made.body = std::make_unique<btRigidBody>(info);
    made.body->setLinearVelocity(bt(from.velocity));
    if (from.type == BodyType::kinematic) {
      made.body->setCollisionFlags(made.body->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    }
    if (from.type != BodyType::fixed && !allow_sleep()) made.body->setActivationState(DISABLE_DEACTIVATION);
    return made;
  }
  /// Bullet multiplies the two coefficients of a pair.
  static double friction_of_one(double pair) { return sqrt(pair); }

  void add(const BulletBody& made, const PeerBody& from) {
    if (from.collide) {
      world_.addRigidBody(made.body.get());
    } else {
      world_.addRigidBody(made.body.get(), btBroadphaseProxy::DefaultFilter, 0);
    }
  }
  void connect(const PeerJoint& joint) {
    const auto frame = [&](btRigidBody& body) { return body.getCenterOfMassTransform().invXform(bt(joint.anchor)); };
    btRigidBody& b = *bodies_[static_cast<std::size_t>(joint.b)].body;
    if (joint.a < 0) {
      joints_.push_back(std::make_unique<btPoint2PointConstraint>(b, frame(b)));
    } else {
      btRigidBody& a = *bodies_[static_cast<std::size_t>(joint.a)].body;
      joints_.push_back(std::make_unique<btPoint2PointConstraint>(a, b, frame(a), frame(b)));
    }
    world_.addConstraint(joints_.back().get(), true);
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<BulletBody> bodies_;
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

}  // namespace

std::unique_ptr<Engine> make_bullet(const scenes::Scene& scene, const EngineOptions&) {
  return std::make_unique<BulletEngine>(scene);
}

}  // namespace isostep::bench
