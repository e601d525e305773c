// The game over a bad line, both machines in one process: node match.js [SCALAR]
// SPDX-License-Identifier: MIT

import {load, type Scalar} from 'isostep';

import {config, createPucks, push} from './pucks.js';

const kFrames = 300;
const iso = await load((process.argv[2] ?? 'q32') as Scalar);
const network = iso.createNetwork(20n);
const line = network.addClient('latency=80,jitter=20,loss=5');

const machines = [0, line].map((endpoint, player) => {
  const hashes: bigint[] = [];  // of the final frames
  const game = {...createPucks(iso), confirmed: (frame: number, hash: bigint) => { hashes[frame] = hash; }};
  const session = iso.createSession({...config, host: player === 0, seed: player === 0 ? 20n : 0n}, game);
  return {endpoint, player, game, session, hashes};
});

// README: begin turn
function turn({endpoint, player, session}: typeof machines[0], now: number) {
  network.deliver(endpoint, session, now);
  session.addLocalInput(player, push(Math.floor(session.current / (11 + 6 * player)) % 3 - 1));
  session.drive(now);
  network.dispatch(endpoint, session, now);
}
// README: end

network.connect(line);
for (let now = 0; machines.some(({session}) => session.confirmed < kFrames); now += 4000) {
  if (now > 30e6) throw new Error('the match does not end');
  network.advanceTo(now);
  for (const machine of machines) turn(machine, now);
}
const [host, client] = machines;
const equal = host.hashes.slice(0, kFrames).filter((hash, frame) => hash === client.hashes[frame]).length;
const again = Number(host.session.stats.steps) - kFrames;
const {touches} = host.game.score;
console.log(`${equal} of ${kFrames} frames equal; ${again} frames were stepped again; ${touches} touches`);
if (equal !== kFrames || again < 20 || touches < 2) process.exit(1);
