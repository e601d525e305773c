// PhysX (float) as node_peer.mjs asks it. Variants: pgs and tgs, its two solvers, and each of them with -best: more
// iterations, by which its documentation has joints and stacks stiffened, and rods without slack.
// SPDX-License-Identifier: MIT
import { readFileSync } from "node:fs";
import { isBest, load, pairsApart, pathInPackage, product, refuse, scaled, serve, sum, turned, variant, xToZ }
  from "./node_peer.mjs";

// The package is built for browsers and ends where it finds Node's process; it asks for nothing that Node lacks.
async function started() {
  const { default: start } = await load("physx-js-webidl.mjs");
  const { process } = globalThis;
  globalThis.window = globalThis;
  delete globalThis.process;
  try {
    return await start({ wasmBinary: readFileSync(pathInPackage("physx-js-webidl.wasm")) });
  } finally {
    globalThis.process = process;
  }
}
const PX = await started();
const Top = PX.PxTopLevelFunctions.prototype;

const positionIterations = 32, velocityIterations = 4; // its defaults are 4 and 1
const [allocator, errors] = [new PX.PxDefaultAllocator(), new PX.PxDefaultErrorCallback()];
const foundation = Top.CreateFoundation(Top.PHYSICS_VERSION, allocator, errors);
const scale = new PX.PxTolerancesScale();
const physics = Top.CreatePhysics(Top.PHYSICS_VERSION, foundation, scale);
Top.InitExtensions(physics);
const dispatcher = Top.DefaultCpuDispatcherCreate(0); // everything in this thread
const cooking = new PX.PxCookingParams(scale);

let world, gravity, bodies, told, joints, forces, step, sleeps, apart, frame;

const unturned = [0, 0, 0, 1];
function using(objects, work) {
  const result = work(...objects);
  objects.forEach((object) => PX.destroy(object));
  return result;
}
const vector = (v) => new PX.PxVec3(...v);
const withVector = (v, work) => using([vector(v)], work);
const withPose = (position, orientation, work) => using([vector(position), new PX.PxQuat(...orientation)],
  (p, q) => using([new PX.PxTransform(p, q)], work));

// Its capsules, cylinders and cones lie along x, ours along y; a plane faces x.
const xToY = [0, 0, Math.SQRT1_2, Math.SQRT1_2];
function xTo([x, y, z]) {
  const q = x > -0.999 ? [0, -z, y, 1 + x] : [0, 1, 0, 0];
  return scaled(q, 1 / Math.hypot(...q));
}
function hull(points) {
  const list = new PX.PxArray_PxVec3();
  points.forEach((point) => withVector(point, (p) => list.pushBack(p)));
  const description = new PX.PxConvexMeshDesc();
  description.flags = new PX.PxConvexFlags(PX.PxConvexFlagEnum.eCOMPUTE_CONVEX);
  description.points.count = points.length;
  description.points.stride = 12; // three floats
  description.points.data = list.begin();
  const mesh = Top.CreateConvexMesh(cooking, description);
  return new PX.PxConvexMeshGeometry(mesh, new PX.PxMeshScale(), new PX.PxConvexMeshGeometryFlags(0));
}
const cores = PX.PxConvexCoreGeometryFactory.prototype;
const core = (name, shape) => using([shape], (made) => cores[`createFrom${name}`](made, 0)); // no margin
function geometry(part) {
  const { type, radius, half_height: half } = part;
  switch (type) {
    case "sphere": return new PX.PxSphereGeometry(radius);
    case "capsule": return new PX.PxCapsuleGeometry(radius, half);
    case "cylinder": return core("Cylinder", new PX.PxConvexCoreCylinder(2 * half, radius));
    case "cone": return core("Cone", new PX.PxConvexCoreCone(2 * half, radius));
    case "half_space": return new PX.PxPlaneGeometry();
    case "hull": return hull(part.points);
    case "box": return new PX.PxBoxGeometry(...part.half_extents);
    default: return refuse(`PhysX is given no ${type.replace("_", " ")}`);
  }
}
function placeOf({ type, position, orientation, normal, offset }) {
  if (type === "half_space") {
    const direction = turned(orientation, normal);
    return [sum(position, scaled(direction, offset)), xTo(direction)];
  }
  const lies = type === "capsule" || type === "cylinder" || type === "cone";
  return [position, lies ? product(orientation, xToY) : orientation];
}

