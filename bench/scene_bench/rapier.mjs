// Rapier's side of rapier_engine.cpp: node rapier.mjs DIRECTORY_OF_THE_PACKAGE. One request a line of JSON, answers as
// doubles, little-endian.
// SPDX-License-Identifier: MIT
//   {"scene": {...}}         builds it                                       answer: 0
//   {"replace": [i, body]}   body i is gone, another takes its place         answer: 0
//   {"launch": [i, v]}       body i flies off with velocity v [m/s]          answer: 0
//   {"steps": n}             steps                                           answer: CPU time of them all [ms]
//   {"state": 0}             where everything is     answer: 14 doubles a body (position, quaternion x y z w, velocity,
//                                                    angular velocity, whether it is awake)
//   {"take": {...}}          the queries of a frame                          answer: 0
//   {"ask": "ray"}           asks all of one kind                            answer: CPU time of them all [ms], hits
// CPU time is that of this process, all threads, in whole microseconds: other work on the machine does not count.
import { readSync, writeSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const { default: RAPIER } = await import(pathToFileURL(join(process.argv[2], "dist", "rapier.mjs")).href);
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

// By quaternion q: v + 2 q x (q x v + w v).
function turned([x, y, z, w], [a, b, c]) {
  const p = y * c - z * b + w * a, q = z * a - x * c + w * b, r = x * b - y * a + w * c;
  return [a + 2 * (y * r - z * q), b + 2 * (z * p - x * r), c + 2 * (x * q - y * p)];
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

// Rapier slides along x.
const xToZ = (q) => {
  const [x, y, z, w] = q, h = Math.SQRT1_2;
  return rotation([h * (x + z), h * (y - w), h * (z - x), h * (w + y)]);
};

// Ends are given in the bodies' own frames, z the axis of a hinge or slider; body -1 is the world.
function connect({ type, a, b, on_a, on_b, motor, limits, rest, stiffness, damping, length, collide }) {
  const holder = a < 0 ? world.createRigidBody(RAPIER.RigidBodyDesc.fixed()) : bodies[a];
  const p = vector(on_a.anchor), q = vector(on_b.anchor), z = [0, 0, 1];
  const axis = (end) => vector(turned(end.axes, z));
  const joint =
    type === "ball" ? RAPIER.JointData.spherical(p, q)
    : type === "hinge" ? RAPIER.JointData.revoluteWithAxes(p, q, axis(on_a), axis(on_b))
    : type === "slider" ? RAPIER.JointData.prismatic(p, q, vector([1, 0, 0]))
    : type === "fixed" ? RAPIER.JointData.fixed(p, rotation(on_a.axes), q, rotation(on_b.axes))
    : type === "spring" ? RAPIER.JointData.spring(rest, stiffness, damping, p, q)
    : RAPIER.JointData.rope(length, p, q);
  const made = world.createImpulseJoint(joint, holder, bodies[b], true);
  made.setContactsEnabled(collide);
  if (limits !== null) made.setLimits(...limits); // those of JointData are a slider's alone
  if (type === "slider") {
    made.setFrameX1(xToZ(on_a.axes));
    made.setFrameX2(xToZ(on_b.axes));
  }
  if (motor !== null) {
    const [speed, force] = motor;
    made.configureMotorVelocity(speed, stiff);
    made.setMotorMaxForce(force);
  }
}

function raise(scene) {
  world = new RAPIER.World(vector(scene.gravity));
  world.timestep = 1 / 60;
  uniform = scene.uniform;
  bodies = scene.bodies.map((body) => make(body, scene.allow_sleep));
  scene.joints.forEach(connect);
}

// Functions are compiled when they are first called, so a world is thrown away before the one that counts.
function build(scene) {
  raise(scene);
  for (let i = 0; i < 30; ++i) world.step();
  world.free();
  raise(scene);
  return [0];
}

function replace([index, body]) {
  world.removeRigidBody(bodies[index]);
  bodies[index] = make(body, false);
  return [0];
}

function launch([index, velocity]) {
  bodies[index].setLinvel(vector(velocity), true);
  bodies[index].setAngvel(vector([0, 0, 0]), true);
  return [0];
}

function steps(count) {
  const start = process.cpuUsage();
  for (let i = 0; i < count; ++i) world.step();
  const { user, system } = process.cpuUsage(start);
  return [(user + system) / 1000];
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
  return [0];
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
  const start = process.cpuUsage();
  kinds[kind]();
  const { user, system } = process.cpuUsage(start);
  return [(user + system) / 1000, found];
}

// One object and one array for all: garbage would be collected while steps are timed.
const at = { x: 0, y: 0, z: 0, w: 0 };
let numbers = new Float64Array(0);
function state() {
  if (numbers.length === 0) numbers = new Float64Array(14 * bodies.length);
  let n = 0;
  for (const body of bodies) {
    body.translation(at);
    numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z;
    body.rotation(at);
    numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z; numbers[n++] = at.w;
    body.linvel(at);
    numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z;
    body.angvel(at);
    numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z;
    numbers[n++] = body.isSleeping() ? 0 : 1;
  }
  return numbers;
}

function answer(doubles) {
  const { buffer } = doubles instanceof Float64Array ? doubles : Float64Array.from(doubles);
  const bytes = Buffer.from(buffer);
  for (let sent = 0; sent < bytes.length;) sent += writeSync(1, bytes, sent);
}

const verbs = { scene: build, replace, launch, steps, state, take, ask };
const chunk = Buffer.alloc(1 << 16);
let pending = [];
for (;;) {
  const size = readSync(0, chunk);
  if (size === 0) break; // the benchmark is done with this process
  let from = 0;
  for (let end; (end = chunk.subarray(0, size).indexOf(10, from)) >= 0; from = end + 1) {
    const line = Buffer.concat([...pending, chunk.subarray(from, end)]).toString();
    pending = [];
    const [[verb, value]] = Object.entries(JSON.parse(line));
    answer(verbs[verb](value));
  }
  if (from < size) pending.push(Buffer.from(chunk.subarray(from, size)));
}
