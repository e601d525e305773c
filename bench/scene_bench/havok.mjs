// Havok (float) as node_peer.mjs asks it, at its defaults.
// SPDX-License-Identifier: MIT
import { readFileSync } from "node:fs";
import { acrossOf, axisOf, load, pathInPackage, refuse, scaled, serve, sum, turned } from "./node_peer.mjs";

const { default: start } = await load("lib", "esm", "HavokPhysics_es.js");
const HK = await start({ wasmBinary: readFileSync(pathInPackage("lib", "esm", "HavokPhysics.wasm")) });

/** What a call gave, after its result. */
const got = ([result, value]) => {
  if (result !== HK.Result.RESULT_OK) throw new Error(`Havok says ${result.value}`);
  return value;
};
let world, bodies, shapes, constraints, forces, step, hasGroups, sleeps;

// It has no half-space: a box of a kilometre, so thick that nothing gets through it.
const plainHalf = 500, plainDepth = 100; // [m]
function halfSpace({ normal, offset, position, orientation }) {
  const [x, y, z] = turned(orientation, normal);
  const turn = y > -0.999 ? [z, 0, -x, 1 + y] : [1, 0, 0, 0]; // takes the box's top, y, to the normal
  const q = scaled(turn, 1 / Math.hypot(...turn));
  const centre = sum(position, scaled([x, y, z], offset - plainDepth / 2));
  return HK.HP_Shape_CreateBox(centre, q, [2 * plainHalf, plainDepth, 2 * plainHalf]);
}
function hull({ points }) {
  const at = HK._malloc(12 * points.length); // three floats a point
  HK.HEAPF32.set(points.flat(), at / 4);
  const made = HK.HP_Shape_CreateConvexHull(at, points.length);
  HK._free(at);
  return made;
}

function primitive(part) {
  const { type, radius, half_height: half, position, orientation } = part;
  const end = (y) => sum(position, turned(orientation, [0, y, 0]));
  switch (type) {
    case "sphere": return HK.HP_Shape_CreateSphere(position, radius);
    case "capsule": return HK.HP_Shape_CreateCapsule(end(-half), end(half), radius);
    case "cylinder": return HK.HP_Shape_CreateCylinder(end(-half), end(half), radius);
    case "box": return HK.HP_Shape_CreateBox(position, orientation, scaled(part.half_extents, 2));
    case "half_space": return halfSpace(part);
    case "hull": return hull(part); // its points lie in the body's frame
    default: return refuse(`Havok is given no ${type.replace("_", " ")}`);
  }
}

// Membership, and what it collides with. Nothing: a body that meets no other.
function filterOf({ collide, group }) {
  if (!collide) return [0, 0];
  if (group > 31) refuse("Havok has no more than 32 groups");
  const bit = group === 31 ? -(2 ** 31) : 1 << group;
  return [bit, group === 0 ? -1 : ~bit];
}
function shape(part, body) {
  const made = got(primitive(part));
  const { GEOMETRIC_MEAN, MAXIMUM } = HK.MaterialCombine;
  HK.HP_Shape_SetMaterial(made, [body.friction, body.friction, body.restitution, GEOMETRIC_MEAN, MAXIMUM]);
  if (hasGroups || !body.collide) HK.HP_Shape_SetFilterInfo(made, filterOf(body));
  shapes.push(made);
  return made;
}
const unmoved = [[0, 0, 0], [0, 0, 0, 1], [1, 1, 1]];
function shapeOf(body) {
  const parts = body.parts.map((part) => shape(part, body));
  if (parts.length === 1) return parts[0];
  const all = got(HK.HP_Shape_CreateContainer());
  parts.forEach((part) => HK.HP_Shape_AddChild(all, part, unmoved));
  shapes.push(all);
  return all;
}

const motions = { fixed: "STATIC", kinematic: "KINEMATIC", dynamic: "DYNAMIC" };
function make(body) {
  if (body.fast) refuse("Havok has no switch for fast bodies in its interface for JavaScript");
  const made = got(HK.HP_Body_Create());
  HK.HP_Body_SetShape(made, shapeOf(body));
  HK.HP_Body_SetMotionType(made, HK.MotionType[motions[body.type]]);
  HK.HP_Body_SetQTransform(made, [body.position, body.orientation]);
  HK.HP_World_AddBody(world, made, false);
  if (body.type === "fixed") return made;
  // Inertia is that of a mass of 1.
  const inertia = scaled(body.inertia, 1 / body.mass);
  if (body.type === "dynamic") HK.HP_Body_SetMassProperties(made, [[0, 0, 0], body.mass, inertia, [0, 0, 0, 1]]);
  HK.HP_Body_SetLinearDamping(made, body.linear_damping);
  HK.HP_Body_SetAngularDamping(made, body.angular_damping);
  HK.HP_Body_SetGravityFactor(made, body.gravity_scale);
  HK.HP_Body_SetLinearVelocity(made, body.velocity);
  HK.HP_Body_SetAngularVelocity(made, body.angular_velocity);
  if (!sleeps) HK.HP_Body_SetActivationControl(made, HK.ActivationControl.ALWAYS_ACTIVE);
  return made;
}

/** A body without a shape that stands for the world in a joint. */
function anchor() {
  const made = got(HK.HP_Body_Create());
  HK.HP_Body_SetMotionType(made, HK.MotionType.STATIC);
  HK.HP_World_AddBody(world, made, false);
  bodies.push(made);
  return made;
}

