// Every frame of hello in Node has native's hash, in each scalar: node hello_test.mjs FOLDER HELLO_HASHES
// SPDX-License-Identifier: MIT

import {execFileSync} from 'node:child_process';

import {check, done, equal, packaged, scalars} from './checks.mjs';
import {playHello} from './hello.mjs';

const {load} = await packaged('isostep');
for (const scalar of scalars) {
  const native = execFileSync(process.argv[3], [scalar], {encoding: 'utf8'}).trim().split('\n');
  const hardest = Number(native.pop());
  const iso = await load(scalar);
  const here = playHello(iso);
  equal(here.hashes.length, 360, `${scalar}: frames`);
  equal(here.hashes, native, `${scalar}: hashes`);
  equal(here.hashes.slice(0, 120), here.hashes.slice(120, 240), `${scalar}: after the rollback`);
  check(new Set(here.hashes).size > 200, `${scalar}: nothing happens`);
  equal([here.user, here.hardest], [42, hardest], `${scalar}: what the ray hits, how hard it lands`);
  // Settings that are set in every frame take no input and no state back.
  const walked = stale => {
    const world = iso.createWorld();
    const capsule = world.addShape('capsule', {radius: 0.5, halfHeight: 0.5});
    const body = world.createBody({type: 'kinematic', shape: capsule, position: [0, 20, 0]});
    const walker = world.add('character', {body, stepHeight: 0.25});
    for (let frame = 0; frame < 60; ++frame) {
      if (stale) world.set('character', walker, {stepHeight: 0.25});
      world.setInput('character', walker, {move: [1, 0, 0]});
      world.step();
    }
    check(world.state('character', walker).velocity[1] < -5, `${scalar}: a walker does not fall`);
    equal(world.input('character', walker).move, [1, 0, 0], `${scalar}: its input`);
    return world.hash;
  };
  equal(walked(true), walked(false), `${scalar}: stale settings`);
  const driven = stale => {
    const world = iso.createWorld();
    const box = world.addShape('box', {halfExtents: [1, 0.5, 2]});
    const body = world.createBody({type: 'dynamic', shape: box, position: [0, 20, 0]});
    const engine = world.add('vehicle', {body, engineTorque: 100, engineInertia: 1, clutchTorque: 100});
    const wheel = world.add('wheel', {body, driveShare: 1});
    const copies = [world.get('vehicle', engine), world.get('wheel', wheel)];
    for (let frame = 0; frame < 60; ++frame) {
      if (stale) {
        world.set('vehicle', engine, copies[0]);
        world.set('wheel', wheel, copies[1]);
      }
      world.setInput('vehicle', engine, {throttle: 1});
      world.step();
    }
    // In the air 100 N m turn an engine and a wheel of 1 kg m^2 each for a second.
    const spins = [world.state('vehicle', engine).engineSpin, world.state('wheel', wheel).spin];
    check(spins.every(spin => Math.abs(spin - 50) < 0.01), `${scalar}: engine and wheel spin at ${spins}`);
    equal(world.input('vehicle', engine).throttle, 1, `${scalar}: the throttle`);
    return world.hash;
  };
  equal(driven(true), driven(false), `${scalar}: stale settings of a vehicle and its wheel`);
  const {sound, recordings, text} = iso.selfcheck();
  check(sound && recordings > 0, `${scalar}: ${text}`);
}
done(`360 frames of ${scalars.join(', ')} are native's`);
