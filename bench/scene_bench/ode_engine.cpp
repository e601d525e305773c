// ODE (double): QuickStep with the defaults of its manual, or the exact step.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "ode_joints.hpp"
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

/// `rate` [1] lost in a step, at any speed.
void set_damping(dBodyID body, double rate, void (*set_scale)(dBodyID, dReal), void (*set_threshold)(dBodyID, dReal)) {
  set_scale(body, std::min(1.0, rate));
  set_threshold(body, 0);
}

/// Starts ODE once a process; it keeps tables of its own.
void start_ode() {
  static const bool started = dInitODE2(0) != 0 && dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  if (!started) throw scenes::SceneError("", "ODE does not start");
}

class OdeEngine : public Peer {
 public:
  OdeEngine(const scenes::Scene& scene, bool exact) : Peer(scene), exact_(exact) {
    if (exact && bodies().size() > kMostExact) {
      throw scenes::SceneError("", "ODE's exact step is given no more than 300 bodies: its time grows as their cube");
    }
    start_ode();
    world_ = dWorldCreate();
    space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY);
    touching_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, gravity().x, gravity().y, gravity().z);
    dWorldSetAutoDisableFlag(world_, allow_sleep() ? 1 : 0);
    for (const PeerBody& body : bodies()) bodies_.push_back(make(body));
    for (const PeerJoint& joint : joints()) connect(joint);
    for (const PeerGear& gear : gears())
      add_ode_gear(world_, gear, place_of(joints()[gear.joint_a]), place_of(joints()[gear.joint_b]));
    dRandSetSeed(0);
  }
  ~OdeEngine() override {
    dJointGroupDestroy(touching_);
    dSpaceDestroy(space_);
    for (const dTriMeshDataID mesh : meshes_) dGeomTriMeshDataDestroy(mesh);
    for (const dHeightfieldDataID field : fields_) dGeomHeightfieldDataDestroy(field);
    dWorldDestroy(world_);
  }

  void step() override {
    for (const PeerForce& f : forces()) dBodyAddForce(bodies_[f.body].body, f.force.x, f.force.y, f.force.z);
    dSpaceCollide(space_, this, collide);
    if (exact_) dWorldStep(world_, 1 / hz());
    else dWorldQuickStep(world_, 1 / hz());
    dJointGroupEmpty(touching_);
  }

  std::string settings() const override {
    if (exact_) return "dWorldStep";
    return "QuickStep, " + std::to_string(dWorldGetQuickStepNumIterations(world_)) + " iterations";
  }

 protected:
  Motion motion(std::size_t i) const override {
    const dBodyID body = bodies_[i].body;
    if (body == nullptr) {
      const PeerBody& fixed = bodies()[i];
      return {fixed.position, fixed.velocity, fixed.angular_velocity, fixed.orientation, false};
    }
    const dReal* q = dBodyGetQuaternion(body);
    return {ours(dBodyGetPosition(body)), ours(dBodyGetLinearVel(body)), ours(dBodyGetAngularVel(body)),
            normalise(Quat<double>{q[1], q[2], q[3], q[0]}), dBodyIsEnabled(body) != 0};
  }
  void replace(std::size_t i, const PeerBody& by) override {
    for (const dGeomID geom : bodies_[i].geoms) dGeomDestroy(geom);
    dBodyDestroy(bodies_[i].body);
    bodies_[i] = make(by);
  }
  void launch(std::size_t i, Vec3<double> velocity) override {
    dBodyEnable(bodies_[i].body);
    dBodySetLinearVel(bodies_[i].body, velocity.x, velocity.y, velocity.z);
    dBodySetAngularVel(bodies_[i].body, 0, 0, 0);
  }
  /// ODE moves kinematic bodies by their velocity, and knows gravity whole or not at all.
  void drive(int) override {
    for (std::size_t i = 0; i < bodies().size(); ++i) {
      const PeerBody& body = bodies()[i];
      if (body.type != BodyType::dynamic || body.gravity_scale == 1) continue;
      const Vec3<double> force = gravity() * (body.mass * (body.gravity_scale - 1));
      dBodyAddForce(bodies_[i].body, force.x, force.y, force.z);
    }
  }

 private:
  static constexpr std::size_t kMostExact = 300;  // bodies; a step of a pile of so many takes a second

  struct OdeBody {
    dBodyID body = nullptr;  // none: fixed
    std::vector<dGeomID> geoms;
  };

  dGeomID geom_of(const PeerPart& part) {
    const Vec3<double> h = part.half_extents;
    switch (part.type) {
      case ShapeType::sphere: return dCreateSphere(space_, part.radius);
      case ShapeType::capsule: return dCreateCapsule(space_, part.radius, 2 * part.half_height);
      case ShapeType::cylinder: return dCreateCylinder(space_, part.radius, 2 * part.half_height);
      case ShapeType::cone: throw scenes::SceneError("", "ODE has no cone");
      case ShapeType::mesh: return mesh_of(*part.surface);
      case ShapeType::height_field: return field_of(*part.surface);
      case ShapeType::half_space: return dCreatePlane(space_, 0, 1, 0, 0);  // `place` knows where
      case ShapeType::hull: throw scenes::SceneError("", "ODE is given no hulls: its pairs of them have one point");
      default: return dCreateBox(space_, 2 * h.x, 2 * h.y, 2 * h.z);
    }
  }
  /// ODE reads the surface where it is, and leaves it alone.
  dGeomID mesh_of(const PeerSurface& of) {
    meshes_.push_back(dGeomTriMeshDataCreate());
    dGeomTriMeshDataBuildDouble(meshes_.back(), of.points.data(), sizeof(Vec3<double>),
                                static_cast<int>(of.points.size()), of.corners.data(),
                                static_cast<int>(of.corners.size()), 3 * sizeof(std::uint32_t));
    return dCreateTriMesh(space_, meshes_.back(), nullptr, nullptr, nullptr);
  }
  dGeomID field_of(const PeerSurface& of) {
    fields_.push_back(dGeomHeightfieldDataCreate());
    constexpr double kBelow = 10;  // [m] how far under its lowest place ODE takes the field for solid
    dGeomHeightfieldDataBuildDouble(fields_.back(), of.heights.data(), 0, 2 * of.middle().x, 2 * of.middle().z,
                                    static_cast<int>(of.columns), static_cast<int>(of.rows), 1, 0, kBelow, 0);
    dGeomHeightfieldDataSetBounds(fields_.back(), -of.highest(), of.highest());
    return dCreateHeightfield(space_, fields_.back(), 1);
  }
  OdeBody make(const PeerBody& from) {
    OdeBody made;
    if (from.type != BodyType::static_) made.body = body_of(from);
    if (!from.collide) return made;
    for (const PeerPart& part : from.parts) {
      const dGeomID geom = geom_of(part);
      dGeomSetData(geom, const_cast<PeerBody*>(&from));
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
    dBodySetAngularVel(body, from.angular_velocity.x, from.angular_velocity.y, from.angular_velocity.z);
    if (from.type == BodyType::kinematic) {
      dBodySetKinematic(body);
      dBodySetAutoDisableFlag(body, 0);
      return body;
    }
    dMass mass;
    dMassSetParameters(&mass, from.mass, 0, 0, 0, from.inertia.x, from.inertia.y, from.inertia.z, 0, 0, 0);
    dBodySetMass(body, &mass);
    if (from.linear_damping > 0)
      set_damping(body, from.linear_damping / hz(), dBodySetLinearDamping, dBodySetLinearDampingThreshold);
    if (from.angular_damping > 0)
      set_damping(body, from.angular_damping / hz(), dBodySetAngularDamping, dBodySetAngularDampingThreshold);
    return body;
  }
  /// ODE's capsules and cylinders lie along z, ours along y.
  static void place(dGeomID geom, const PeerPart& part, const PeerBody& body, bool on_body) {
    const double half = sqrt(0.5);
    const bool lies = part.type == ShapeType::capsule || part.type == ShapeType::cylinder;
    const Quat<double> upright = lies ? Quat<double>{-half, 0, 0, half} : Quat<double>::identity();
    const Quat<double> local = part.orientation * upright;
    dQuaternion q;
    if (on_body) {
      set_quaternion(q, local);
      dGeomSetOffsetPosition(geom, part.position.x, part.position.y, part.position.z);
      dGeomSetOffsetQuaternion(geom, q);
      return;
    }
    const Vec3<double> at = body.position + to_matrix(body.orientation) * part.position;
    if (part.type == ShapeType::half_space) {
      const Vec3<double> n = to_matrix(normalise(body.orientation * part.orientation)) * part.normal;
      dGeomPlaneSetParams(geom, n.x, n.y, n.z, part.offset + dot(n, at));
      return;
    }
    set_quaternion(q, body.orientation * local);
    dGeomSetPosition(geom, at.x, at.y, at.z);
    dGeomSetQuaternion(geom, q);
  }
  Vec3<double> in_world(int body, Vec3<double> local) const {
    if (body < 0) return local;
    const PeerBody& at = bodies()[static_cast<std::size_t>(body)];
    return at.position + to_matrix(at.orientation) * local;
  }
  /// Anchors are given where they lie at the start.
  OdePlace place_of(const PeerJoint& joint) const {
    const auto body = [&](int i) { return i < 0 ? nullptr : bodies_[static_cast<std::size_t>(i)].body; };
    const Vec3<double> on_a = in_world(joint.a, joint.on_a.position);
    const Vec3<double> tip = joint.on_a.position + to_matrix(joint.on_a.orientation).column(2);
    return {body(joint.a), body(joint.b), on_a, in_world(joint.b, joint.on_b.position), in_world(joint.a, tip) - on_a};
  }
  void connect(const PeerJoint& joint) {
    add_ode_joint(world_, joint, place_of(joint), hz());
    if (joint.collide || joint.a < 0 || joint.b < 0) return;
    const auto place = [&](int i) { return &bodies()[static_cast<std::size_t>(i)]; };
    apart_.insert(std::minmax(place(joint.a), place(joint.b)));
  }

  static void collide(void* self, dGeomID a, dGeomID b) { static_cast<OdeEngine*>(self)->touch(a, b); }
  /// dContactApprox1: friction is a coefficient, not a force.
  void touch(dGeomID a, dGeomID b) {
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (body_a == body_b) return;
    const PeerBody& of_a = *static_cast<const PeerBody*>(dGeomGetData(a));
    const PeerBody& of_b = *static_cast<const PeerBody*>(dGeomGetData(b));
    if (of_a.group != 0 && of_a.group == of_b.group) return;
    if (apart_.count(std::minmax(&of_a, &of_b)) != 0) return;
    constexpr int kMost = 8;  // box against box finds no more
    dContact contacts[kMost];
    const int count = dCollide(a, b, kMost, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      contacts[i].surface = {};
      contacts[i].surface.mode = dContactApprox1;
      contacts[i].surface.mu = of_a.friction == of_b.friction ? of_a.friction : sqrt(of_a.friction * of_b.friction);
      contacts[i].surface.bounce = std::max(of_a.restitution, of_b.restitution);
      if (contacts[i].surface.bounce > 0) contacts[i].surface.mode |= dContactBounce;
      dJointAttach(dJointCreateContact(world_, touching_, &contacts[i]), body_a, body_b);
    }
  }

  bool exact_;
  dWorldID world_ = nullptr;
  dSpaceID space_ = nullptr;
  dJointGroupID touching_ = nullptr;
  std::vector<OdeBody> bodies_;
  std::vector<dTriMeshDataID> meshes_;
  std::vector<dHeightfieldDataID> fields_;
  std::set<std::pair<const PeerBody*, const PeerBody*>> apart_;  // joined, and not to collide; lower address first
};

}  // namespace

std::unique_ptr<Engine> make_ode(const scenes::Scene& scene, const EngineOptions&) {
  return std::make_unique<OdeEngine>(scene, false);
}
std::unique_ptr<Engine> make_ode_best(const scenes::Scene& scene, const EngineOptions&) {
  return std::make_unique<OdeEngine>(scene, true);
}

}  // namespace isostep::bench
