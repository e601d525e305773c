// The crate of hello.cpp in every scalar that the npm package has; prints what four_scalars.c prints.
// SPDX-License-Identifier: MIT
import {load} from 'isostep';

for (const family of ['f32', 'f64', 'q16', 'q32']) {
  const iso = await load(family);
  const world = iso.createWorld({hz: 60, substeps: 8, gravity: [0, -10, 0]});
  const ground = world.addShape('box', {halfExtents: [50, 1, 50]});
  world.createBody({shape: ground, position: [0, -1, 0]});
  const crate = world.addShape('box', {halfExtents: [0.5, 0.5, 0.5]});
  const body = world.createBody({type: 'dynamic', shape: crate, position: [0, 2, 0], userData: 42n});
  world.applyImpulse(body, [0, 3, 0]);
  const frame = world.createSnapshot();
  world.save(frame);
  const hashes = [];
  for (let run = 0; run < 2; ++run) {
    world.load(frame);
    for (let i = 0; i < 120; ++i) world.step();
    hashes.push(world.hash);
  }
  const equal = hashes[0] === hashes[1];
  console.log(`${family} ${hashes[0].toString(16).padStart(16, '0')} ${equal ? 'equal' : 'DIFFERENT'}`);
  if (!equal) process.exitCode = 1;
}
