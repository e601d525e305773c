// Jolt (float) as node_peer.mjs asks it. Variants: none, and best with the settings that its documentation names for
// stacks and chains that give way: more velocity, position and collision steps.
// SPDX-License-Identifier: MIT
import { acrossOf, axisOf, isBest, load, pairsApart, refuse, scaled, serve } from "./node_peer.mjs";

const { default: start } = await load("dist", "jolt-physics.wasm-compat.js");
const J = await start();

const velocitySteps = 20, positionSteps = 6, bestCollisionSteps = 4; // its defaults are 10, 2 and 1
const collisionSteps = isBest ? bestCollisionSteps : 1;
// Jolt makes room for so many: as much as fits into the 10 MB that a step of this build may take.
const mostBodies = 1 << 14, mostPairs = 1 << 16, mostContacts = 1 << 14;
const unmovedLayer = 0, movedLayer = 1, aloneLayer = 2;

let jolt, physics, bodyInterface, bodies, constraints, forces, step, apart, sleeps;

/** A Jolt object of three numbers that lives for the call alone. */
const vector = (v) => new J.Vec3(...v);
const place = (v) => new J.RVec3(...v);
function using(objects, work) {
  const result = work(...objects);
  objects.forEach((object) => J.destroy(object));
  return result;
}

function layers() {
  const settings = new J.JoltSettings();
  settings.mMaxBodies = mostBodies;
  settings.mMaxBodyPairs = mostPairs;
  settings.mMaxContactConstraints = mostContacts;
  settings.mMaxWorkerThreads = 1;
  const pairs = new J.ObjectLayerPairFilterTable(3);
  pairs.EnableCollision(unmovedLayer, movedLayer);
  pairs.EnableCollision(movedLayer, movedLayer);
  const broad = new J.BroadPhaseLayerInterfaceTable(3, 2);
  const [still, moving] = [new J.BroadPhaseLayer(0), new J.BroadPhaseLayer(1)];
  [still, moving, moving].forEach((layer, i) => broad.MapObjectToBroadPhaseLayer(i, layer));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = broad;
  settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(broad, 2, pairs, 3);
  [still, moving].forEach((layer) => J.destroy(layer));
  return settings;
}

const convexRadius = 0.05; // [m] as by default; not more than a shape is thick
function hull(points) {
  const settings = new J.ConvexHullShapeSettings();
  points.forEach((point) => using([vector(point)], (p) => settings.mPoints.push_back(p)));
  return settings;
}
function plane({ normal, offset }) {
  return using([vector(normal)], (n) => new J.PlaneShapeSettings(new J.Plane(n, -offset)));
}
function primitive(part) {
  const { type, radius, half_height: half, half_extents: extents } = part;
  const rounding = (...sizes) => Math.min(convexRadius, ...sizes);
  switch (type) {
    case "sphere": return new J.SphereShapeSettings(radius);
    case "capsule": return new J.CapsuleShapeSettings(half, radius);
    case "cylinder": return new J.CylinderShapeSettings(half, radius, rounding(half, radius));
    case "cone": return new J.TaperedCylinderShapeSettings(half, 0, radius, 0);
    case "half_space": return plane(part);
    case "hull": return hull(part.points);
    case "box": return using([vector(extents)], (v) => new J.BoxShapeSettings(v, rounding(...extents)));
    default: return refuse(`Jolt is given no ${type.replace("_", " ")}`);
  }
}
function created(settings) {
  const result = settings.Create();
  if (result.HasError()) refuse(`Jolt makes no such shape: ${result.GetError().c_str()}`);
  const shape = result.Get();
  shape.AddRef();
  J.destroy(settings);
  return shape;
}
const isInPlace = ({ position, orientation }) => [...position, ...orientation.slice(0, 3)].every((x) => x === 0);
function assembled(parts) {
  if (parts.length === 1 && isInPlace(parts[0])) return created(primitive(parts[0]));
  const compound = new J.StaticCompoundShapeSettings();
  for (const part of parts) {
    const at = [vector(part.position), new J.Quat(...part.orientation)];
    using(at, (position, orientation) => compound.AddShapeShapeSettings(position, orientation, primitive(part), 0));
  }
  return created(compound);
}
/** Its centre of mass is the body's origin, whatever Jolt takes it for. */
function shapeOf(body) {
  const shape = assembled(body.parts);
  if (body.type !== "dynamic") return shape;
  const centre = shape.GetCenterOfMass();
  const back = scaled([centre.GetX(), centre.GetY(), centre.GetZ()], -1);
  if (back.every((x) => x === 0)) return shape;
  return using([vector(back)], (v) => {
    const moved = new J.OffsetCenterOfMassShape(shape, v);
    moved.AddRef();
    return moved;
  });
}

