// MuJoCo (double) as node_peer.mjs asks it: a scene becomes its text, MJCF. Variants: none, and best with the settings
// that its documentation names for contacts that neither slip nor give. Joints that form trees are coordinates, as
// MuJoCo means them; what closes a loop is an equality.
// SPDX-License-Identifier: MIT
import { readFileSync } from "node:fs";
import {
  axisOf, inverse, isBest, load, pairsApart, pathInPackage, product, refuse, scaled, serve, sum, turned,
} from "./node_peer.mjs";

const { default: start } = await load("mujoco.js");
const MJ = await start({ wasmBinary: readFileSync(pathInPackage("mujoco.wasm")) });

let model, data, scene, nodes, order, ids;

const dot = (a, b) => a.reduce((total, value, i) => total + value * b[i], 0);
const text = (numbers) => numbers.join(" ");
const quat = ([x, y, z, w]) => text([w, x, y, z]);
const element = (name, attributes, inside = "") => {
  const words = Object.entries(attributes).map(([key, value]) => ` ${key}="${value}"`).join("");
  return `<${name}${words}${inside === "" ? "/>" : `>${inside}</${name}>`}`;
};

/** Turns z, the normal of its planes, to a direction. */
function zTo([x, y, z]) {
  const q = z > -0.999 ? [-y, x, 0, 1 + z] : [1, 0, 0, 0];
  return scaled(q, 1 / Math.hypot(...q));
}
const unturned = [0, 0, 0, 1];
const lying = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2]; // takes z, along which its capsules lie, to y
function geomShape(part, name) {
  const { type, radius, half_height: half, position, orientation } = part;
  const placed = (words, turn = unturned) => ({
    pos: text(position), quat: quat(product(orientation, turn)), ...words,
  });
  switch (type) {
    case "sphere": return placed({ type, size: radius });
    case "capsule":
    case "cylinder": return placed({ type, size: text([radius, half]) }, lying);
    case "box": return placed({ type, size: text(part.half_extents) });
    case "half_space": {
      const normal = turned(orientation, part.normal);
      const pos = text(sum(position, scaled(normal, part.offset)));
      return { type: "plane", size: "0 0 1", pos, quat: quat(zTo(normal)) };
    }
    case "hull": return { type: "mesh", mesh: name };
    default: return refuse(`MuJoCo is given no ${type.replace("_", " ")}`);
  }
}
const geomName = (body, part) => `g${body}_${part}`;
const plainFriction = "0.005 0.0001"; // of turning and rolling, as by default; contacts have neither
function geoms(body, index) {
  const bits = body.collide ? {} : { contype: 0, conaffinity: 0 };
  return body.parts.map((part, i) => {
    const name = geomName(index, i);
    return element("geom", { name, ...geomShape(part, name), friction: `${body.friction} ${plainFriction}`, ...bits });
  }).join("");
}
function meshes() {
  return scene.bodies.map(({ parts }, i) => parts.map((part, k) => (part.type !== "hull" ? ""
    : element("mesh", { name: geomName(i, k), vertex: text(part.points.flat()) }))).join("")).join("");
}

// The forest: each body has a parent, -1 the world, and the joint to it, or none and is free.

const isHeld = ({ type }) => type === "ball" || type === "hinge" || type === "servo" || type === "slider"
  || type === "fixed";
function plantForest() {
  nodes = scene.bodies.map(() => ({ parent: -1, joint: null, children: [], planted: false }));
  const near = new Map();
  const meet = (body, joint) => near.set(body, [...(near.get(body) ?? []), joint]);
  scene.joints.filter(isHeld).forEach((joint) => [joint.a, joint.b].forEach((body) => meet(body, joint)));
  const isUsed = new Set();
  const grow = (root) => {
    for (const queue = [root]; queue.length > 0;) {
      const parent = queue.shift();
      for (const joint of near.get(parent) ?? []) {
        const child = joint.a === parent ? joint.b : joint.a;
        if (isUsed.has(joint) || child < 0 || nodes[child].planted) continue;
        isUsed.add(joint);
        Object.assign(nodes[child], { parent, joint, planted: true });
        if (parent >= 0) nodes[parent].children.push(child);
        queue.push(child);
      }
    }
  };
  scene.bodies.forEach(({ type }, i) => { nodes[i].planted = type === "fixed"; });
  grow(-1);
  scene.bodies.forEach(({ type }, i) => { if (type === "fixed") grow(i); });
  nodes.forEach((node, i) => {
    if (node.planted) return;
    node.planted = true;
    grow(i);
  });
  return scene.joints.filter((joint) => isHeld(joint) && !isUsed.has(joint));
}
const isFree = (index) => nodes[index].joint === null && scene.bodies[index].type !== "fixed";

