// One run as three.js draws it: light, bodies, scenery.
// SPDX-License-Identifier: MIT

const kColours = [0x4f86c6, 0xe0925b, 0x6bab7f, 0xc9697b, 0x8d7cc0, 0xd4b04c, 0x5aa9b0, 0xa9815e];
const kMostOutlined = 400;  // parts that nothing moves; of more one would see lines and nothing else
const kStaticColour = 0xdde3ea, kKinematicColour = 0x59697c, kPartedColour = 0xe2361d, kAsleepColour = 0xd9dee4,
      kOutlineColour = 0x8fa0b3, kWheelColour = 0x4a5160;

// A drawing repeated over a surface.
function textureOf(width, height, paint) {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  paint(canvas.getContext('2d'), width, height);
  const texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 8;
  return texture;
}
// Halves, so that one sees a ball roll.
function ballTexture() {
  return textureOf(64, 32, (paint, width, height) => {
    for (let i = 0; i < 4; ++i) {
      paint.fillStyle = i % 2 ? '#ffffff' : '#c4ccd6';
      paint.fillRect(i * width / 4, 0, width / 4, height);
    }
  });
}
// A bar across, so that one sees a wheel turn: the texture's middle column is a diameter of both its sides.
function wheelTexture() {
  return textureOf(64, 64, (paint, width) => {
    paint.fillStyle = '#9aa2ae';
    paint.fillRect(0, 0, width, width);
    paint.fillStyle = '#ffffff';
    paint.fillRect(0.44 * width, 0, 0.12 * width, width);
  });
}
function gridTexture(field, lines) {
  return textureOf(256, 256, (paint, width) => {
    paint.fillStyle = field;
    paint.fillRect(0, 0, width, width);
    paint.strokeStyle = lines;
    paint.lineWidth = 4;
    paint.strokeRect(0, 0, width, width);
  });
}

class View {
  constructor(run, surfaces, extent, parted) {
    this.run = run;
    this.surfaces = surfaces;
    this.extent = extent;
    this.parted = parted;  // {actor, frame}, or null
    this.focus = extent.focus && run.actors[extent.focus.actor] ? extent.focus : null;
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(0xeef1f5);
    this.scene.fog = new THREE.Fog(0xeef1f5, 6 * extent.size, 30 * extent.size);
    this.at = new Float32Array(7 * run.actors.length);  // of the moment
    this.addLights();
    this.addBodies();
    this.addScenery();
    this.overlay = new Overlay(this);
    this.effects = new Effects(this);
  }

