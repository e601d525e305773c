// ODE (double) in the scene benchmark: QuickStep with the defaults of its manual.
// SPDX-License-Identifier: MIT
#include <ode/ode.h>

#include "peer.hpp"

namespace isostep::bench {
namespace {

Vec3<double> ours(const dReal* v) { return {v[0], v[1], v[2]}; }
/// ODE keeps w first.
void set_quaternion(dReal* out, Quat<double> q) {
  out[0] = q.w;
  out[1] = q.x;
  out[2] = q.y;
  out[3] = q.z;
}

/// Once a process; ODE keeps tables of its own.
void start_ode() {
  static const bool started = dInitODE2(0) != 0 && dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  if (!started) throw scenes::SceneError("", "ODE does not start");
}

class OdeEngine : public Peer {
 public:
  explicit OdeEngine(const scenes::Scene& scene) : Peer(scene) {
    start_ode();
    world_ = dWorldCreate();
    space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY);
    touching_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, gravity().x, gravity().y, gravity().z);
    dWorldSetAutoDisableFlag(world_, allow_sleep() ? 1 : 0);
    for (const PeerBody& body : bodies()) bodies_.push_back(make(body));
    for (const PeerJoint& joint : joints()) connect(joint);
    dRandSetSeed(0);
  }
  ~OdeEngine() override {
    dJointGroupDestroy(touching_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  void step() override {
    dSpaceCollide(space_, this, collide);
    dWorldQuickStep(world_, 1.0 / 60);
    dJointGroupEmpty(touching_);
  }

  bool all_asleep() const override {
    for (const OdeBody& body : bodies_) {
      if (body.body != nullptr && dBodyIsEnabled(body.body) != 0) return false;
    }
    return true;
  }
  std::string settings() const override {
    return "QuickStep, " + std::to_string(dWorldGetQuickStepNumIterations(world_)) + " iterations";
  }

 protected:
  Motion motion(std::size_t i) const override {
    const dBodyID body = bodies_[i].body;
    if (body == nullptr) {
      const PeerBody& fixed = bodies()[i];
      return {fixed.position, fixed.velocity, fixed.spin, fixed.orientation};
    }
    const dReal* q = dBodyGetQuaternion(body);
    return {ours(dBodyGetPosition(body)), ours(dBodyGetLinearVel(body)), ours(dBodyGetAngularVel(body)),
            normalise(Quat<double>{q[1], q[2], q[3], q[0]})};
  }
  void replace(std::size_t i, const PeerBody& by) override {
    for (const dGeomID geom : bodies_[i].geoms) dGeomDestroy(geom);
    dBodyDestroy(bodies_[i].body);
    bodies_[i] = make(by);
  }
  void drive(int) override {}  // ODE moves kinematic bodies by their velocity

 private:
  struct OdeBody {
    dBodyID body = nullptr;  // none: fixed
    std::vector<dGeomID> geoms;
  };

  dGeomID geom_of(const PeerPart& part) {
    const Vec3<double> h = part.half_extents;
    switch (part.type) {
      case ShapeType::sphere: return dCreateSphere(space_, part.radius);
      case ShapeType::capsule: return dCreateCapsule(space_, part.radius, 2 * part.half_height);
      default: return dCreateBox(space_, 2 * h.x, 2 * h.y, 2 * h.z);
    }
  }
  OdeBody make(const PeerBody& from) {
    OdeBody made;
    if (from.type != BodyType::fixed) made.body = body_of(from);
    if (!from.collide) return made;
    for (const PeerPart& part : from.parts) {
      const dGeomID geom = geom_of(part);
      if (made.body != nullptr) dGeomSetBody(geom, made.body);
      place(geom, part, from, made.body != nullptr);
      made.geoms.push_back(geom);
    }
    return made;
  }
  dBodyID body_of(const PeerBody& from) {
    const dBodyID body = dBodyCreate(world_);
    dQuaternion q;
    set_quaternion(q, from.orientation);
    dBodySetPosition(body, from.position.x, from.position.y, from.position.z);
    dBodySetQuaternion(body, q);
    dBodySetLinearVel(body, from.velocity.x, from.velocity.y, from.velocity.z);
    dBodySetAngularVel(body, from.spin.x, from.spin.y, from.spin.z);
    if (from.type == BodyType::kinematic) {
      dBodySetKinematic(body);
      dBodySetAutoDisableFlag(body, 0);
      return body;
    }
    dMass mass;
    dMassSetParameters(&mass, from.mass, 0, 0, 0, from.inertia.x, from.inertia.y, from.inertia.z, 0, 0, 0);
    dBodySetMass(body, &mass);
    return body;
  }
  /// ODE's capsules lie along z, ours along y.
  static void place(dGeomID geom, const PeerPart& part, const PeerBody& body, bool on_body) {
    const double half = sqrt(0.5);
    const Quat<double> upright =
        part.type == ShapeType::capsule ? Quat<double>{-half, 0, 0, half} : Quat<double>::identity();
    const Quat<double> local = part.orientation * upright;
    dQuaternion q;
    if (on_body) {
      set_quaternion(q, local);
      dGeomSetOffsetPosition(geom, part.position.x, part.position.y, part.position.z);
      dGeomSetOffsetQuaternion(geom, q);
      return;
    }
    const Vec3<double> at = body.position + to_matrix(body.orientation) * part.position;
    set_quaternion(q, body.orientation * local);
    dGeomSetPosition(geom, at.x, at.y, at.z);
    dGeomSetQuaternion(geom, q);
  }
  void connect(const PeerJoint& joint) {
    const auto body = [&](int i) { return i < 0 ? nullptr : bodies_[static_cast<std::size_t>(i)].body; };
    const dJointID made = dJointCreateBall(world_, nullptr);
    dJointAttach(made, body(joint.a), body(joint.b));
    dJointSetBallAnchor(made, joint.anchor.x, joint.anchor.y, joint.anchor.z);
  }

  static void collide(void* self, dGeomID a, dGeomID b) { static_cast<OdeEngine*>(self)->touch(a, b); }
  /// dContactApprox1: friction is a coefficient, not a force.
  void touch(dGeomID a, dGeomID b) {
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (body_a == body_b) return;
    if (body_a != nullptr && body_b != nullptr && dAreConnectedExcluding(body_a, body_b, dJointTypeContact) != 0)
      return;
    constexpr int kMost = 8;  // box against box finds no more
    dContact contacts[kMost];
    const int count = dCollide(a, b, kMost, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      contacts[i].surface = {};
      contacts[i].surface.mode = dContactApprox1;
      contacts[i].surface.mu = 0.5;
      dJointAttach(dJointCreateContact(world_, touching_, &contacts[i]), body_a, body_b);
    }
  }

  dWorldID world_ = nullptr;
  dSpaceID space_ = nullptr;
  dJointGroupID touching_ = nullptr;
  std::vector<OdeBody> bodies_;
};

}  // namespace

std::unique_ptr<Engine> make_ode(const scenes::Scene& scene, const EngineOptions&) {
  return std::make_unique<OdeEngine>(scene);
}

}  // namespace isostep::bench