/** The joint's end on the child, and its axis there, about which the child turns as b does against a. */
function endOfChild(index) {
  const { joint } = nodes[index];
  return joint.b === index ? [joint.on_b, axisOf(joint.on_b)] : [joint.on_a, scaled(axisOf(joint.on_a), -1)];
}
const names = { ball: "ball", hinge: "hinge", servo: "hinge", slider: "slide" };
function jointText(index) {
  const { joint } = nodes[index];
  if (joint === null) return scene.bodies[index].type === "fixed" ? "" : element("freejoint", {});
  if (joint.type === "fixed") return "";
  if (joint.cone > 0) refuse("MuJoCo's ball has one limit for every turn, not a cone and a twist");
  const [end, axis] = endOfChild(index);
  const limits = joint.limits === null ? {} : { limited: "true", range: text(joint.limits) };
  const place = { pos: text(end.anchor), axis: text(axis) };
  const { rest, stiffness, damping } = joint;
  const spring = joint.type === "servo" ? { springref: rest, stiffness, damping } : {};
  return element("joint", { name: `j${index}`, type: names[joint.type], ...place, ...limits, ...spring });
}
function bodyText(index) {
  const body = scene.bodies[index], { parent, children } = nodes[index];
  order.push(index);
  const frame = parent < 0 ? { position: [0, 0, 0], orientation: unturned } : scene.bodies[parent];
  const back = inverse(frame.orientation);
  const pos = turned(back, body.position.map((value, i) => value - frame.position[i]));
  const inertial = body.type === "fixed" ? "" : element("inertial",
    { pos: "0 0 0", mass: body.mass, diaginertia: text(body.inertia) });
  const inside = jointText(index) + inertial + geoms(body, index) + sites(index) + children.map(bodyText).join("");
  const place = { name: `b${index}`, pos: text(pos), quat: quat(product(back, body.orientation)) };
  return element("body", { ...place, gravcomp: 1 - body.gravity_scale }, inside);
}

// Rods, ropes and springs are tendons between two sites.

const isTendon = ({ type }) => type === "rod" || type === "rope" || type === "spring";
const siteName = (joint, end) => `s${joint}${end}`;
function sites(index) {
  return scene.joints.map((joint, i) => (!isTendon(joint) ? "" : ["a", "b"].map((end) => (joint[end] !== index ? ""
    : element("site", { name: siteName(i, end), pos: text(joint[`on_${end}`].anchor) }))).join(""))).join("");
}
function tendon({ type, shortest, length, rest, stiffness, damping }, i) {
  const ends = ["a", "b"].map((end) => element("site", { site: siteName(i, end) })).join("");
  const words = type === "spring" ? { springlength: rest, stiffness, damping }
    : type === "rope" || shortest < length ? { limited: "true", range: text([shortest, length]) } : {};
  return element("spatial", { name: `t${i}`, ...words }, ends);
}
const tendons = () => scene.joints.map((joint, i) => (isTendon(joint) ? tendon(joint, i) : "")).join("");
const heldTendons = () => scene.joints.map(({ type, shortest, length }, i) => (type !== "rod" || shortest < length ? ""
  : element("tendon", { tendon1: `t${i}` }))).join("");

/** A joint that closes a loop: a hinge is held at two points of its axis. */
const hingeHalf = 0.5; // [m]
function loop({ type, a, b, on_b: on, limits, motor }) {
  if (limits !== null || motor !== null || type === "slider" || type === "servo") {
    refuse("MuJoCo is given no slider, limit, motor or spring that closes a loop of joints");
  }
  const bodies = { body1: `b${b}`, ...(a < 0 ? {} : { body2: `b${a}` }) };
  if (type === "fixed") return element("weld", bodies);
  const at = (way) => element("connect", { ...bodies, anchor: text(sum(on.anchor, scaled(axisOf(on), way))) });
  return type === "ball" ? at(0) : at(-hingeHalf) + at(hingeHalf);
}

