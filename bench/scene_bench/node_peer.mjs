// Engines in Node share this: the protocol with node_engine.cpp, CPU time, turns. An engine's file is started as
// node ENGINE.mjs DIRECTORY_OF_THE_PACKAGE VARIANT. One request a line of JSON, answers as doubles, little-endian.
// SPDX-License-Identifier: MIT
//   {"scene": {...}}         builds it                  answer: 0, or the letters of the reason for which it is refused
//   {"reason": 0}            why it is refused                               answer: its letters, a number each
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

export const [, , directory, variant] = process.argv;
export const isBest = variant.endsWith("best");
export const pathInPackage = (...names) => join(directory, ...names);
// Standard output is the protocol's: what an engine prints goes to standard error.
console.log = console.info = console.error;
export const load = (...names) => import(pathToFileURL(pathInPackage(...names)).href);

class Refusal extends Error {}
/** Ends the building of a scene; the reason is a sentence that names the engine. */
export function refuse(reason) {
  throw new Refusal(reason);
}

/** v by quaternion q: v + 2 q x (q x v + w v). */
export function turned([x, y, z, w], [a, b, c]) {
  const p = y * c - z * b + w * a, q = z * a - x * c + w * b, r = x * b - y * a + w * c;
  return [a + 2 * (y * r - z * q), b + 2 * (z * p - x * r), c + 2 * (x * q - y * p)];
}
/** First q, then p. */
export function product([a, b, c, d], [x, y, z, w]) {
  return [
    d * x + a * w + b * z - c * y, d * y - a * z + b * w + c * x,
    d * z + a * y - b * x + c * w, d * w - a * x - b * y - c * z,
  ];
}
export const inverse = ([x, y, z, w]) => [-x, -y, -z, w];
export const sum = (a, b) => a.map((value, i) => value + b[i]);
export const scaled = (a, by) => a.map((value) => value * by);
/** The axis of a joint's end, in its body's frame, and two across it. */
export const axisOf = (end) => turned(end.axes, [0, 0, 1]);
export const acrossOf = (end) => turned(end.axes, [1, 0, 0]);
/** Turns x to z: a joint's axes for an engine whose joints slide and turn about x. */
export const xToZ = (q) => product(q, [0, -Math.SQRT1_2, 0, Math.SQRT1_2]);

/** Each pair of bodies that may not meet, by number, the lower first: joined bodies, and those of one group. */
export function pairsApart({ bodies, joints }) {
  const pairs = joints.filter(({ a, collide }) => a >= 0 && !collide).map(({ a, b }) => (a < b ? [a, b] : [b, a]));
  const groups = new Map();
  bodies.forEach(({ group }, i) => groups.set(group, [...(groups.get(group) ?? []), i]));
  groups.delete(0);
  const meet = (members) => members.forEach((a, i) => members.slice(i + 1).forEach((b) => pairs.push([a, b])));
  groups.forEach(meet);
  return pairs;
}

/** The engine's functions for a scene: raise(scene) and free(), step(), tell(i, numbers, from), replace, launch. */
let engine, numbers, reason = "";

// Functions are compiled when they are first called, so a world is thrown away before the one that counts.
const warmSteps = 30, warmTime = 1000; // [1], [ms] at most: some steps of some engines take a second
function warm(scene) {
  engine.raise(scene);
  const end = performance.now() + warmTime;
  for (let i = 0; i < warmSteps && performance.now() < end; ++i) engine.step();
  engine.free();
}
function build(scene) {
  try {
    warm(scene);
    engine.raise(scene);
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    reason = error.message;
    return [reason.length];
  }
  numbers = new Float64Array(14 * scene.bodies.length);
  return [0];
}

function timed(work) {
  const start = process.cpuUsage();
  work();
  const { user, system } = process.cpuUsage(start);
  return (user + system) / 1000;
}
function steps(count) {
  return [timed(() => { for (let i = 0; i < count; ++i) engine.step(); })];
}
// One array for all: garbage would be collected while steps are timed.
function state() {
  for (let n = 0; n < numbers.length; n += 14) engine.tell(n / 14, numbers, n);
  return numbers;
}
function ask(kind) {
  let found = 0;
  const ms = timed(() => { found = engine.ask(kind); });
  return [ms, found];
}
const silent = (work) => (value) => { work(value); return [0]; };

function answer(doubles) {
  const { buffer } = doubles instanceof Float64Array ? doubles : Float64Array.from(doubles);
  const bytes = Buffer.from(buffer);
  try {
    for (let sent = 0; sent < bytes.length;) sent += writeSync(1, bytes, sent);
  } catch (error) {
    if (error.code !== "EPIPE") throw error;
    process.exit(); // nobody waits for it any more
  }
}

/** Answers until the other side is done with this process. */
export function serve(served) {
  engine = served;
  const verbs = {
    scene: build,
    reason: () => [...reason].map((letter) => letter.charCodeAt(0)),
    replace: silent(([i, body]) => engine.replace(i, body)),
    launch: silent(([i, velocity]) => engine.launch(i, velocity)),
    take: silent((queries) => engine.take(queries)),
    steps, state, ask,
  };
  const chunk = Buffer.alloc(1 << 16);
  let pending = [];
  for (let size; (size = readSync(0, chunk)) > 0;) {
    let from = 0;
    for (let end; (end = chunk.subarray(0, size).indexOf(10, from)) >= 0; from = end + 1) {
      const line = Buffer.concat([...pending, chunk.subarray(from, end)]).toString();
      pending = [];
      const [[verb, value]] = Object.entries(JSON.parse(line));
      answer(verbs[verb](value));
    }
    if (from < size) pending.push(Buffer.from(chunk.subarray(from, size)));
  }
}
