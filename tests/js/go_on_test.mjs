// session.goOn: a match that stands for lack of a majority, or of its host, goes on with those who are here.
// node go_on_test.mjs FOLDER
// SPDX-License-Identifier: MIT

import {check, done, equal, exactest, packaged} from './checks.mjs';

const kSecond = 1e6;
const {load} = await packaged('isostep');
const iso = await load(exactest);

/** A machine whose game is a sum of its inputs. */
function machineOf(who, mode, players) {
  const state = iso.createState({sum: 'u32'});
  const machine = {finals: 0, silent: false};
  const game = {
    state, confirmed: () => ++machine.finals,
    step(inputs) { state.sum = inputs.reduce((sum, {bytes}) => sum + bytes[0], 3 * state.sum + 1) >>> 0; }
  };
  const config = {mode, players, host: who === 0, seed: BigInt(3 + who), name: 'sum', inputText: 'what',
                  migration: BigInt(kSecond), address: String(who)};
  machine.session = iso.createSession(config, game);
  return machine;
}

/** All but `left` vanish; the match stands, and goes on when its game says so. */
function goesOnWithThoseWhoAreHere(mode, players, left) {
  const what = `${mode} of ${players}`;
  const network = iso.createNetwork(5n);
  const machines = Array.from({length: players}, (_, who) => machineOf(who, mode, players));
  for (let who = 1; who < players; ++who) network.connect(network.addClient('latency=20'));
  let now = 0;
  const pass = seconds => {
    for (const end = now + seconds * kSecond; now < end; now += 4000) {
      network.advanceTo(now);
      machines.forEach(({session, silent}, who) => {
        if (silent) return;
        network.deliver(who, session, now);
        const player = session.localPlayer;
        if (player >= 0) session.addLocalInput(player, Uint8Array.of(Math.floor(session.current / 7) % 3));
        session.drive(now);
        network.dispatch(who, session, now);
      });
    }
  };
  const here = machines[left];
  pass(6);
  check(here.finals > 200, `${what}: ${here.finals} frames`);
  equal(here.session.goOn(now), false, `${what}: all are here`);
  machines.forEach((machine, who) => {
    if (who === left) return;
    machine.silent = true;
    network.setSilent(who, true);
  });
  pass(4);
  const stood = here.finals;
  pass(20);
  equal(here.finals, stood, `${what}: the others may play elsewhere`);
  equal(here.session.goOn(now), true, `${what}: ${here.session.problem}`);
  pass(5);
  check(here.finals > stood + 200, `${what}: it stands still`);
  equal(here.session.goOn(now), false, `${what}: it goes on`);
}

for (const mode of ['lockstep', 'rollback']) {
  goesOnWithThoseWhoAreHere(mode, 2, 1);
  goesOnWithThoseWhoAreHere(mode, 3, 0);
}
done('a match that stands goes on with those who are here');