// It multiplies what a pair has: so each has the root. Materials are few, and shared.
let materials = new Map();
function materialOf({ friction, restitution }) {
  const key = `${friction} ${restitution}`;
  if (!materials.has(key)) {
    const made = physics.createMaterial(Math.sqrt(friction), Math.sqrt(friction), restitution);
    made.setFrictionCombineMode(PX.PxCombineModeEnum.eMULTIPLY);
    made.setRestitutionCombineMode(PX.PxCombineModeEnum.eMAX);
    materials.set(key, made);
  }
  return materials.get(key);
}
function attach(actor, part, body, index) {
  const flag = body.collide ? PX.PxShapeFlagEnum.eSIMULATION_SHAPE : 0;
  const shape = using([geometry(part), new PX.PxShapeFlags(flag)],
    (of, flags) => physics.createShape(of, materialOf(body), true, flags));
  withPose(...placeOf(part), (pose) => shape.setLocalPose(pose));
  // The package's own filter lets bodies meet where one's first word and the other's second share a bit.
  const words = isFiltered ? [index, 0] : [1, 1];
  using([new PX.PxFilterData(...words, 0, 0)], (data) => shape.setSimulationFilterData(data));
  actor.attachShape(shape);
  shape.release();
}

const quickest = 1e4; // [rad/s] far above its default, which would bend what scenes begin with
function setMotion(actor, body) {
  withPose([0, 0, 0], unturned, (pose) => actor.setCMassLocalPose(pose));
  actor.setMass(body.mass);
  withVector(body.inertia, (v) => actor.setMassSpaceInertiaTensor(v));
  actor.setLinearDamping(body.linear_damping);
  actor.setAngularDamping(body.angular_damping);
  actor.setMaxAngularVelocity(quickest);
  withVector(body.velocity, (v) => actor.setLinearVelocity(v));
  withVector(body.angular_velocity, (v) => actor.setAngularVelocity(v));
  if (body.gravity_scale !== 1) actor.setActorFlag(PX.PxActorFlagEnum.eDISABLE_GRAVITY, true);
  if (body.fast) actor.setRigidBodyFlag(PX.PxRigidBodyFlagEnum.eENABLE_CCD, true);
  if (!sleeps) actor.setSleepThreshold(0);
  if (isBest) actor.setSolverIterationCounts(positionIterations, velocityIterations);
}
function make(body, index) {
  const create = body.type === "fixed" ? "createRigidStatic" : "createRigidDynamic";
  const actor = withPose(body.position, body.orientation, (pose) => physics[create](pose));
  body.parts.forEach((part) => attach(actor, part, body, index));
  if (body.type === "kinematic") actor.setRigidBodyFlag(PX.PxRigidBodyFlagEnum.eKINEMATIC, true);
  if (body.type === "dynamic") setMotion(actor, body);
  world.addActor(actor);
  return actor;
}

/** The filter is asked when two bodies come near each other for the first time. */
let shader, isFiltered;
function setFilter(description, scene) {
  const fast = scene.bodies.some((body) => body.fast);
  apart = new Set(pairsApart(scene).map(([a, b]) => `${a} ${b}`));
  isFiltered = fast || apart.size > 0;
  if (!isFiltered) {
    description.filterShader = Top.DefaultFilterShader();
    return;
  }
  const { eCONTACT_DEFAULT, eDETECT_CCD_CONTACT } = PX.PxPairFlagEnum, { eDEFAULT, eKILL } = PX.PxFilterFlagEnum;
  shader = new PX.PassThroughFilterShaderImpl();
  shader.outputPairFlags = eCONTACT_DEFAULT | (fast ? eDETECT_CCD_CONTACT : 0);
  const isApart = (a, b) => apart.has(a < b ? `${a} ${b}` : `${b} ${a}`);
  shader.filterShader = (_, a, _a1, _a2, _a3, __, b) => (isApart(a, b) ? eKILL : eDEFAULT);
  Top.setupPassThroughFilterShader(description, shader);
  if (fast) description.flags.raise(PX.PxSceneFlagEnum.eENABLE_CCD);
}
function makeWorld(scene) {
  const description = new PX.PxSceneDesc(scale);
  withVector(gravity, (v) => { description.gravity = v; });
  description.cpuDispatcher = dispatcher;
  description.solverType = PX.PxSolverTypeEnum[variant.startsWith("tgs") ? "eTGS" : "ePGS"];
  setFilter(description, scene);
  world = physics.createScene(description);
  PX.destroy(description);
}

