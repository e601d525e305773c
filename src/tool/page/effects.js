// What acts on bodies and is none: water, explosions, zones, surfaces, thrusters; and the path of a body alone.
// SPDX-License-Identifier: MIT

const kWaterColour = 0x2b82b8, kWaveColour = 0xf08a24, kImplosionColour = 0x5b6fd6, kChimneyColour = 0xc94f3d,
      kZoneColour = 0x6f9fc4, kWindColour = 0x3f8fc9, kPullColour = 0x8a5fb8, kForceColour = 0xd8432f,
      kPlateColour = 0xf3f6fa, kWetPlateColour = 0x9fd3e6, kStrutColour = 0x7a8796, kThrustColour = 0xf0a020,
      kPathColour = 0x8ea2b8;

// A kind is a function that adds its objects to a group and returns what shows them at a moment {frame, tick}.
const kEffects = {
  water: addWater,
  explosion: addExplosion,
  zone: addZone,
  surface: addSurface,
  thruster: addThruster
};

class Effects {
  constructor(view) {
    this.view = view;
    this.all = view.run.about.effects.map((effect, index) => {
      const group = new THREE.Group();
      view.scene.add(group);
      return {effect, group, show: kEffects[effect.kind](view, effect, group, index)};
    });
    this.path = addPath(view);
  }
  // `share` of the way from a frame to the next.
  show(frame, share, options) {
    const {frames} = this.view.run, next = frames[Math.min(frame + 1, frames.length - 1)];
    const tick = frames[frame].tick + share * (next.tick - frames[frame].tick);
    for (const {effect, group, show} of this.all) {
      group.visible = options.effects && frame >= effect.first && frame <= effect.last;
      if (group.visible) show({frame, tick});
    }
    if (this.path) this.path.visible = options.effects;
  }
}

// Seen through, from both sides.
function glass(colour, opacity) {
  return new THREE.MeshBasicMaterial(
      {color: colour, transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false});
}
function meshIn(group, geometry, material) {
  const mesh = new THREE.Mesh(geometry, material);
  group.add(mesh);
  return mesh;
}
function edgesOf(geometry, colour) {
  return new THREE.LineSegments(new THREE.EdgesGeometry(geometry), new THREE.LineBasicMaterial({color: colour}));
}
function vectorOf(numbers) {
  return new THREE.Vector3(...numbers);
}

// A shaft and a head, over whatever is in front of it.
class Arrow {
  constructor(group, colour) {
    const material = new THREE.MeshBasicMaterial({color: colour, depthTest: false, transparent: true, opacity: 0.85});
    this.shaft = meshIn(group, new THREE.CylinderGeometry(1, 1, 1, 8), material);
    this.head = meshIn(group, new THREE.ConeGeometry(1, 1, 12), material);
    for (const mesh of [this.shaft, this.head]) {
      mesh.matrixAutoUpdate = false;
      mesh.frustumCulled = false;
      mesh.renderOrder = 2;
    }
  }
  // `along` has the arrow's length [m]; `thick` [m] is the shaft's radius.
  show(from, along, thick) {
    const length = along.length(), tip = from.clone().add(along);
    const neck = from.clone().addScaledVector(along, Math.max(0, 1 - 6 * thick / (length || 1)));
    const radius = Math.min(thick, 0.1 * length);
    rodMatrix(this.shaft.matrix, from, neck, radius);
    rodMatrix(this.head.matrix, neck, tip, 2.6 * radius);
    this.shaft.matrixWorldNeedsUpdate = this.head.matrixWorldNeedsUpdate = true;
  }
}

