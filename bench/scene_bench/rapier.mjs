// Rapier's side of rapier_engine.cpp: node rapier.mjs DIRECTORY_OF_THE_PACKAGE. One request a line of JSON, answers as
// doubles, little-endian.
// SPDX-License-Identifier: MIT
//   {"scene": {...}}         builds it                                       answer: 0
//   {"replace": [i, body]}   body i is gone, another takes its place         answer: 0
//   {"steps": n}             steps                                           answer: CPU time of them all [ms]
//   {"state": 0}             where everything is     answer: 13 doubles a body (position, quaternion x y z w, velocity,
//                                                    spin), then the number of awake dynamic bodies
// CPU time is that of this process, all threads, in whole microseconds: other work on the machine does not count.
import { readSync, writeSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const { default: RAPIER } = await import(pathToFileURL(join(process.argv[2], "dist", "rapier.mjs")).href);
await RAPIER.init();

const vector = ([x, y, z]) => ({ x, y, z });
const rotation = ([x, y, z, w]) => ({ x, y, z, w });
let world, bodies;

function collider(part, body) {
  const description =
    part.type === "sphere" ? RAPIER.ColliderDesc.ball(part.radius)
    : part.type === "capsule" ? RAPIER.ColliderDesc.capsule(part.half_height, part.radius)
    : RAPIER.ColliderDesc.cuboid(...part.half_extents);
  description.setTranslation(...part.position).setRotation(rotation(part.orientation));
  description.setFriction(body.friction).setRestitution(0);
  if (!body.collide) description.setCollisionGroups(0);
  if (body.type === "dynamic") {
    const none = { x: 0, y: 0, z: 0 };
    description.setMassProperties(body.mass, none, vector(body.inertia), { ...none, w: 1 });
  }
  return description;
}

function make(body, allowSleep) {
  const kinds = { fixed: "fixed", kinematic: "kinematicVelocityBased", dynamic: "dynamic" };
  const description = RAPIER.RigidBodyDesc[kinds[body.type]]();
  description.setTranslation(...body.position).setRotation(rotation(body.orientation));
  description.setLinvel(...body.velocity).setAngvel(vector(body.spin)).setCanSleep(allowSleep);
  const made = world.createRigidBody(description);
  for (const part of body.parts) world.createCollider(collider(part, body), made);
  return made;
}

// Anchors are given in the bodies' own frames; body -1 is the world.
function connect({ a, b, on_a, on_b }) {
  const holder = a < 0 ? world.createRigidBody(RAPIER.RigidBodyDesc.fixed()) : bodies[a];
  const joint = RAPIER.JointData.spherical(vector(on_a), vector(on_b));
  world.createImpulseJoint(joint, holder, bodies[b], true).setContactsEnabled(false);
}

function raise(scene) {
  world = new RAPIER.World(vector(scene.gravity));
  world.timestep = 1 / 60;
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

function steps(count) {
  const start = process.cpuUsage();
  for (let i = 0; i < count; ++i) world.step();
  const { user, system } = process.cpuUsage(start);
  return [(user + system) / 1000];
}

// One object and one array for all: garbage would be collected while steps are timed.
const at = { x: 0, y: 0, z: 0, w: 0 };
let numbers = new Float64Array(0);
function state() {
  if (numbers.length === 0) numbers = new Float64Array(13 * bodies.length + 1);
  let n = 0;
  let awake = 0;
  for (const body of bodies) {
    body.translation(at);
    numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z;
    body.rotation(at);
    numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z; numbers[n++] = at.w;
    body.linvel(at);
    numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z;
    body.angvel(at);
    numbers[n++] = at.x; numbers[n++] = at.y; numbers[n++] = at.z;
    if (body.isDynamic() && !body.isSleeping()) ++awake;
  }
  numbers[n] = awake;
  return numbers;
}

function answer(doubles) {
  const { buffer } = doubles instanceof Float64Array ? doubles : Float64Array.from(doubles);
  const bytes = Buffer.from(buffer);
  for (let sent = 0; sent < bytes.length;) sent += writeSync(1, bytes, sent);
}

const verbs = { scene: build, replace, steps, state };
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