// Frames of joints about x.
function created(name, a, on_a, b, on_b) {
  return withPose(on_a.anchor, xToZ(on_a.axes), (at) => withPose(on_b.anchor, xToZ(on_b.axes),
    (bt) => Top[`${name}JointCreate`](physics, a, at, b, bt)));
}
const hard = () => new PX.PxSpring(0, 0);
const stiff = 1e9; // [N s/m] or [N m s] damping of a drive: its speed is met wherever its force allows
const linearPair = ([lower, upper], work) => using([hard()],
  (spring) => using([new PX.PxJointLinearLimitPair(lower, upper, spring)], work));
const angularPair = ([lower, upper], work) => using([new PX.PxJointAngularLimitPair(lower, upper)], work);

function hinge(made, { limits, motor }) {
  const { eLIMIT_ENABLED, eDRIVE_ENABLED } = PX.PxRevoluteJointFlagEnum;
  if (limits !== null) {
    angularPair(limits, (pair) => made.setLimit(pair));
    made.setRevoluteJointFlag(eLIMIT_ENABLED, true);
  }
  if (motor === null) return;
  const [speed, torque] = motor;
  made.setConstraintFlag(PX.PxConstraintFlagEnum.eDRIVE_LIMITS_ARE_FORCES, true);
  made.setDriveVelocity(speed);
  made.setDriveForceLimit(torque);
  made.setRevoluteJointFlag(eDRIVE_ENABLED, true);
}
/** Its turn is held by a spring towards the angle of the start. */
function servo(made, { rest, stiffness, damping }) {
  if (rest !== 0) refuse("PhysX is given servos of the angle of the start alone");
  made.setMotion(PX.PxD6AxisEnum.eTWIST, PX.PxD6MotionEnum.eFREE);
  using([new PX.PxD6JointDrive(stiffness, damping, stiff, false)],
    (drive) => made.setDrive(PX.PxD6DriveEnum.eTWIST, drive));
}
function slider(made, { limits, motor }) {
  const { eX } = PX.PxD6AxisEnum, { eFREE, eLIMITED } = PX.PxD6MotionEnum;
  made.setMotion(eX, limits === null ? eFREE : eLIMITED);
  if (limits !== null) linearPair(limits, (pair) => made.setLinearLimit(eX, pair));
  if (motor === null) return;
  const [speed, force] = motor;
  made.setConstraintFlag(PX.PxConstraintFlagEnum.eDRIVE_LIMITS_ARE_FORCES, true);
  using([new PX.PxD6JointDrive(0, stiff, force, false)], (drive) => made.setDrive(PX.PxD6DriveEnum.eX, drive));
  using([vector([speed, 0, 0]), vector([0, 0, 0])], (v, w) => made.setDriveVelocity(v, w));
}
function shoulder(made, { limits, cone }) {
  const { eTWIST, eSWING1, eSWING2 } = PX.PxD6AxisEnum;
  [eTWIST, eSWING1, eSWING2].forEach((axis) => made.setMotion(axis, PX.PxD6MotionEnum.eLIMITED));
  angularPair(limits, (pair) => made.setTwistLimit(pair));
  using([new PX.PxJointLimitCone(cone, cone)], (limit) => made.setSwingLimit(limit));
}
function distance(made, { type, shortest, length, rest, stiffness, damping }) {
  const { eMAX_DISTANCE_ENABLED, eMIN_DISTANCE_ENABLED, eSPRING_ENABLED } = PX.PxDistanceJointFlagEnum;
  const isSpring = type === "spring";
  made.setMaxDistance(isSpring ? rest : length);
  made.setMinDistance(isSpring ? rest : shortest);
  made.setDistanceJointFlag(eMAX_DISTANCE_ENABLED, true);
  made.setDistanceJointFlag(eMIN_DISTANCE_ENABLED, type !== "rope");
  if (isBest || isSpring) made.setTolerance(0);
  if (!isSpring) return;
  made.setDistanceJointFlag(eSPRING_ENABLED, true);
  made.setStiffness(stiffness);
  made.setDamping(damping);
}
const nothing = () => {};
const kinds = {
  ball: ["Spherical", nothing], hinge: ["Revolute", hinge], servo: ["D6", servo], slider: ["D6", slider],
  fixed: ["Fixed", nothing],
  rod: ["Distance", distance], rope: ["Distance", distance], spring: ["Distance", distance],
};
function connect(joint) {
  const { type, a, b, on_a, on_b, collide, cone } = joint;
  if (!(type in kinds)) refuse(`PhysX is given no ${type}`);
  const [name, finish] = cone > 0 ? ["D6", shoulder] : kinds[type];
  const made = created(name, a < 0 ? null : bodies[a], on_a, bodies[b], on_b);
  finish(made, joint);
  if (collide) made.setConstraintFlag(PX.PxConstraintFlagEnum.eCOLLISION_ENABLED, true);
  joints.push(made);
}