// A level sheet as large as its region, or with half 0 as the picture. A wave needs eight points in its length.
function addWater(view, effect, group) {
  const {size, centre} = view.extent, up = vectorOf(effect.up), [height, length, period] = effect.wave;
  const everywhere = effect.half.every((half) => half === 0), middle = everywhere ? centre : vectorOf(effect.middle);
  group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), up);
  group.position.copy(middle).addScaledVector(up, effect.height - middle.dot(up));
  const back = group.quaternion.clone().invert(), wide = height > 0 ? Math.max(size, 8 * length) : 8 * size;
  const half = everywhere ? new THREE.Vector3(wide, 0, wide) : vectorOf(effect.half).applyQuaternion(back);
  const steps = (half) => height > 0 ? Math.min(256, Math.max(1, Math.ceil(16 * Math.abs(half) / length))) : 1;
  const sheet = new THREE.PlaneGeometry(2 * Math.abs(half.x), 2 * Math.abs(half.z), steps(half.x), steps(half.z));
  sheet.rotateX(-Math.PI / 2);
  const material = new THREE.MeshStandardMaterial({
    color: kWaterColour, transparent: true, opacity: 0.5, side: THREE.DoubleSide, depthWrite: false, roughness: 0.35,
    map: gridOver(view, 2 * Math.abs(half.x), 2 * Math.abs(half.z))
  });
  const mesh = meshIn(group, sheet, material);
  mesh.receiveShadow = true;
  mesh.renderOrder = -1;  // before other glass, which is rather above it
  const along = vectorOf(effect.along), start = along.dot(group.position) / length;
  along.applyQuaternion(back);
  return ({tick}) => {
    if (!(height > 0)) return;
    moveWave(sheet, along, height, 2 * Math.PI / length, 2 * Math.PI * (start - tick / view.run.about.hz / period));
  };
}
// Heights above rest, height sin(number x + phase), and the normals of that.
function moveWave(sheet, along, height, number, phase) {
  const at = sheet.getAttribute('position'), normal = sheet.getAttribute('normal'), n = new THREE.Vector3();
  for (let i = 0; i < at.count; ++i) {
    const angle = number * (along.x * at.getX(i) + along.z * at.getZ(i)) + phase;
    const slope = height * number * Math.cos(angle);
    at.setY(i, height * Math.sin(angle));
    n.set(-along.x * slope, 1, -along.z * slope).normalize();
    normal.setXYZ(i, n.x, n.y, n.z);
  }
  at.needsUpdate = normal.needsUpdate = true;
}
// Lines a power of ten apart, so that one sees a body move over what is flat.
function gridOver(view, width, depth) {
  const cell = Math.pow(10, Math.round(Math.log10(view.extent.scale / 8)));
  const texture = gridTexture('#ffffff', '#86b4d0');
  texture.repeat.set(width / cell, depth / cell);
  return texture;
}

// The front of the wave grows with its clock and fades as its force does; what sucks in and the chimney stand while
// they last.
function addExplosion(view, effect, group) {
  const up = vectorOf(effect.up), turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), up);
  const [reach, implodes] = effect.implosion, [speed, width, lasts] = effect.wave;
  const [radius, tall, burns] = effect.chimney;
  group.position.copy(vectorOf(effect.centre));
  group.quaternion.copy(turn);
  const ball = new THREE.SphereGeometry(1, 48, 24);
  const ring = new THREE.TorusGeometry(1, 0.012, 8, 96).rotateX(Math.PI / 2);
  const suck = meshIn(group, ball, glass(kImplosionColour, 0.16)), front = meshIn(group, ball, glass(kWaveColour, 0));
  const edge = meshIn(group, ring, glass(kWaveColour, 0)), suckEdge = meshIn(group, ring, glass(kImplosionColour, 0.8));
  const chimney = meshIn(group, new THREE.CylinderGeometry(1, 1, 1, 48, 1, true), glass(kChimneyColour, 0.2));
  chimney.scale.set(radius, tall, radius);
  chimney.position.y = 0.5 * tall;
  return ({tick}) => {
    const t = (tick - effect.begin) / view.run.about.hz, since = t - effect.pause, left = 1 - since / (lasts || 1);
    suck.visible = suckEdge.visible = t >= 0 && t < implodes;
    suck.scale.setScalar(reach);
    suckEdge.scale.setScalar(reach);
    front.visible = edge.visible = since >= 0 && since < lasts;
    front.scale.setScalar(speed * since + width);
    edge.scale.setScalar(speed * since + width);
    front.material.opacity = 0.3 * left;
    edge.material.opacity = 0.9 * left;
    chimney.visible = since >= 0 && since < burns;
  };
}