// The joint's axis, z, is Havok's x; "l" locks an axis, "f" leaves it free: three ways along, three about.
const axes = ["LINEAR_X", "LINEAR_Y", "LINEAR_Z", "ANGULAR_X", "ANGULAR_Y", "ANGULAR_Z"];
const modes = { ball: "lllfff", hinge: "lllfll", slider: "flllll", fixed: "llllll", rod: "ffffff", rope: "ffffff" };
function limit(joint, axis, lower, upper) {
  HK.HP_Constraint_SetAxisMode(joint, HK.ConstraintAxis[axis], HK.ConstraintAxisLimitMode.LIMITED);
  HK.HP_Constraint_SetAxisMinLimit(joint, HK.ConstraintAxis[axis], lower);
  HK.HP_Constraint_SetAxisMaxLimit(joint, HK.ConstraintAxis[axis], upper);
}
function drive(joint, axis, [speed, force]) {
  HK.HP_Constraint_SetAxisMotorType(joint, HK.ConstraintAxis[axis], HK.ConstraintMotorType.VELOCITY);
  HK.HP_Constraint_SetAxisMotorVelocityTarget(joint, HK.ConstraintAxis[axis], speed);
  HK.HP_Constraint_SetAxisMotorMaxForce(joint, HK.ConstraintAxis[axis], force);
}
function connect({ type, a, b, on_a, on_b, motor, limits, cone, shortest, length, collide }) {
  if (!(type in modes)) refuse(`Havok is given no ${type}`);
  const made = got(HK.HP_Constraint_Create());
  HK.HP_Constraint_SetParentBody(made, a < 0 ? anchor() : bodies[a]);
  HK.HP_Constraint_SetChildBody(made, bodies[b]);
  HK.HP_Constraint_SetAnchorInParent(made, on_a.anchor, axisOf(on_a), acrossOf(on_a));
  HK.HP_Constraint_SetAnchorInChild(made, on_b.anchor, axisOf(on_b), acrossOf(on_b));
  const { LOCKED, FREE } = HK.ConstraintAxisLimitMode;
  [...modes[type]].forEach((mode, i) => {
    HK.HP_Constraint_SetAxisMode(made, HK.ConstraintAxis[axes[i]], mode === "l" ? LOCKED : FREE);
  });
  const axis = type === "slider" ? "LINEAR_X" : "ANGULAR_X";
  if (limits !== null) limit(made, axis, ...limits);
  if (motor !== null) drive(made, axis, motor);
  if (cone > 0) ["ANGULAR_Y", "ANGULAR_Z"].forEach((across) => limit(made, across, -cone, cone));
  if (type === "rod" || type === "rope") limit(made, "LINEAR_DISTANCE", shortest, length);
  HK.HP_Constraint_SetCollisionsEnabled(made, collide ? 1 : 0);
  HK.HP_Constraint_SetEnabled(made, 1);
  constraints.push(made);
}

// Far above its defaults, which would bend what scenes begin with.
const fastest = 1e4, quickest = 1e4; // [m/s], [rad/s]
function raise(scene) {
  if (scene.gears.length > 0) refuse("Havok has no gears");
  [bodies, shapes, constraints, step] = [[], [], [], 1 / scene.hz];
  // [m/s] in a step: by its impulses a body gains a thousandth too much.
  forces = scene.forces.map(({ body, force }) => ({ body, push: scaled(force, step / scene.bodies[body].mass) }));
  hasGroups = scene.bodies.some(({ group }) => group > 0);
  sleeps = scene.allow_sleep;
  world = got(HK.HP_World_Create());
  HK.HP_World_SetGravity(world, scene.gravity);
  HK.HP_World_SetIdealStepTime(world, step);
  HK.HP_World_SetSpeedLimit(world, fastest, quickest);
  try {
    for (const body of scene.bodies) bodies.push(make(body));
    scene.joints.forEach(connect);
  } catch (error) {
    free();
    throw error;
  }
}
function free() {
  constraints.forEach((constraint) => HK.HP_Constraint_Release(constraint));
  bodies.forEach((body) => {
    HK.HP_World_RemoveBody(world, body);
    HK.HP_Body_Release(body);
  });
  shapes.forEach((made) => HK.HP_Shape_Release(made));
  HK.HP_World_Release(world);
}

function replace(index, body) {
  HK.HP_World_RemoveBody(world, bodies[index]);
  HK.HP_Body_Release(bodies[index]);
  bodies[index] = make(body);
}
function launch(index, velocity) {
  HK.HP_Body_SetActivationState(bodies[index], HK.ActivationState.ACTIVE);
  HK.HP_Body_SetLinearVelocity(bodies[index], velocity);
  HK.HP_Body_SetAngularVelocity(bodies[index], [0, 0, 0]);
}

function advance() {
  for (const { body, push } of forces) {
    HK.HP_Body_SetLinearVelocity(bodies[body], sum(got(HK.HP_Body_GetLinearVelocity(bodies[body])), push));
  }
  HK.HP_World_Step(world, step);
}

function tell(index, numbers, n) {
  const body = bodies[index];
  const [place, turn] = got(HK.HP_Body_GetQTransform(body));
  numbers.set(place, n);
  numbers.set(turn, n + 3);
  numbers.set(got(HK.HP_Body_GetLinearVelocity(body)), n + 7);
  numbers.set(got(HK.HP_Body_GetAngularVelocity(body)), n + 10);
  numbers[n + 13] = got(HK.HP_Body_GetActivationState(body)) === HK.ActivationState.ACTIVE ? 1 : 0;
}

serve({ raise, free, step: advance, tell, replace, launch });
