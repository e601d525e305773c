// What calls from JavaScript cost, and a frame of 1000 bodies: node costs.mjs FOLDER SCALAR
// SPDX-License-Identifier: MIT
//
// FOLDER: where the package is installed. Prints lines "what value unit". Each figure is the least of several rounds,
// in CPU time of this process, for others work on the machine as well. costs.cpp has the same scene natively.

import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const [, , folder, scalar] = process.argv;
const {load} = await import(pathToFileURL(join(resolve(folder), 'node_modules/isostep/lib/index.js')));
const iso = await load(scalar);

/** [us] of one `work()`, the least of the rounds. */
function cost(times, rounds, work) {
  let least = Infinity;
  for (let round = 0; round < rounds; ++round) {
    const before = process.cpuUsage();
    for (let i = 0; i < times; ++i) work(i);
    const {user, system} = process.cpuUsage(before);
    least = Math.min(least, (user + system) / times);
  }
  return least;
}
const print = (what, value, unit) => console.log(`${what} ${value.toPrecision(3)} ${unit}`);

/** 1000 boxes in ten layers that fall and come to rest, none of them asleep. */
function thousand() {
  const world = iso.createWorld({allowSleep: false});
  const box = world.addShape('box', {halfExtents: [0.5, 0.5, 0.5]});
  world.createBody({shape: world.addShape('box', {halfExtents: [50, 1, 50]}), position: [0, -1, 0]});
  const bodies = [];
  for (let i = 0; i < 1000; ++i) {
    const [x, y, z] = [i % 10, Math.floor(i / 100), Math.floor(i / 10) % 10];
    const position = [1.25 * x - 5, 0.5 + 1.0625 * y, 1.25 * z - 5];
    bodies.push(world.createBody({type: 'dynamic', shape: box, position}));
  }
  for (let i = 0; i < 60; ++i) world.step();
  return {world, bodies};
}

const {world, bodies} = thousand();
const {exports} = world.module;
print('hash', Number(world.hash >> 32n), 'of 2^32');
print('call_bare', 1000 * cost(100000, 10, () => exports.iso_world_tick(world.at)), 'ns');
print('call_tick', 1000 * cost(100000, 10, () => world.tick), 'ns');
print('call_impulse', 1000 * cost(20000, 10, i => world.applyImpulse(bodies[i % 1000], [0, 0, 0])), 'ns');
print('call_body', 1000 * cost(20000, 10, i => world.body(bodies[i % 1000])), 'ns');
const ray = i => world.castRay({origin: [i % 10 - 5, 20, 0], translation: [0, -30, 0]});
print('call_ray', 1000 * cost(5000, 10, ray), 'ns');

// *_bare: the module's own functions, so that what JavaScript adds is the difference.
const {calls} = world;
calls.begin();
const found = calls.take(4), count = calls.take(4);
const stepBare = () => exports.iso_world_step(world.at, 0);
const posesBare = () => exports.iso_world_poses(world.at, 0.5, found, count);
let sum = 0;
const readPoses = () => {
  const {numbers, stride, length} = world.poses(0.5);
  for (let i = 0; i < length; ++i) sum += numbers[i * stride + 3];
};
print('step_bare', cost(20, 10, stepBare), 'us');
print('step', cost(20, 10, () => world.step()), 'us');
print('poses_bare', cost(1000, 10, posesBare), 'us');
print('poses_fetched', cost(1000, 10, () => world.poses(0.5)), 'us');
print('poses_read', cost(1000, 10, readPoses), 'us');
print('frame_bare', cost(20, 10, () => {
  stepBare();
  posesBare();
}), 'us');
print('frame', cost(20, 10, () => {
  world.step();
  readPoses();
}), 'us');
const snapshot = world.createSnapshot();
print('save', cost(100, 10, () => world.save(snapshot)), 'us');
print('memory', iso.memorySize / 2 ** 20, 'MB');
if (!(sum > 0)) throw new Error('no poses');
