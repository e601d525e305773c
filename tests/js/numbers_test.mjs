// Numbers cross as the engine itself converts them: node numbers_test.mjs FOLDER
// SPDX-License-Identifier: MIT

import {check, done, equal, packaged, scalars, throws} from './checks.mjs';

const {load} = await packaged('isostep');
/** Doubles of all sizes, halves between raw units among them. Source: xorshift, Marsaglia 2003, 13-17-5. */
function* samples(count) {
  let state = 2463534242;
  const next = () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return state >>> 0;
  };
  yield* [0, -0, 0.5, -0.5, 1, -1, 2 ** -17, -(2 ** -17), 3 * 2 ** -17, 2 ** -33, -(2 ** -33), 3 * 2 ** -33];
  for (let i = 0; i < count; ++i) yield (next() - 2 ** 31) * 2 ** -(17 + next() % 48);
}

for (const scalar of scalars) {
  const iso = await load(scalar);
  const world = iso.createWorld();
  const body = world.createBody({type: 'dynamic', shape: world.addShape('sphere', {radius: 0.5})});
  const {calls} = world, prefix = `iso_${scalar}`;
  for (const [kind, codec, name] of [['number', calls.numbers.scalar, ''], ['unit', calls.numbers.unit, 'unit_']]) {
    let differs = 0;
    for (const x of samples(20000)) {
      if (kind === 'unit' && Math.abs(x) >= 2) continue;
      const raw = calls.module.call(`${prefix}_${name}from_double`, x);
      const back = calls.module.call(`${prefix}_${name}to_double`, raw);
      const at = calls.take(8);
      calls.begin();
      codec.write(calls.module.view, at, x, 'x');
      const word = scalar === 'f32' ? Math.fround(codec.word(x, 'x')) : codec.word(x, 'x');
      if (!Object.is(codec.read(calls.module.view, at), back) || word !== raw) ++differs;
    }
    equal(differs, 0, `${scalar}: a ${kind} is another in JavaScript`);
  }
  world.setVelocity(body, [0.25, -3, 1.5]);
  equal(world.body(body).velocity, [0.25, -3, 1.5], `${scalar}: a velocity`);
}

for (const [scalar, one] of [['q16', 1n << 16n], ['q32', 1n << 32n]].filter(([scalar]) => scalars.includes(scalar))) {
  const iso = await load(scalar, {numbers: 'raw'});
  const world = iso.createWorld({gravity: [0n, -10n * one, 0n]});
  const ball = world.addShape('sphere', {radius: one / 2n});
  const body = world.createBody({type: 'dynamic', shape: ball, position: [3n, one, -1n]});
  equal(world.body(body).pose.position, [3n, one, -1n], `${scalar}: raw`);
  const plain = await load(scalar);
  const same = plain.createWorld();
  same.createBody({type: 'dynamic', shape: same.addShape('sphere', {radius: 0.5}), position: [3n, 1, -1n]});
  world.step();
  same.step();
  equal(world.hash, same.hash, `${scalar}: a world by raw numbers`);
  throws(() => world.setVelocity(body, [1n << 70n, 0n, 0n]), {expected: /raw integers/}, `${scalar}: 70 bits`);
}
check((await load('q32', {numbers: 'SI'}).catch(error => error)).field === 'numbers', 'numbers: SI');
done(`numbers of ${scalars.join(', ')} are the engine's`);