const motions = { fixed: J.EMotionType_Static, kinematic: J.EMotionType_Kinematic, dynamic: J.EMotionType_Dynamic };
function setMass(settings, body) {
  settings.mOverrideMassProperties = J.EOverrideMassProperties_MassAndInertiaProvided;
  const properties = settings.mMassPropertiesOverride;
  properties.mMass = body.mass;
  const inertia = J.Mat44.prototype.sIdentity();
  using([vector(body.inertia)], (v) => inertia.SetDiagonal3(v));
  properties.mInertia = inertia;
  settings.mMassPropertiesOverride = properties;
}
// Far above its defaults, which would bend what scenes begin with.
const fastest = 1e4, quickest = 1e4; // [m/s], [rad/s]
function setMotion(settings, body) {
  using([vector(body.velocity)], (v) => { settings.mLinearVelocity = v; });
  using([vector(body.angular_velocity)], (v) => { settings.mAngularVelocity = v; });
  settings.mLinearDamping = body.linear_damping;
  settings.mAngularDamping = body.angular_damping;
  settings.mMaxLinearVelocity = fastest;
  settings.mMaxAngularVelocity = quickest;
  settings.mGravityFactor = body.gravity_scale;
  settings.mApplyGyroscopicForce = true;
  settings.mAllowSleeping = sleeps;
  if (body.fast) settings.mMotionQuality = J.EMotionQuality_LinearCast;
  if (body.type === "dynamic") setMass(settings, body);
}
function make(body, index) {
  const shape = shapeOf(body);
  const layer = !body.collide ? aloneLayer : body.type === "fixed" ? unmovedLayer : movedLayer;
  const at = [place(body.position), new J.Quat(...body.orientation)];
  const settings = using(at, (p, q) => new J.BodyCreationSettings(shape, p, q, motions[body.type], layer));
  settings.mFriction = body.friction; // pairs: root of the product, and the larger restitution, as by default
  settings.mRestitution = body.restitution;
  setMotion(settings, body);
  if (apart.members.has(index)) {
    const group = new J.CollisionGroup(apart.filter, 1, apart.members.get(index));
    settings.mCollisionGroup = group;
    J.destroy(group);
  }
  const made = bodyInterface.CreateBody(settings);
  bodyInterface.AddBody(made.GetID(), J.EActivation_Activate);
  J.destroy(settings);
  shape.Release();
  return made;
}

/** A table of the bodies that may not meet some other. */
function tableOf(scene) {
  const pairs = pairsApart(scene), members = new Map();
  pairs.flat().forEach((body) => members.has(body) || members.set(body, members.size));
  const filter = new J.GroupFilterTable(Math.max(1, members.size));
  filter.AddRef();
  pairs.forEach(([a, b]) => filter.DisableCollision(members.get(a), members.get(b)));
  return { filter, members };
}

const ends = { 1: "on_a", 2: "on_b" };
/** Sets Name1 and Name2 of a joint's ends. */
function setEnds(settings, joint, makeOne, names) {
  for (const [number, end] of Object.entries(ends)) {
    for (const [name, of] of Object.entries(names)) {
      using([makeOne(of(joint[end]), name)], (v) => { settings[name + number] = v; });
    }
  }
}
const oneOf = (v, name) => (name === "mPoint" || name === "mPosition" ? place(v) : vector(v));
const anchorOf = (end) => end.anchor;
const kinds = {
  ball: ({ cone }) => (cone > 0
    ? [new J.SwingTwistConstraintSettings(), { mPosition: anchorOf, mTwistAxis: axisOf, mPlaneAxis: acrossOf }]
    : [new J.PointConstraintSettings(), { mPoint: anchorOf }]),
  hinge: () => [new J.HingeConstraintSettings(), { mPoint: anchorOf, mHingeAxis: axisOf, mNormalAxis: acrossOf }],
  slider: () => [new J.SliderConstraintSettings(), { mPoint: anchorOf, mSliderAxis: axisOf, mNormalAxis: acrossOf }],
  fixed: () => [new J.FixedConstraintSettings(), { mPoint: anchorOf, mAxisX: axisOf, mAxisY: acrossOf }],
  rod: () => [new J.DistanceConstraintSettings(), { mPoint: anchorOf }],
};
kinds.rope = kinds.spring = kinds.rod;
kinds.servo = kinds.hinge;

