// Rapier (float) as node_peer.mjs asks it. Variants: none, and best with four times its solver iterations.
// SPDX-License-Identifier: MIT
import { axisOf, isBest, load, refuse, serve, turned, xToZ } from "./node_peer.mjs";

const { default: RAPIER } = await load("dist", "rapier.mjs");
await RAPIER.init();

const vector = ([x, y, z]) => ({ x, y, z });
const rotation = ([x, y, z, w]) => ({ x, y, z, w });
// A motor is a damper of its speed, this strong: beyond it nothing changes but that floats end.
const stiff = 1e6;
let world, bodies, uniform;

// With Rapier's own remedy for bodies that catch on inner edges; without it they stop on a plain.
function mesh({ points, corners }) {
  const flags = RAPIER.TriMeshFlags.FIX_INTERNAL_EDGES;
  return RAPIER.ColliderDesc.trimesh(new Float32Array(points.flat()), new Uint32Array(corners), flags);
}
// Heights are no lengths of its scale: y counts once.
function heightField({ cells, heights, size }) {
  const [x, , z] = size;
  const flags = RAPIER.HeightFieldFlags.FIX_INTERNAL_EDGES;
  return RAPIER.ColliderDesc.heightfield(...cells, new Float32Array(heights), vector([x, 1, z]), flags);
}

function shape(part) {
  switch (part.type) {
    case "sphere": return RAPIER.ColliderDesc.ball(part.radius);
    case "capsule": return RAPIER.ColliderDesc.capsule(part.half_height, part.radius);
    case "cylinder": return RAPIER.ColliderDesc.cylinder(part.half_height, part.radius);
    case "cone": return RAPIER.ColliderDesc.cone(part.half_height, part.radius);
    case "mesh": return mesh(part);
    case "height_field": return heightField(part);
    case "half_space": return new RAPIER.ColliderDesc(new RAPIER.HalfSpace(vector(part.normal)));
    case "hull": return RAPIER.ColliderDesc.convexHull(new Float32Array(part.points.flat()));
    default: return RAPIER.ColliderDesc.cuboid(...part.half_extents);
  }
}

const mass = (body) => [body.mass, vector([0, 0, 0]), vector(body.inertia), rotation([0, 0, 0, 1])];

// A half-space has no offset of its own. Mass is the collider's where it is the only one, else the body's.
function collider(part, body) {
  const description = shape(part);
  const at = turned(part.orientation, part.normal.map((n) => (part.type === "half_space" ? n * part.offset : 0)));
  description.setTranslation(...part.position.map((p, i) => p + at[i])).setRotation(rotation(part.orientation));
  description.setFriction(uniform ? body.friction : Math.sqrt(body.friction)).setRestitution(body.restitution);
  if (!uniform) description.setFrictionCombineRule(RAPIER.CoefficientCombineRule.Multiply);
  description.setRestitutionCombineRule(RAPIER.CoefficientCombineRule.Max);
  if (body.group > 15) refuse("Rapier has no more than 16 groups");
  const bit = 1 << body.group; // colliders of one group do not meet
  if (!body.collide) description.setCollisionGroups(0);
  else if (body.group > 0) description.setCollisionGroups(((bit << 16) | (0xffff & ~bit)) >>> 0);
  if (body.type === "dynamic" && body.parts.length > 1) description.setDensity(0);
  else if (body.type === "dynamic") description.setMassProperties(...mass(body));
  return description;
}

function make(body, allowSleep) {
  const kinds = { fixed: "fixed", kinematic: "kinematicVelocityBased", dynamic: "dynamic" };
  const description = RAPIER.RigidBodyDesc[kinds[body.type]]();
  description.setTranslation(...body.position).setRotation(rotation(body.orientation));
  description.setLinvel(...body.velocity).setAngvel(vector(body.angular_velocity)).setCanSleep(allowSleep);
  description.setGravityScale(body.gravity_scale).setCcdEnabled(body.fast);
  description.setLinearDamping(body.linear_damping).setAngularDamping(body.angular_damping);
  if (body.type === "dynamic" && body.parts.length > 1) description.setAdditionalMassProperties(...mass(body));
  const made = world.createRigidBody(description);
  for (const part of body.parts) world.createCollider(collider(part, body), made);
  return made;
}

function requireKnown({ type, cone }) {
  if (!["ball", "hinge", "servo", "slider", "fixed", "spring", "rope"].includes(type)) refuse(`Rapier has no ${type}`);
  if (cone > 0) refuse("Rapier has no cone");
}