  addLights() {
    const {centre, scale: size} = this.extent;
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0xbfc8d2, 1.55));
    const sun = new THREE.DirectionalLight(0xfff4e2, 2.5);
    sun.position.copy(centre).add(new THREE.Vector3(0.55, 1.25, 0.8).multiplyScalar(1.5 * size));
    sun.target.position.copy(centre);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    Object.assign(
        sun.shadow.camera, {left: -size, right: size, top: size, bottom: -size, near: 0.1 * size, far: 5 * size});
    sun.shadow.normalBias = 0.002 * size;
    sun.shadow.bias = -0.0006;
    sun.shadow.camera.updateProjectionMatrix();
    this.scene.add(sun, sun.target);
    this.sun = sun;
  }

  // Every primitive is a unit one, stretched: boxes, balls, cylinders, cones, and of capsules the tube between two
  // balls. Surfaces are drawn as they are.
  addBodies() {
    const lists = this.listParts(), many = this.run.actors.length > 3000;
    const shapes = {
      box: new THREE.BoxGeometry(1, 1, 1),
      tube: new THREE.CylinderGeometry(1, 1, 1, 20, 1, true),
      cylinder: new THREE.CylinderGeometry(1, 1, 1, many ? 16 : 32),
      cone: new THREE.ConeGeometry(1, 1, many ? 16 : 32),
      wheel: new THREE.CylinderGeometry(1, 1, 1, many ? 16 : 32),
      ball: new THREE.SphereGeometry(1, many ? 10 : 24, many ? 7 : 16)
    };
    this.meshes = [];
    for (const [name, parts] of Object.entries(lists)) {
      const clear = name.startsWith('clear_'), shape = clear ? name.slice(6) : name;
      const material = new THREE.MeshStandardMaterial(
          {roughness: 0.72, metalness: 0.02, transparent: clear, opacity: clear ? 0.13 : 1, depthWrite: !clear});
      if (shape === 'ball' && !this.run.about.particles) material.map = ballTexture();
      if (shape === 'wheel') material.map = wheelTexture();
      if (shape.startsWith('fixed_')) Object.assign(material, {polygonOffset: true, polygonOffsetFactor: 1});
      const mesh = shape in shapes ? new THREE.InstancedMesh(shapes[shape], material, parts.length) :
                                     this.surfaces.mesh(parts, material, shape.startsWith('fixed_'));
      mesh.castShadow = !clear;
      mesh.receiveShadow = !clear;
      mesh.frustumCulled = false;
      mesh.userData.parts = parts;
      mesh.userData.shown = new Int32Array(parts.length).fill(-1);
      this.scene.add(mesh);
      this.meshes.push(mesh);
    }
  }

  // By what is drawn in one call.
  listParts() {
    const lists = {};
    this.outlines = [];
    const fixed = (actor) => actor.type === 'static' && !actor.sensor;
    const outlined = this.run.actors.reduce((n, actor) => n + (fixed(actor) ? (actor.parts || []).length : 0), 0) <=
        kMostOutlined;
    const add = (actor, shape, at, turn, scale, surface, wall = false) => {
      const local = new THREE.Matrix4().compose(
          new THREE.Vector3(...at), new THREE.Quaternion(...turn), new THREE.Vector3(...scale));
      const part = {actor, local, surface}, name = (wall || this.run.actors[actor].sensor ? 'clear_' : '') + shape;
      if (wall || outlined && fixed(this.run.actors[actor]) && (surface !== undefined || shape === 'box'))
        this.addOutline(part);
      (lists[name] = lists[name] || []).push(part);
    };
    const least = 0.006 * this.extent.size;
    this.run.actors.forEach((actor, index) => {
      if (!actor.parts) {
        const r = Math.max(actor.radius, least);
        add(index, 'ball', [0, 0, 0], [0, 0, 0, 1], [r, r, r]);
      }
      for (const part of actor.parts || []) {
        const {type, at, turn, radius: r, surface} = part, size = part.half.map((h) => 2 * (h + r));
        if (type === 'half_space') continue;  // drawn with the ground
        if (type === 'sphere')
          add(index, 'ball', at, turn, [r, r, r]);
        else if (surface !== undefined)
          add(index, (fixed(actor) ? 'fixed_' : '') + this.surfaces.listOf(surface), at, turn, [1, 1, 1], surface,
              type === 'hull' && this.isWall(index, at, size));
        else if (type === 'cylinder' || type === 'cone')
          add(index, actor.type === 'wheel' ? 'wheel' : type, at, turn, [r, 2 * part.half[1], r]);
        else if (type !== 'capsule')
          add(index, 'box', at, turn, size, undefined, this.isWall(index, at, size));
        else {
          add(index, 'tube', at, turn, [r, 2 * part.half[1], r]);
          const along = new THREE.Vector3(0, part.half[1], 0).applyQuaternion(new THREE.Quaternion(...turn));
          for (const sign of [1, -1]) {
            const end = along.clone().multiplyScalar(sign).add(new THREE.Vector3(...at));
            add(index, 'ball', end.toArray(), turn, [r, r, r]);
          }
        }
      }
    });
    return lists;
  }

  // What would hide what is inside: large boxes and hulls that nothing moves, unless they lie low and flat as ground
  // does.
  isWall(actor, at, scale) {
    const {type} = this.run.actors[actor];
    if (type === 'dynamic' || Math.max(...scale) < 0.25 * this.extent.size) return false;
    if (type === 'kinematic') return true;
    const top = this.run.poses.all[7 * this.run.firstPlace(actor) + 1] + at[1] + 0.5 * scale[1];
    return !(scale[1] < 0.5 * Math.min(scale[0], scale[2]) && top < this.extent.centre.y);
  }
  // Where faces meet at more than 20 degrees.
  addOutline(part) {
    const solid =
        part.surface === undefined ? new THREE.BoxGeometry(1, 1, 1) : this.surfaces.geometry(part.surface);
    const edges = new THREE.LineSegments(
        new THREE.EdgesGeometry(solid, 20), new THREE.LineBasicMaterial({color: kOutlineColour}));
    edges.matrixAutoUpdate = false;
    edges.frustumCulled = false;
    this.scene.add(edges);
    this.outlines.push({part, edges});
  }

  // Half-spaces of static bodies, planes and lines of particles.
  addScenery() {
    this.run.actors.forEach((actor, index) => {
      for (const part of actor.parts || []) {
        if (part.type !== 'half_space') continue;
        const pose = 7 * this.run.firstPlace(index), all = this.run.poses.all;
        const turn = new THREE.Quaternion(all[pose + 3], all[pose + 4], all[pose + 5], all[pose + 6]);
        const at = new THREE.Vector3(...part.at)
                       .applyQuaternion(turn)
                       .add(new THREE.Vector3(all[pose], all[pose + 1], all[pose + 2]));
        this.addPlane(at, new THREE.Vector3(...part.outward).applyQuaternion(turn));
      }
    });
    for (const piece of this.run.about.scenery) {
      if (piece.plane)
        this.addPlane(new THREE.Vector3(...piece.from), new THREE.Vector3(...piece.outward));
      else
        this.addLine(new THREE.Vector3(...piece.from), new THREE.Vector3(...piece.to), piece.radius);
    }
  }
  addPlane(at, outward) {
    const {centre, size} = this.extent, ground = outward.y > 0.7;
    const near = centre.clone().addScaledVector(outward, -centre.clone().sub(at).dot(outward));
    const width = ground ? 60 * size : 2 * size;
    let material;
    if (ground) {
      const cell = Math.pow(10, Math.round(Math.log10(size / 8)));
      const grid = gridTexture('#e9edf2', '#cfd7e0');
      grid.repeat.set(width / cell, width / cell);
      material = new THREE.MeshStandardMaterial({map: grid, roughness: 1});
    } else {
      material = new THREE.MeshStandardMaterial(
          {color: 0x8fa3b8, transparent: true, opacity: 0.16, side: THREE.DoubleSide, depthWrite: false});
    }
    const mesh = new THREE.Mesh(new THREE.PlaneGeometry(width, width), material);
    mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), outward.clone().normalize());
    mesh.position.copy(near).addScaledVector(outward, -0.0004 * size);
    mesh.receiveShadow = ground;
    this.scene.add(mesh);
  }
  addLine(from, to, radius) {
    const mesh =
        new THREE.Mesh(new THREE.CylinderGeometry(1, 1, 1, 16), new THREE.MeshStandardMaterial({color: kStaticColour}));
    mesh.matrixAutoUpdate = false;
    rodMatrix(mesh.matrix, from, to, Math.max(radius, 0.003 * this.extent.size));
    mesh.castShadow = true;
    this.scene.add(mesh);
  }

  // Shows `frame`, `share` of the way to the next one.
  show(frame, share, options) {
    this.placeActors(frame, share);
    const body = new THREE.Matrix4(), whole = new THREE.Matrix4(), none = new THREE.Matrix4().makeScale(0, 0, 0);
    const from = new THREE.Vector3(), turn = new THREE.Quaternion(), one = new THREE.Vector3(1, 1, 1);
    for (const mesh of this.meshes) {
      mesh.userData.parts.forEach((part, i) => {
        const state = this.run.state(frame, part.actor);
        if (state === kGone) return mesh.setMatrixAt(i, none);
        body.compose(this.position(part.actor, from), turn.fromArray(this.at, 7 * part.actor + 3), one);
        mesh.setMatrixAt(i, whole.multiplyMatrices(body, part.local));
        this.colour(mesh, i, part.actor, state, frame, options);
      });
      mesh.instanceMatrix.needsUpdate = true;
    }
    for (const {part, edges} of this.outlines) {
      edges.visible = this.run.state(frame, part.actor) !== kGone;
      body.compose(this.position(part.actor, from), turn.fromArray(this.at, 7 * part.actor + 3), one);
      edges.matrix.multiplyMatrices(body, part.local);
      edges.matrixWorldNeedsUpdate = true;
    }
    if (this.focus) this.shineOn(this.position(this.focus.actor, from));
    this.overlay.show(frame, options);
    this.effects.show(frame, share, options);
  }
  // Shadows are fine only near what the light is on.
  shineOn(place) {
    this.sun.position.sub(this.sun.target.position).add(place);
    this.sun.target.position.copy(place);
  }
  position(actor, out) {
    return out.fromArray(this.at, 7 * actor);
  }

  placeActors(frame, share) {
    const {poses, actors} = this.run, next = Math.min(frame + 1, this.run.count - 1);
    for (let actor = 0; actor < actors.length; ++actor) {
      const a = 7 * this.run.place(frame, actor), b = 7 * this.run.place(next, actor), to = 7 * actor;
      const blend =
          a !== b && share > 0 && this.run.state(next, actor) !== kGone && this.run.state(frame, actor) !== kGone;
      for (let i = 0; i < 7; ++i) this.at[to + i] = poses.all[a + i];
      if (!blend) continue;
      let dot = 0, square = 0;
      for (let i = 3; i < 7; ++i) dot += poses.all[a + i] * poses.all[b + i];
      for (let i = 0; i < 7; ++i) {
        const end = i >= 3 && dot < 0 ? -poses.all[b + i] : poses.all[b + i];
        this.at[to + i] += share * (end - this.at[to + i]);
        if (i >= 3) square += this.at[to + i] * this.at[to + i];
      }
      for (let i = 3; i < 7; ++i) this.at[to + i] /= Math.sqrt(square);
    }
  }

  colour(mesh, i, actor, state, frame, options) {
    const parted = this.parted && this.parted.actor === actor && frame >= this.parted.frame;
    const look = parted ? 3 : state === kAsleep && options.sleep ? 2 : 1;
    if (mesh.userData.shown[i] === look) return;
    mesh.userData.shown[i] = look;
    const {type} = this.run.actors[actor];
    const colour = new THREE.Color(
        parted                   ? kPartedColour :
            type === 'static'     ? kStaticColour :
            type === 'kinematic' ? kKinematicColour :
            type === 'wheel'     ? kWheelColour :
                                   kColours[actor % kColours.length]);
    if (look === 2) colour.lerp(new THREE.Color(kAsleepColour), 0.72);
    mesh.setColorAt(i, colour);
    mesh.instanceColor.needsUpdate = true;
  }
}