function setLimits(settings, { type, limits, cone, shortest, length, rest, stiffness, damping }) {
  if (cone > 0) {
    settings.mNormalHalfConeAngle = settings.mPlaneHalfConeAngle = cone;
    [settings.mTwistMinAngle, settings.mTwistMaxAngle] = limits;
  } else if (limits !== null) {
    [settings.mLimitsMin, settings.mLimitsMax] = limits;
  }
  if (type === "rod" || type === "rope") [settings.mMinDistance, settings.mMaxDistance] = [shortest, length];
  if (type !== "spring") return;
  settings.mMinDistance = settings.mMaxDistance = rest;
  const spring = settings.mLimitsSpringSettings;
  spring.mMode = J.ESpringMode_StiffnessAndDamping;
  spring.mStiffness = stiffness;
  spring.mDamping = damping;
}
function setMotor(settings, { type, motor: [, force] }) {
  const motor = settings.mMotorSettings;
  if (type === "hinge") [motor.mMinTorqueLimit, motor.mMaxTorqueLimit] = [-force, force];
  else [motor.mMinForceLimit, motor.mMaxForceLimit] = [-force, force];
}
function startMotor(constraint, { type, motor: [speed] }) {
  const made = J.castObject(constraint, type === "hinge" ? J.HingeConstraint : J.SliderConstraint);
  made.SetMotorState(J.EMotorState_Velocity);
  if (type === "hinge") made.SetTargetAngularVelocity(speed);
  else made.SetTargetVelocity(speed);
}
function setSpring(settings, { stiffness, damping }) {
  const spring = settings.mMotorSettings.mSpringSettings;
  spring.mMode = J.ESpringMode_StiffnessAndDamping;
  spring.mStiffness = stiffness;
  spring.mDamping = damping;
}
function startServo(constraint, { rest }) {
  const made = J.castObject(constraint, J.HingeConstraint);
  made.SetMotorState(J.EMotorState_Position);
  made.SetTargetAngle(rest);
}
function connect(joint) {
  const { type, a, b, motor } = joint;
  if (!(type in kinds)) refuse(`Jolt is given no ${type}`);
  const [settings, names] = kinds[type](joint);
  settings.mSpace = J.EConstraintSpace_LocalToBodyCOM;
  setEnds(settings, joint, oneOf, names);
  setLimits(settings, joint);
  if (motor !== null) setMotor(settings, joint);
  if (type === "servo") setSpring(settings, joint);
  const made = settings.Create(a < 0 ? J.JoltInterface.prototype.sGetFixedToWorldBody() : bodies[a], bodies[b]);
  physics.AddConstraint(made);
  if (motor !== null) startMotor(made, joint);
  if (type === "servo") startServo(made, joint);
  constraints.push(made);
}

function raise(scene) {
  if (scene.gears.length > 0) refuse("Jolt is given no gears");
  [bodies, constraints, forces, step] = [[], [], scene.forces, 1 / scene.hz];
  sleeps = scene.allow_sleep;
  const settings = layers();
  jolt = new J.JoltInterface(settings);
  J.destroy(settings);
  physics = jolt.GetPhysicsSystem();
  bodyInterface = physics.GetBodyInterface();
  using([vector(scene.gravity)], (v) => physics.SetGravity(v));
  if (isBest) setSteps();
  apart = tableOf(scene);
  scene.bodies.forEach((body, i) => bodies.push(make(body, i)));
  scene.joints.forEach(connect);
  physics.OptimizeBroadPhase();
}
function setSteps() {
  const settings = physics.GetPhysicsSettings();
  settings.mNumVelocitySteps = velocitySteps;
  settings.mNumPositionSteps = positionSteps;
  physics.SetPhysicsSettings(settings);
}
function remove(body) {
  const id = body.GetID();
  bodyInterface.RemoveBody(id);
  bodyInterface.DestroyBody(id);
}
function free() {
  constraints.forEach((constraint) => physics.RemoveConstraint(constraint));
  bodies.forEach(remove);
  apart.filter.Release();
  J.destroy(jolt);
}

function replace(index, body) {
  remove(bodies[index]);
  bodies[index] = make(body, index);
}
function launch(index, velocity) {
  using([vector(velocity), vector([0, 0, 0])], (v, w) => {
    bodyInterface.SetLinearAndAngularVelocity(bodies[index].GetID(), v, w);
  });
}

function advance() {
  for (const { body, force } of forces) {
    using([vector(force)], (v) => bodyInterface.AddForce(bodies[body].GetID(), v, J.EActivation_Activate));
  }
  jolt.Step(step, collisionSteps);
}

function tell(index, numbers, n) {
  const body = bodies[index];
  const set = (at, v) => { numbers[at] = v.GetX(); numbers[at + 1] = v.GetY(); numbers[at + 2] = v.GetZ(); };
  set(n, body.GetCenterOfMassPosition());
  const turn = body.GetRotation();
  set(n + 3, turn);
  numbers[n + 6] = turn.GetW();
  set(n + 7, body.GetLinearVelocity());
  set(n + 10, body.GetAngularVelocity());
  numbers[n + 13] = body.IsActive() ? 1 : 0;
}

serve({ raise, free, step: advance, tell, replace, launch });
