// A game for two: each pushes a puck of its own; touches are counted. The same in match.ts and online.ts.
// SPDX-License-Identifier: MIT

import type {Engine, Game, GivenConfig} from 'isostep';

/** What a player does in a frame: a byte, -1, 0 or 1. */
export const push = (way: number) => Uint8Array.of(way);

export interface Pucks extends Game {
  readonly pucks: bigint[];
  readonly score: {touches: number};
}

// README: begin game
export function createPucks(iso: Engine): Pucks {
  const world = iso.createWorld();
  const state = iso.createState({touches: 'u32'});  // saved, rolled back and hashed with the world
  world.createBody({shape: world.addShape('box', {halfExtents: [20, 1, 20]}), position: [0, -1, 0]});
  const ball = world.addShape('sphere', {radius: 0.5});
  const pucks = [-2, 2].map(x =>
    world.createBody({type: 'dynamic', shape: ball, position: [x, 1, 0], reportContacts: true}));
  return {
    world, state, pucks, score: state,
    step(inputs) {
      pucks.forEach((puck, n) => world.applyImpulse(puck, [0.125 * (inputs[n].bytes[0] << 24 >> 24), 0, 0]));
      world.step();
      state.touches += world.contactBegins().length;
    }
  };
}
// README: end

/** What both sides have alike. */
export const config: GivenConfig = {name: 'two pucks', mode: 'rollback', players: 2, inputCap: 1};
