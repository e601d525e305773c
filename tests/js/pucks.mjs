// The game of src/examples/lockstep_game.cpp, which the native host plays too.
// SPDX-License-Identifier: MIT

export const push = way => Uint8Array.of(way);
export const kConfig = {name: 'two pucks', mode: 'rollback', players: 2};

export function createPucks(iso) {
  const world = iso.createWorld(), state = iso.createState({touches: 'u32'});
  world.createBody({shape: world.addShape('box', {halfExtents: [20, 1, 20]}), position: [0, -1, 0]});
  const ball = world.addShape('sphere', {radius: 0.5});
  const pucks = [-2, 2].map(x => world.createBody({type: 'dynamic', shape: ball, position: [x, 1, 0]}));
  return {
    world, state, pucks,
    step(inputs) {
      pucks.forEach((puck, n) => world.applyImpulse(puck, [0.125 * (inputs[n].bytes[0] << 24 >> 24), 0, 0]));
      world.step();
      state.touches += world.contactBegins().length;
    }
  };
}
