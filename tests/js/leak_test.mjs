// A thousand worlds, made and disposed of, take no more memory than a few: node --expose-gc leak_test.mjs FOLDER
// SPDX-License-Identifier: MIT

import {check, done, exactest, packaged} from './checks.mjs';
import {createPucks, kConfig} from './pucks.mjs';

const {load} = await packaged('isostep');
const iso = await load(exactest);

function use() {
  const game = createPucks(iso);
  const snapshot = game.world.createSnapshot();
  const session = iso.createSession({...kConfig, host: true, seed: 1n, history: 600}, game);
  for (let i = 0; i < 3; ++i) game.world.step();
  game.world.save(snapshot);
  game.world.castRay({origin: [0, 5, 0], translation: [0, -10, 0], filter: {ignoreAll: [game.pucks[0]]}});
  return [session, snapshot, game.world, game.state];
}
const disposeAll = owned => owned.forEach(one => one.dispose());

// The heap gets its last page when a thousand closed handles wait (src/c/handle.cpp); twelve thousand more uses take
// none.
for (let i = 0; i < 600; ++i) disposeAll(use());
const warm = iso.memorySize;
for (let i = 0; i < 1000; ++i) disposeAll(use());
check(iso.memorySize === warm, `disposed of: ${warm} bytes become ${iso.memorySize}`);

// What is forgotten is freed when it is collected.
const collected = () => new Promise(resolve => setTimeout(resolve, 0)).then(() => globalThis.gc());
const before = iso.memorySize;
let size = 0;
for (let round = 0; round < 10; ++round) {
  for (let i = 0; i < 20; ++i) use();
  for (let i = 0; i < 5; ++i) await collected();
  size ||= iso.memorySize;
}
check(iso.memorySize === size, `forgotten: ${size} bytes after 20 worlds become ${iso.memorySize} after 200`);
done(`1000 worlds take ${warm >> 20} MB, 200 forgotten ones ${(size - before) >> 10} kB more`);