// Ends are given in the bodies' own frames, z the axis of a hinge or slider; body -1 is the world. It slides along x.
function connect(of) {
  requireKnown(of);
  const { type, a, b, on_a, on_b, motor, limits, rest, stiffness, damping, length, collide } = of;
  const holder = a < 0 ? world.createRigidBody(RAPIER.RigidBodyDesc.fixed()) : bodies[a];
  const p = vector(on_a.anchor), q = vector(on_b.anchor);
  const axis = (end) => vector(axisOf(end));
  const joint =
    type === "ball" ? RAPIER.JointData.spherical(p, q)
    : type === "hinge" || type === "servo" ? RAPIER.JointData.revoluteWithAxes(p, q, axis(on_a), axis(on_b))
    : type === "slider" ? RAPIER.JointData.prismatic(p, q, vector([1, 0, 0]))
    : type === "fixed" ? RAPIER.JointData.fixed(p, rotation(on_a.axes), q, rotation(on_b.axes))
    : type === "spring" ? RAPIER.JointData.spring(rest, stiffness, damping, p, q)
    : RAPIER.JointData.rope(length, p, q);
  const made = world.createImpulseJoint(joint, holder, bodies[b], true);
  made.setContactsEnabled(collide);
  if (limits !== null) made.setLimits(...limits); // those of JointData are a slider's alone
  if (type === "slider") {
    made.setFrameX1(rotation(xToZ(on_a.axes)));
    made.setFrameX2(rotation(xToZ(on_b.axes)));
  }
  if (type === "servo") {
    made.configureMotorModel(RAPIER.MotorModel.ForceBased);
    made.configureMotorPosition(rest, stiffness, damping);
  }
  if (motor !== null) {
    const [speed, force] = motor;
    made.configureMotorVelocity(speed, stiff);
    made.setMotorMaxForce(force);
  }
}

const bestIterations = 16; // of its solver; 4 is its default, more is its remedy for joints and stacks that give way

function raise(scene) {
  if (scene.gears.length > 0) refuse("Rapier has no gears");
  world = new RAPIER.World(vector(scene.gravity));
  world.timestep = 1 / scene.hz;
  if (isBest) world.integrationParameters.numSolverIterations = bestIterations;
  uniform = scene.uniform;
  bodies = scene.bodies.map((body) => make(body, scene.allow_sleep));
  scene.joints.forEach(connect);
  for (const { body, force } of scene.forces) bodies[body].addForce(vector(force), true); // it stays until it is reset
}

function replace(index, body) {
  world.removeRigidBody(bodies[index]);
  bodies[index] = make(body, false);
}

function launch(index, velocity) {
  bodies[index].setLinvel(vector(velocity), true);
  bodies[index].setAngvel(vector([0, 0, 0]), true);
}

// What a frame asks, made before it is asked. A shape or a ray of Rapier's lives as long as it is held.
let queries;
function take({ rays, casts, list_rays, radius, half_extents, overlap_radius }) {
  const ray = ([x, y, z, a, b, c]) => new RAPIER.Ray(vector([x, y, z]), vector([a, b, c]));
  const shapes = [new RAPIER.Ball(radius), new RAPIER.Cuboid(...half_extents)];
  queries = {
    rays: rays.map(ray),
    listed: rays.slice(0, list_rays).map(ray),
    casts: casts.map(([x, y, z, ...way], i) => ({ from: vector([x, y, z]), way: vector(way), shape: shapes[i % 2] })),
    large: new RAPIER.Ball(overlap_radius),
  };
}

const upright = { x: 0, y: 0, z: 0, w: 1 };
const bodiesOnly = RAPIER.QueryFilterFlags.EXCLUDE_FIXED;
let found = 0;
const count = () => { ++found; return true; };
const kinds = {
  ray: () => { for (const ray of queries.rays) found += world.castRay(ray, 1, true) === null ? 0 : 1; },
  cast: () => {
    for (const { from, way, shape } of queries.casts) {
      found += world.castShape(from, upright, way, shape, 0, 1, true) === null ? 0 : 1;
    }
  },
  overlap: () => {
    for (const { from } of queries.casts) world.intersectionsWithShape(from, upright, queries.large, count, bodiesOnly);
  },
  all_hits: () => { for (const ray of queries.listed) world.intersectionsWithRay(ray, 1, true, count, bodiesOnly); },
};
function ask(kind) {
  found = 0;
  kinds[kind]();
  return found;
}

// One object for all: garbage would be collected while steps are timed.
const at = { x: 0, y: 0, z: 0, w: 0 };
function tell(index, numbers, n) {
  const body = bodies[index];
  body.translation(at);
  numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z;
  body.rotation(at);
  numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z; numbers[n++] = at.w;
  body.linvel(at);
  numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z;
  body.angvel(at);
  numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z;
  numbers[n] = body.isSleeping() ? 0 : 1;
}

serve({ raise, free: () => world.free(), step: () => world.step(), tell, replace, launch, take, ask });
