// What callers get wrong: objects that are gone, records kept for long, exceptions in a game: node misuse_test.mjs FOLDER
// SPDX-License-Identifier: MIT

import {check, done, equal, exactest, packaged, throws} from './checks.mjs';
import {createPucks, kConfig, pushOf} from './pucks.mjs';

const {load, PartFlags} = await packaged('isostep');
const iso = await load(exactest);

/** All of some records, as text and as numbers. */
const read = kept => kept.map(records => [
  [...records].map(record => JSON.stringify(record, (_, word) => typeof word === 'bigint' ? `${word}` : word)),
  [...records.numbers].map(String), [...records.ids].map(String)
]);

// What a part's traits do not name stays as it is: its filter meets all, its material is as any.
{
  const world = iso.createWorld();
  const traits = {flags: PartFlags.ownFilter | PartFlags.ownMaterial, filter: {group: 3}, material: {friction: 0.25}};
  const floor = world.addCompound([{kind: 'box', shape: {halfExtents: [4, 0.5, 4]}, pose: {position: [0, -0.5, 0]}, traits}]);
  world.createBody({shape: floor});
  const ball = world.createBody({type: 'dynamic', shape: world.addShape('sphere', {radius: 0.5}), position: [0, 0.5, 0]});
  for (let i = 0; i < 60; ++i) world.step();
  check(Math.abs(world.body(ball).pose.position[1] - 0.5) < 0.02, 'a ball lies on a part with a filter of its own');
}

// Records stay as they were: the world steps on, is gone, and others take its memory.
for (const ends of [false, true]) {
  const world = iso.createWorld(), ball = world.addShape('sphere', {radius: 0.5});
  const balls = count => {
    for (let i = 0; i < count; ++i) {
      world.createBody({type: 'dynamic', shape: ball, position: [2 * i, 0.45, 0], reportContacts: true});
    }
  };
  world.createBody({shape: world.addShape('half_space', {normal: [0, 1, 0]})});
  balls(300);
  world.step();
  const kept = [world.poses(), world.contactBegins()], seen = read(kept);
  equal(kept.map(({length}) => length), [300, 300], 'poses and touches of 300 balls');
  if (ends) world.dispose();
  else balls(3000);
  for (let i = 0; i < 40; ++i) {
    const other = ends ? iso.createWorld() : world;
    other.createBody({type: 'dynamic', shape: other.addShape('sphere', {radius: 1}), position: [0, 50 + 3 * i, 0]});
    other.step();
    other.poses();
    other.contactBegins();
  }
  equal(read(kept), seen, `records, the world ${ends ? 'gone' : 'grown'}`);
}

// Of what is gone nothing can be asked.
const game = createPucks(iso), tape = iso.createTape();
game.world.record(tape, 'gone');
game.world.step();
tape.endFrame();
tape.flush();
tape.finish();
const replay = iso.openReplay(tape.bytes()), snapshot = game.world.createSnapshot(), network = iso.createNetwork();
const hull = iso.createHull([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]);
const config = {...kConfig, host: true, seed: 20n};
const session = iso.createSession(config, game), orphan = iso.createSession(config, game);
const heir = createPucks(iso);
const stateless = iso.createSession(config, heir);
heir.state.dispose();
for (const one of [session, replay, tape, snapshot, network, hull, game.world]) one.dispose();
const uses = {
  hash: () => game.world.hash, tick: () => game.world.tick, step: () => game.world.step(),
  counts: () => game.world.counts, settings: () => game.world.settings, bodies: () => game.world.bodies(),
  poses: () => game.world.poses(), touches: () => game.world.contactBegins(), save: () => game.world.createSnapshot(),
  ray: () => game.world.castRay({origin: [0, 5, 0], translation: [0, -9, 0]}), body: () => game.world.hasBody(1n),
  shape: () => game.world.addShape('sphere', {radius: 1}), load: () => heir.world.load(snapshot),
  blob: () => heir.world.addBlob(hull), name: () => hull.name, info: () => replay.info, frame: () => replay.frame(0),
  play: () => replay.createWorld(), bytes: () => tape.bytes(), flush: () => tape.flush(),
  connect: () => network.connect(1), drive: () => session.drive(0), phase: () => session.phase,
  event: () => session.pollEvent(), input: () => session.addLocalInput(0, Uint8Array.of(1)),
  worldless: () => orphan.drive(0), saved: () => orphan.saveMatch(), stateless: () => stateless.saveMatch(),
  another: () => iso.createSession(config, game)
};
for (const [name, use] of Object.entries(uses)) {
  throws(use, {status: -9, message: /has been disposed of/}, `${name} of what is gone`);
}
orphan.dispose();
stateless.dispose();

