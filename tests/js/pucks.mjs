// The game of tests/match/pucks.hpp, which native hosts play too.
// SPDX-License-Identifier: MIT

/** What a player does who is asked when `current` is the session's frame. */
export const pushOf = (current, player) => Uint8Array.of(Math.floor(current / (11 + 6 * player)) % 3 - 1);
export const kConfig = {name: 'pucks', mode: 'rollback', players: 2};

export function createPucks(iso, players = 2) {
  const world = iso.createWorld(), state = iso.createState({touches: 'u32'});
  world.createBody({shape: world.addShape('box', {halfExtents: [20, 1, 20]}), position: [0, -1, 0]});
  const ball = world.addShape('sphere', {radius: 0.5});
  const pucks = Array.from({length: players}, (_, n) =>
    world.createBody({type: 'dynamic', shape: ball, position: [4 * n - 2, 1, 0], reportContacts: true}));
  return {
    world, state, pucks,
    step(inputs) {
      pucks.forEach((puck, n) => world.applyImpulse(puck, [0.125 * (inputs[n].bytes[0] << 24 >> 24), 0, 0]));
      world.step();
      state.touches += world.contactBegins().length;
    }
  };
}