/** [kg m^2] or [kg] of a body that a joint turns about its axis, or pushes along it. */
function inertiaOn({ type }, index, end) {
  if (index < 0 || scene.bodies[index].type === "fixed") return Infinity;
  const { mass, inertia } = scene.bodies[index], axis = axisOf(end);
  if (type === "slider") return mass;
  const arm = sum(end.anchor, scaled(axis, -dot(end.anchor, axis)));
  return dot(inertia, axis.map((value) => value * value)) + mass * dot(arm, arm);
}
/** Damps the motor's joint so that a step brings the lighter body to its speed, with the force that it has. */
function motorText(index) {
  const { joint } = nodes[index], [, force] = joint.motor;
  const kv = Math.min(inertiaOn(joint, joint.a, joint.on_a), inertiaOn(joint, joint.b, joint.on_b)) * scene.hz;
  return element("velocity", { joint: `j${index}`, kv, forcerange: text([-force, force]) });
}
const motors = () => order.filter((index) => nodes[index].joint !== null && nodes[index].joint.motor !== null);

// MuJoCo takes the larger friction of a pair; pairs for which that is wrong are named one by one.
const mostPairs = 20000;
function pairs(apart) {
  const isApart = new Set(apart.map(([a, b]) => `${a} ${b}`)), made = [];
  scene.bodies.forEach((a, i) => scene.bodies.slice(i + 1).forEach((b, n) => {
    const k = i + 1 + n, friction = Math.sqrt(a.friction * b.friction);
    if (a.friction === b.friction || isApart.has(`${i} ${k}`) || !a.collide || !b.collide) return;
    if (a.type === "fixed" && b.type === "fixed") return;
    a.parts.forEach((_, p) => b.parts.forEach((__, q) => made.push(element("pair", {
      geom1: geomName(i, p), geom2: geomName(k, q), friction: `${friction} ${friction} ${plainFriction} 0.0001`,
    }))));
    if (made.length > mostPairs) refuse("MuJoCo takes the larger friction of a pair, and no more than 20000 pairs are given another");
  }));
  return made.join("");
}
function contacts() {
  const apart = pairsApart(scene);
  const excludes = apart.map(([a, b]) => element("exclude", { body1: `b${a}`, body2: `b${b}` })).join("");
  return excludes + (scene.uniform ? "" : pairs(apart));
}

const noSlip = 10, iterations = 200, tolerance = 1e-10; // its defaults are 0, 100 and 1e-8
function options(hasMotors) {
  const words = { timestep: 1 / scene.hz, gravity: text(scene.gravity) };
  // The servo of a speed is stable by an implicit step alone, as its documentation says.
  if (hasMotors || isBest) words.integrator = "implicitfast";
  const best = { cone: "elliptic", solver: "Newton", iterations, tolerance, noslip_iterations: noSlip };
  if (isBest) Object.assign(words, best);
  // Bodies on one joint meet or not as the scene says; a world that has burst does not begin anew.
  return element("option", words, element("flag", { filterparent: "disable", autoreset: "disable" }));
}
// Contacts as stiff and hard as a step of this length lets them be: two steps are the least time that it takes.
function defaults() {
  if (!isBest) return "";
  const words = { solref: `${2 / scene.hz} 1`, solimp: "0.99 0.999 0.001" };
  return element("default", {}, ["geom", "pair", "equality"].map((name) => element(name, words)).join(""));
}
const megabytes = 600; // for contacts: more than a thousand bodies in a pile have
function write() {
  const loops = plantForest();
  order = [];
  const roots = nodes.map((_, i) => i).filter((i) => nodes[i].parent < 0);
  const bodies = roots.map(bodyText).join("") + sites(-1);
  const equalities = loops.map(loop).join("") + heldTendons();
  const actuators = motors().map(motorText).join("");
  const parts = { asset: meshes(), worldbody: bodies, tendon: tendons(), contact: contacts(), equality: equalities };
  const inside = Object.entries(parts).map(([name, of]) => (of === "" ? "" : element(name, {}, of))).join("");
  return element("mujoco", {}, element("compiler", { angle: "radian", inertiafromgeom: "false" })
    + options(actuators !== "") + element("size", { memory: `${megabytes}M` }) + defaults() + inside
    + (actuators === "" ? "" : element("actuator", {}, actuators)));
}

