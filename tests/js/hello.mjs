// The scene of src/examples/hello.cpp in JavaScript: the hash of every frame, saved, loaded and played again between.
// SPDX-License-Identifier: MIT

/** In whatever has the engine: Node, a page. Returns {hashes, user, hardest}; hello_hashes.cpp prints the same. */
export function playHello(iso) {
  const world = iso.createWorld({hz: 60, substeps: 8, gravity: [0, -10, 0]});
  const ground = world.addShape('box', {halfExtents: [50, 1, 50]});
  world.createBody({shape: ground, position: [0, -1, 0]});
  const crate = world.addShape('box', {halfExtents: [0.5, 0.5, 0.5]});
  const body = world.createBody({type: 'dynamic', shape: crate, position: [0, 2, 0], userData: 42n});
  world.applyImpulse(body, [0, 3, 0]);

  const hashes = [];
  const play = frames => {
    for (let i = 0; i < frames; ++i) {
      world.step();
      hashes.push(world.hash.toString(16).padStart(16, '0'));
    }
  };
  const frame = world.createSnapshot();
  world.save(frame);
  play(120);
  world.load(frame);
  play(120);
  const hit = world.castRay({origin: [0, 5, 0], translation: [0, -10, 0]});

  const wooden = world.createBody({
    type: 'dynamic', shape: crate, position: [3, 2, 0], material: {friction: 0.5, restitution: 0.25},
    filter: {category: 2, mask: 3}, reportContacts: true
  });
  let hardest = 0;
  for (let i = 0; i < 120; ++i) {
    play(1);
    for (const {impulse} of world.contactBegins()) hardest = Math.max(hardest, impulse);
  }
  const wood = world.castRay({origin: [3, 5, 0], translation: [0, -10, 0], filter: {mask: 2}});
  const sound = hit?.body === body && wood?.body === wooden && hardest > 1;
  const user = sound ? Number(world.body(hit.body).userData) : 0;
  world.dispose();
  frame.dispose();
  return {hashes, user, hardest};
}
