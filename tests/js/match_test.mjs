// Matches of peers in WebAssembly over the simulated network: node match_test.mjs FOLDER
// SPDX-License-Identifier: MIT

import {check, done, equal, exactest, packaged} from './checks.mjs';
import {createPucks, kConfig, pushOf} from './pucks.mjs';

const {load} = await packaged('isostep');
const iso = await load(exactest);

/** A machine at an endpoint of a network. */
function machineOf(endpoint, config, file) {
  const hashes = new Map(), events = [];
  const game = {...createPucks(iso), confirmed: (frame, hash) => hashes.set(frame, hash)};
  return {endpoint, game, hashes, events, session: iso.createSession({...kConfig, ...config}, game, file)};
}
/** Plays until all have confirmed so many frames. */
function play(network, machines, frames) {
  for (let now = 0; machines.some(({session}) => session.confirmed < frames); now += 4000) {
    if (now > 120e6) throw new Error('the match does not end');
    network.advanceTo(now);
    for (const {endpoint, session, events} of machines) {
      network.deliver(endpoint, session, now);
      const player = session.localPlayer;
      if (player >= 0) session.addLocalInput(player, pushOf(session.current, player));
      session.drive(now);
      network.dispatch(endpoint, session, now);
      for (let event; (event = session.pollEvent()) !== null;) events.push(event);
    }
  }
}

for (const mode of ['lockstep', 'rollback']) {
  const network = iso.createNetwork(7n);
  const line = network.addClient('latency=80,jitter=20,loss=5'), seat = network.addClient('wifi');
  const host = machineOf(0, {mode, host: true, seed: 20n});
  const client = machineOf(line, {mode});
  const watcher = machineOf(seat, {mode: 'spectator'});
  network.connect(line);
  network.connect(seat);
  check(host.session.record('match') && host.session.record('world', 'pucks'), `${mode}: recordings begin`);
  play(network, [host, client, watcher], 600);

  for (let frame = 0; frame < 600; ++frame) {
    const [a, b, c] = [host, client, watcher].map(({hashes}) => hashes.get(frame));
    if (a === undefined || a !== b || a !== c) {
      check(false, `${mode}: frame ${frame}: ${a}, ${b}, ${c}`);
      break;
    }
  }
  const again = Number(host.session.stats.steps) - host.session.current;
  check(mode === 'lockstep' ? again === 0 : again > 20, `${mode}: ${again} frames were stepped again`);
  check(host.game.state.touches > 1, `${mode}: the pucks do not touch`);
  equal(host.game.state.touches, client.game.state.touches, `${mode}: touches`);
  check(client.events.some(({kind}) => kind === 'started'), `${mode}: nobody is told that it starts`);
  equal([host.session.phase, client.session.localPlayer], ['playing', 1], `${mode}: phase, player`);
  equal(client.session.input(client.session.current - 1, 1).bytes.length, 1, `${mode}: an input`);

  // The recording is played by another game of the same kind; the world's is verified without any.
  const file = host.session.recorded('match');
  const replay = machineOf(0, {mode: 'replay'}, file);
  for (let now = 0; replay.session.phase !== 'over' && now < 60e6; now += 16000) replay.session.drive(now);
  equal(replay.session.phase, 'over', `${mode}: the replay ends`);
  check(replay.hashes.size >= 600, `${mode}: the replay has ${replay.hashes.size} frames`);
  equal(replay.hashes.get(599), host.hashes.get(599), `${mode}: the replay's last hash`);
  const verdict = iso.verifyReplay(host.session.recorded('world'));
  check(verdict.outcome === 'verified' && verdict.frames >= 600n, `${mode}: ${verdict.text}`);

  for (const {session, game} of [host, client, watcher, replay]) {
    session.dispose();
    game.world.dispose();
    game.state.dispose();
  }
  network.dispose();
}
done(`two matches of 600 frames in ${exactest}: all machines agree`);
