// How far bodies reach, and the bounds of a run: what the camera, the light and the ground are fitted to.
// SPDX-License-Identifier: MIT

// [m] How far a body reaches from its origin, less half-spaces.
function reachOf(actor) {
  const reach = (part) =>
      part.type === 'half_space' ? 0 : Math.hypot(...part.at) + Math.hypot(...part.half) + part.radius;
  return Math.max(actor.radius || 0, ...(actor.parts || []).map(reach));
}

// The bounds of what moves, over some frames; of what falls, the farthest hundredth on every side does not count.
// `scale` [m]: how much of the world the first picture shows.
function extentOf(run) {
  const axes = [[], [], []], box = new THREE.Box3(), at = new THREE.Vector3();
  const each = (type, visit) => {
    for (let k = 0; k <= 8; ++k) {
      const frame = Math.round(k / 8 * (run.count - 1));
      run.actors.forEach((actor, i) => {
        if (run.state(frame, i) !== kGone && actor.type === type)
          visit(at.fromArray(run.poses.all, 7 * run.place(frame, i)), reachOf(actor));
      });
    }
  };
  each(
      'dynamic',
      (place, reach) =>
          axes.forEach((all, i) => all.push(place.getComponent(i) - reach, place.getComponent(i) + reach)));
  axes.forEach((all, i) => {
    if (all.length === 0) return;
    all.sort((a, b) => a - b);
    box.min.setComponent(i, all[Math.floor(0.01 * (all.length - 1))]);
    box.max.setComponent(i, all[Math.ceil(0.99 * (all.length - 1))]);
  });
  const most = box.isEmpty() ? Infinity : 2 * box.getSize(new THREE.Vector3()).length();
  each('kinematic', (place, reach) => {
    if (reach < most)
      box.union(new THREE.Box3().setFromCenterAndSize(place, new THREE.Vector3(1, 1, 1).multiplyScalar(1.1 * reach)));
  });
  if (box.isEmpty()) box.set(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1));
  const size = Math.max(box.getSize(new THREE.Vector3()).length(), 0.2), focus = focusOf(run, size);
  return {box, centre: box.getCenter(new THREE.Vector3()), size, focus, scale: focus ? 8 * focus.reach : size};
}

// A body that moves alone, and so far that one would not see it: {actor, reach}, or null.
function focusOf(run, size) {
  const moving = run.actors.map((actor, i) => i).filter((i) => run.actors[i].type === 'dynamic');
  if (moving.length !== 1 || run.about.particles) return null;
  const reach = reachOf(run.actors[moving[0]]);
  return size > 12 * reach ? {actor: moving[0], reach} : null;
}
