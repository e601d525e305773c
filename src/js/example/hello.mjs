// A crate falls twice from one saved frame; prints what src/examples/four_scalars.cpp prints of q32: node hello.mjs
// SPDX-License-Identifier: MIT

// README: begin hello
import {load} from 'isostep';
const world = (await load('q32')).createWorld({hz: 60, substeps: 8, gravity: [0, -10, 0]});  // or f32, f64, q16
world.createBody({shape: world.addShape('box', {halfExtents: [50, 1, 50]}), position: [0, -1, 0]});
const crate = world.addShape('box', {halfExtents: [0.5, 0.5, 0.5]});
const body = world.createBody({type: 'dynamic', shape: crate, position: [0, 2, 0], userData: 42n});
world.applyImpulse(body, [0, 3, 0]);
const start = world.createSnapshot();
world.save(start);
const hashes = [1, 2].map(() => {
  world.load(start);                                          // same ids, same future
  for (let i = 0; i < 120; ++i) world.step();
  return world.hash;                                          // a BigInt, the same on every machine
});
console.log('q32', hashes[0].toString(16).padStart(16, '0'), hashes[0] === hashes[1] ? 'equal' : 'DIFFERENT');
// README: end