// Its shape, unless it is everywhere; an arrow for its wind and one for its acceleration, over the body that is
// followed or in the middle.
function addZone(view, effect, group) {
  const kEverywhere = 0, kSphere = 1, at = vectorOf(effect.at), {scale, centre} = view.extent;
  if (effect.shape !== kEverywhere) {
    const shape = effect.shape === kSphere ? new THREE.SphereGeometry(1, 32, 20) : new THREE.BoxGeometry(2, 2, 2);
    const mesh = meshIn(group, shape, glass(kZoneColour, 0.14));
    mesh.position.copy(at);
    if (effect.shape === kSphere) mesh.scale.setScalar(effect.half[0]);
    else mesh.scale.set(...effect.half), mesh.quaternion.set(...effect.turn);
    if (effect.shape !== kSphere)
      mesh.add(edgesOf(shape, kZoneColour));
  }
  const arrows = [[effect.wind, kWindColour], [effect.acceleration, kPullColour]]
                     .filter(([way]) => way.some((x) => x !== 0))
                     .map(([way, colour]) => ({way: vectorOf(way).normalize(), arrow: new Arrow(group, colour)}));
  return () => {
    const {focus} = view, from = effect.shape !== kEverywhere ? at.clone() : centre.clone();
    if (effect.shape === kEverywhere && focus) view.position(focus.actor, from);
    if (effect.shape === kEverywhere) from.y += 0.3 * scale;
    arrows.forEach(({way, arrow}, i) => {
      const begin = from.clone().addScaledVector(way, -0.12 * scale);
      begin.y += 0.04 * scale * i;
      arrow.show(begin, way.clone().multiplyScalar(0.24 * scale), 0.006 * scale);
    });
  };
}

// The force of an effect as an arrow from its point: as long as the body reaches at the run's strongest, by its root.
function forceArrow(view, effect, group, index, colour) {
  const {run} = view, reach = reachOf(run.actors[effect.actor]), arrow = new Arrow(group, colour);
  return (frame, from) => {
    const force = new THREE.Vector3().fromArray(run.frames[frame].pushes, 4 * index);
    const strong = Math.sqrt(force.length() / (run.about.strongest || 1));
    arrow.show(from, force.normalize().multiplyScalar(1.6 * reach * strong), 0.03 * reach);
  };
}
// A point of its body, in the world.
function pointOf(view, effect) {
  return view.overlay.end(effect.actor, effect.point, new THREE.Vector3());
}

// A square plate across the direction that it resists, held by a strut from its body's origin. Control turns it
// between three normals. Its size is the body's, for a surface has none.
function addSurface(view, effect, group, index) {
  const reach = reachOf(view.run.actors[effect.actor]), side = 0.7 * reach;
  const plate = meshIn(
      group, new THREE.BoxGeometry(side, side, 0.05 * side),
      new THREE.MeshStandardMaterial({color: effect.wet ? kWetPlateColour : kPlateColour, roughness: 0.7}));
  const strut =
      meshIn(group, new THREE.CylinderGeometry(1, 1, 1, 8), new THREE.MeshStandardMaterial({color: kStrutColour}));
  strut.matrixAutoUpdate = false;
  plate.castShadow = strut.castShadow = true;
  plate.add(edgesOf(plate.geometry, kOutlineColour));
  const normals = [0, 3, 6].map((i) => vectorOf(effect.normals.slice(i, i + 3)));
  const arrow = forceArrow(view, effect, group, index, kForceColour), body = new THREE.Quaternion();
  return ({frame}) => {
    const control = view.run.frames[frame].pushes[4 * index + 3], at = pointOf(view, effect);
    const normal = normals[1].clone().lerp(control < 0 ? normals[0] : normals[2], Math.abs(control)).normalize();
    body.fromArray(view.at, 7 * effect.actor + 3);
    plate.position.copy(at);
    plate.quaternion.copy(body).multiply(facing(normal));
    rodMatrix(strut.matrix, view.position(effect.actor, new THREE.Vector3()), at, 0.025 * reach);
    strut.matrixWorldNeedsUpdate = true;
    arrow(frame, at);
  };
}
// The turn that takes z to the normal and keeps x as near to x as it can be.
function facing(normal) {
  const x = new THREE.Vector3(1, 0, 0);
  if (Math.abs(normal.x) > 0.95) x.set(0, 1, 0);
  x.addScaledVector(normal, -x.dot(normal)).normalize();
  const y = new THREE.Vector3().crossVectors(normal, x);
  return new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().makeBasis(x, y, normal));
}

function addThruster(view, effect, group, index) {
  const arrow = forceArrow(view, effect, group, index, kThrustColour);
  return ({frame}) => arrow(frame, pointOf(view, effect));
}

// Where the body that is followed goes in the whole run.
function addPath(view) {
  const {focus, run} = view;
  if (!focus) return null;
  const places = [];
  for (let frame = 0; frame < run.count; ++frame) {
    const from = 7 * run.place(frame, focus.actor);
    if (run.state(frame, focus.actor) !== kGone) places.push(...run.poses.all.subarray(from, from + 3));
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(places, 3));
  const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({color: kPathColour}));
  line.frustumCulled = false;
  view.scene.add(line);
  return line;
}