/** Plays 300 frames of a match in which `raises(machine, callback, nth)` says what throws. */
function play(mode, raises) {
  const lines = iso.createNetwork(3n);
  lines.addClient('latency=40,jitter=10,loss=2');
  lines.connect(1);
  const machines = [0, 1].map(who => {
    const hashes = new Map(), events = [], thrown = [], calls = {}, pucks = createPucks(iso);
    const throwing = (what, work) => (...given) => {
      calls[what] = (calls[what] ?? 0) + 1;
      const raised = raises(who, what, calls[what]);
      if (raised === 'before') thrown.push(what);
      if (raised === 'before') throw new RangeError(what);
      work(...given);
      if (raised === 'after') thrown.push(what);
      if (raised === 'after') throw new RangeError(what);
    };
    const careless = {
      ...pucks, step: throwing('step', pucks.step), rolledBack: throwing('rolledBack', () => {}),
      confirmed: throwing('confirmed', (frame, hash) => hashes.set(frame, hash))
    };
    const seat = who === 0 ? {host: true, seed: 20n} : {};
    return {hashes, events, thrown, pucks, session: iso.createSession({...kConfig, mode, ...seat}, careless)};
  });
  machines[0].session.record('world', 'careless');
  for (let now = 0; machines.some(({hashes}) => hashes.size < 300); now += 4000) {
    if (now > 60e6) throw new Error(`${mode}: the match stands still`);
    lines.advanceTo(now);
    machines.forEach(({session, events}, who) => {
      try {
        lines.deliver(who, session, now);
        if (session.localPlayer >= 0) session.addLocalInput(session.localPlayer, pushOf(session.current, who));
        session.drive(now);
      } catch (error) {
        if (!(error instanceof RangeError)) throw error;
      }
      lines.dispatch(who, session, now);
      for (let event; (event = session.pollEvent()) !== null;) events.push(event.kind);
    });
  }
  const [host, client] = machines;
  for (const [frame, hash] of host.hashes) {
    if (client.hashes.has(frame)) equal(client.hashes.get(frame), hash, `${mode}: frame ${frame}`);
  }
  for (const {events, thrown} of machines) {
    check(!events.includes('desync'), `${mode}: a desync after ${thrown}`);
    const missed = thrown.some(what => what !== 'confirmed');
    equal(events.includes('misuse'), missed, `${mode}: misuse after ${thrown}`);
  }
  equal(iso.verifyReplay(host.session.recorded('world')).outcome, 'verified', `${mode}: after ${host.thrown}`);
  for (const {session, pucks} of machines) [session, pucks.world, pucks.state].forEach(one => one.dispose());
  lines.dispose();
  return machines.flatMap(({thrown}) => thrown);
}

for (const mode of ['lockstep', 'rollback']) {
  equal(play(mode, () => null), [], `${mode}: nothing is thrown`);
  for (const when of ['before', 'after']) {
    for (const what of mode === 'rollback' ? ['step', 'confirmed', 'rolledBack'] : ['step', 'confirmed']) {
      for (const culprit of [0, 1]) {
        equal(play(mode, (who, callback, nth) => who === culprit && callback === what && nth === 2 ? when : null),
          [what], `${mode}: ${what}`);
      }
    }
  }
  const thrown = play(mode, (who, what, nth) => (nth * 31 + who * 17) % 23 === 0 ? 'before' : null);
  check(thrown.length > 20, `${mode}: ${thrown.length} exceptions`);
}
done('what is gone is an error, records stay, an exception costs no match');