/** The joint's speeds that go with the bodies' velocities. */
function speedsOf(index) {
  const body = scene.bodies[index], { parent, joint } = nodes[index];
  const back = inverse(body.orientation);
  if (joint === null) return [...body.velocity, ...turned(back, body.angular_velocity)];
  const still = { velocity: [0, 0, 0], angular_velocity: [0, 0, 0] }, from = parent < 0 ? still : scene.bodies[parent];
  const relative = (name) => turned(back, body[name].map((value, i) => value - from[name][i]));
  if (joint.type === "ball") return relative("angular_velocity");
  return [dot(relative(joint.type === "slider" ? "velocity" : "angular_velocity"), endOfChild(index)[1])];
}
const dofsOf = (index) => model.body_dofadr[1 + order.indexOf(index)];
function setMotion(index) {
  const body = scene.bodies[index], at = dofsOf(index);
  if (body.type === "fixed" || at < 0) return;
  data.qvel.set(speedsOf(index), at);
  const { linear_damping: linear, angular_damping: angular } = body;
  if (linear === 0 && angular === 0) return;
  if (!isFree(index)) refuse("MuJoCo is given no damping of bodies that hang on joints");
  model.dof_damping.set([...[1, 1, 1].map((one) => one * linear * body.mass), ...scaled(body.inertia, angular)], at);
}

function requireKnown({ bodies, gears }) {
  if (gears.length > 0) refuse("MuJoCo is given no gears");
  for (const { type, restitution } of bodies) {
    if (type === "kinematic") refuse("MuJoCo's bodies that are moved have no velocity by which others are moved");
    if (restitution > 0) refuse("MuJoCo has no coefficient of restitution");
  }
}
function raise(given) {
  scene = given;
  requireKnown(scene);
  const words = write();
  try {
    model = MJ.MjModel.from_xml_string(words);
  } catch (error) {
    refuse(error.message.split("\n")[0]);
  }
  data = new MJ.MjData(model);
  const places = new Map(order.map((index, i) => [index, i + 1]));
  scene.forces.forEach(({ body, force }) => data.xfrc_applied.set(force, 6 * places.get(body))); // it stays
  scene.bodies.forEach((_, index) => setMotion(index));
  motors().forEach((index, i) => { data.ctrl[i] = nodes[index].joint.motor[0]; });
  ids = scene.bodies.map((_, index) => places.get(index));
}
function free() {
  data.delete();
  model.delete();
}

function launch(index, velocity) {
  if (!isFree(index)) throw new Error("only a free body flies off");
  data.qvel.set([...velocity, 0, 0, 0], dofsOf(index));
}

// Places and velocities are those of the step's beginning until they are asked for.
let views;
function refresh() {
  MJ.mj_kinematics(model, data);
  MJ.mj_comPos(model, data);
  MJ.mj_comVel(model, data);
  const { xpos, xquat, cvel, subtree_com: centre } = data;
  views = { xpos, xquat, cvel, centre, root: model.body_rootid };
}
function tell(index, numbers, n) {
  if (index === 0) refresh();
  const id = ids[index], { xpos, xquat, cvel, centre, root } = views;
  const arm = [0, 1, 2].map((i) => xpos[3 * id + i] - centre[3 * root[id] + i]);
  const [a, b, c, u, v, w] = cvel.subarray(6 * id, 6 * id + 6);
  numbers.set(xpos.subarray(3 * id, 3 * id + 3), n);
  [1, 2, 3, 0].forEach((from, i) => { numbers[n + 3 + i] = xquat[4 * id + from]; });
  numbers.set([u + b * arm[2] - c * arm[1], v + c * arm[0] - a * arm[2], w + a * arm[1] - b * arm[0]], n + 7);
  numbers.set([a, b, c, 1], n + 10);
}

serve({ raise, free, step: () => MJ.mj_step(model, data), tell, launch });
