// What is refused is an error with its place and rule, and changes nothing: node errors_test.mjs FOLDER
// SPDX-License-Identifier: MIT

import {check, done, equal, packaged, scalars, throws} from './checks.mjs';
import {createPucks, kConfig} from './pucks.mjs';

const {IsostepError, load} = await packaged('isostep');

for (const scalar of scalars) {
  const iso = await load(scalar);
  const world = iso.createWorld();
  const box = world.addShape('box', {halfExtents: [0.5, 0.5, 0.5]});
  const body = world.createBody({type: 'dynamic', shape: box, position: [0, 2, 0]});
  const hash = world.hash;
  const refused = (call, expected, what) => {
    throws(call, expected, `${scalar}: ${what}`);
    equal(world.hash, hash, `${scalar}: ${what} changes the world`);
  };

  // What JavaScript itself refuses to write: the place in the object.
  refused(() => world.createBody({shape: box, colour: 3}),
    {name: 'IsostepError', command: 'body_create', field: 'colour'}, 'an unknown member');
  refused(() => world.createBody({shape: box, material: {friction: 'high'}}),
    {field: 'material.friction', expected: 'a number'}, 'a text as a number');
  refused(() => world.createBody({shape: box, position: [0, 1]}),
    {field: 'position', expected: '3 numbers'}, 'a short vector');
  refused(() => world.createBody({shape: box, type: 'moving'}),
    {field: 'type', status: -8, expected: /"dynamic"/}, 'no enumerator');
  refused(() => world.createBody({shape: box, sensor: 1}),
    {field: 'sensor', expected: 'true or false'}, 'a number as a truth value');
  refused(() => world.createBody({shape: box, userData: -1}), {field: 'userData'}, 'a negative number of 64 bits');
  refused(() => world.createBody({shape: box, locks: 1.5}),
    {field: 'locks', expected: /integer/}, 'a fraction as an integer');
  refused(() => world.castRay({origin: [0, 5, 0], translation: [0, -1, 0], filter: {ignoreAll: [1.5]}}),
    {field: 'filter.ignoreAll[0]'}, 'a list');
  refused(() => world.applyImpulse(7, [0, 1, 0]), {field: 'body'}, 'a number as an id');
  refused(() => world.addShape('torus'), {field: 'kind', expected: /box/}, 'no shape');
  refused(() => world.add('thrustre', {}), {field: 'kind', expected: /thruster/}, 'no record');
  for (const ask of [() => world.get('thruster', 5n), () => world.set('thruster', 5n, {}),
    () => world.setInput('vehicle', 5n, {}), () => world.state('wheel', 5n)]) {
    refused(ask, {field: 'id', status: 1}, 'a record that is not there');
  }
  if (scalar[0] === 'q') {
    refused(() => world.applyImpulse(body, [NaN, 0, 0]), {command: 'body_apply_impulse', expected: 'a number'}, 'NaN');
    refused(() => world.applyImpulse(body, [1e12, 0, 0]), {expected: /-\d+ to below \d+/}, 'beyond the format');
  }

  // What the engine refuses: its own words.
  refused(() => world.destroyBody(body + (5n << 32n)), {status: 1, command: /destroy_body/}, 'a stale id');
  refused(() => world.createBody({shape: box, material: {friction: -1}}),
    {field: 'material.friction', command: 'create_body'}, 'friction below 0');
  refused(() => world.createBody({shape: 0n}), {status: 9}, 'no shape at all');
  refused(() => world.addShape('sphere', {radius: -1}), {command: 'add_shape'}, 'a radius below 0');
  refused(() => world.removeShape(box), {status: 7}, 'a shape in use');
  refused(() => world.read(new Uint8Array(50)), {status: -6}, 'rubbish as a state');
  refused(() => world.read('text'), {field: 'bytes'}, 'a text as bytes');
  refused(() => world.load(world.createSnapshot()), {}, 'a snapshot that nothing was saved to');
  throws(() => iso.createWorld({hz: 0}), {field: 'hz'}, `${scalar}: settings`);
  throws(() => iso.createWorld({solver: 'magic'}), {field: 'solver', command: 'world_create'}, `${scalar}: no solver`);
  throws(() => iso.createHull([[0, 0, 0], [1, 0, 0]]), {}, `${scalar}: a hull of two points`);
  throws(() => iso.createHeightField({columns: 2, rows: 2, pitch: 1, heights: [1]}),
    {field: 'heights'}, `${scalar}: a field`);
  equal(iso.verifyReplay(new Uint8Array(10).fill(7)).outcome, 'corrupt', `${scalar}: rubbish as a replay`);
  equal(iso.verifyReplay(new Uint8Array(10)).outcome, 'truncated', `${scalar}: zeros, as a power failure leaves them`);

  // Sessions and states.
  const game = createPucks(iso);
  throws(() => iso.createSession({...kConfig, host: true}, game),
    {status: -11, message: /seed/}, `${scalar}: a host without a seed`);
  throws(() => iso.createSession({...kConfig, mode: 'chess'}, game), {field: 'config.mode'}, `${scalar}: no mode`);
  throws(() => iso.createSession(kConfig, {}), {field: 'game'}, `${scalar}: no game`);
  throws(() => iso.createState({x: 'u128'}), {field: 'x'}, `${scalar}: no type`);
  const session = iso.createSession(kConfig, game);
  equal(session.addLocalInput(0, Uint8Array.of(1)), false, `${scalar}: an input of nobody's`);
  check(session.problem.length > 0, `${scalar}: and why`);
  throws(() => session.drive(-1), {field: 'now'}, `${scalar}: a time before 0`);
  session.dispose();

  // What is disposed of.
  world.dispose();
  world.dispose();
  equal(world.disposed, true, `${scalar}: disposed`);
  throws(() => world.step(), {status: -9, message: /world has been disposed of/}, `${scalar}: a world that is gone`);
  if (Symbol.dispose) check(world[Symbol.dispose] === world.dispose, `${scalar}: Symbol.dispose`);
}

for (const wrong of ['f16', '', undefined]) {
  const error = await load(wrong).catch(caught => caught);
  check(error instanceof IsostepError && error.field === 'scalar', `load(${wrong}): ${error}`);
}
const error = await load(scalars[0], {source: new Uint8Array([0, 1, 2])}).catch(caught => caught);
check(error instanceof WebAssembly.CompileError, `rubbish as a module: ${error}`);
done('refusals name their place');