function raise(scene) {
  if (scene.gears.length > 0) refuse("PhysX is given no gears");
  [bodies, joints, forces, step, frame] = [[], [], scene.forces, 1 / scene.hz, 0];
  [sleeps, gravity, told] = [scene.allow_sleep, scene.gravity, [...scene.bodies]];
  makeWorld(scene);
  scene.bodies.forEach((body, i) => bodies.push(make(body, i)));
  scene.joints.forEach(connect);
}
function free() {
  joints.forEach((joint) => joint.release());
  bodies.forEach((actor) => actor.release());
  world.release();
}

function replace(index, body) {
  bodies[index].release();
  told[index] = body;
  bodies[index] = make(body, index);
}
function launch(index, velocity) {
  withVector(velocity, (v) => bodies[index].setLinearVelocity(v, true));
  withVector([0, 0, 0], (w) => bodies[index].setAngularVelocity(w, true));
}

/** Kinematic bodies are told where they will be; gravity is all of it or none. */
function drive() {
  ++frame;
  told.forEach((body, i) => {
    if (body.type === "kinematic") {
      withPose(...placeAt(body, frame * step), (pose) => bodies[i].setKinematicTarget(pose));
    } else if (body.type === "dynamic" && body.gravity_scale !== 1 && body.gravity_scale !== 0) {
      withVector(scaled(gravity, body.mass * body.gravity_scale), (v) => bodies[i].addForce(v));
    }
  });
  for (const { body, force } of forces) withVector(force, (v) => bodies[body].addForce(v));
}
function placeAt({ position, orientation, velocity, angular_velocity: spin }, time) {
  const speed = Math.hypot(...spin), half = speed * time / 2;
  const turn = speed === 0 ? unturned : [...scaled(spin, Math.sin(half) / speed), Math.cos(half)];
  return [sum(position, scaled(velocity, time)), product(turn, orientation)];
}
function advance() {
  drive();
  world.simulate(step);
  world.fetchResults(true);
}

function tell(index, numbers, n) {
  const body = bodies[index], pose = body.getGlobalPose(), { p, q } = pose;
  [p.x, p.y, p.z, q.x, q.y, q.z, q.w].forEach((value, i) => { numbers[n + i] = value; });
  numbers.fill(0, n + 7, n + 14);
  if (told[index].type === "fixed") return;
  const set = (at, v) => { numbers[at] = v.x; numbers[at + 1] = v.y; numbers[at + 2] = v.z; };
  set(n + 7, body.getLinearVelocity());
  set(n + 10, body.getAngularVelocity());
  numbers[n + 13] = body.isSleeping() ? 0 : 1;
}

serve({ raise, free, step: advance, tell, replace, launch });
