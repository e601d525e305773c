// What is drawn over a view's bodies: joints, springs and links, contact points, the mark on the body that parted.
// SPDX-License-Identifier: MIT

const kBondColours = {
  spring: 0x2f9c8f,
  bungee: 0xe08a2e,
  stiff: 0x7a5bb5,
  cable: 0x4a5563,
  rod: 0x9c3f4f
};
const kJointColour = 0x8436b0;
const kContactColour = 0xd01f4f;

function isTie(bond) {
  return bond.kind in kBondColours;
}

class Overlay {
  constructor(view) {
    this.view = view;
    this.run = view.run;
    this.extent = view.extent;
    this.parted = view.parted;
    this.scene = view.scene;
    this.addBonds();
    this.addPoints();
    this.addMark();
  }
  show(frame, options) {
    this.showBonds(frame, options);
    this.showPoints(frame, options);
    this.showMark(frame);
  }

  addBonds() {
    const all = this.run.about.bonds, ties = all.filter(isTie);
    this.joints = all.filter((bond) => !isTie(bond));
    this.ties = null;
    if (ties.length > 0) {
      const material = new THREE.MeshStandardMaterial({roughness: 0.8});
      this.ties = new THREE.InstancedMesh(new THREE.CylinderGeometry(1, 1, 1, 6, 1, true), material, ties.length);
      this.ties.userData.bonds = ties;
      this.ties.castShadow = true;
      this.ties.frustumCulled = false;
      ties.forEach((bond, i) => this.ties.setColorAt(i, new THREE.Color(kBondColours[bond.kind])));
      this.scene.add(this.ties);
    }
    this.jointLines = this.lines(this.joints.length * 3, kJointColour);
    this.jointDots = this.dots(this.joints.length * 2, kJointColour, this.joints.length > 20 ? 3 : 6);
  }
  addPoints() {
    const most = this.run.frames.reduce((most, frame) => Math.max(most, frame.points.length / 7), 0);
    this.pointDots = this.dots(most, kContactColour, 5);
    this.pointLines = this.lines(most, kContactColour);
    this.strongest = 0;
    for (const frame of this.run.frames) {
      for (let i = 6; i < frame.points.length; i += 7) this.strongest = Math.max(this.strongest, frame.points[i]);
    }
  }
  // Seen through bodies: what they show lies between or inside them.
  lines(count, colour) {
    const material = new THREE.LineBasicMaterial({color: colour, depthTest: false, transparent: true, opacity: 0.9});
    return this.cloud(new THREE.LineSegments(new THREE.BufferGeometry(), material), 2 * count);
  }
  dots(count, colour, pixels) {
    const material = new THREE.PointsMaterial(
        {color: colour, size: pixels, sizeAttenuation: false, depthTest: false, transparent: true, opacity: 0.9});
    return this.cloud(new THREE.Points(new THREE.BufferGeometry(), material), count);
  }
  cloud(object, count) {
    object.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    object.frustumCulled = false;
    object.renderOrder = 2;
    this.scene.add(object);
    return object;
  }

  // A frame around the body that parted, and a pin above it.
  addMark() {
    this.mark = new THREE.LineSegments(
        new THREE.EdgesGeometry(new THREE.BoxGeometry(1, 1, 1)),
        new THREE.LineBasicMaterial({color: kPartedColour, depthTest: false}));
    this.pin = new THREE.Mesh(
        new THREE.ConeGeometry(1, 2.4, 20).rotateX(Math.PI),
        new THREE.MeshBasicMaterial({color: kPartedColour, depthTest: false}));
    for (const mesh of [this.mark, this.pin]) {
      mesh.renderOrder = 3;
      mesh.visible = false;
      this.scene.add(mesh);
    }
  }

  end(actor, local, out) {
    out.fromArray(local);
    if (actor < 0) return out;
    const turn = new THREE.Quaternion().fromArray(this.view.at, 7 * actor + 3);
    return out.applyQuaternion(turn).add(new THREE.Vector3().fromArray(this.view.at, 7 * actor));
  }
  showBonds(frame, options) {
    const a = new THREE.Vector3(), b = new THREE.Vector3(), matrix = new THREE.Matrix4();
    const is = (bond) => frame >= bond.first && frame <= bond.last;
    if (this.ties) {
      this.ties.visible = options.joints;
      this.ties.userData.bonds.forEach((bond, i) => {
        this.end(bond.a, bond.at_a, a), this.end(bond.b, bond.at_b, b);
        rodMatrix(matrix, a, b, is(bond) ? 0.0016 * this.extent.size : 0);
        this.ties.setMatrixAt(i, matrix);
      });
      this.ties.instanceMatrix.needsUpdate = true;
    }
    const lines = [], dots = [], centre = new THREE.Vector3();
    for (const bond of options.joints ? this.joints : []) {
      if (!is(bond)) continue;
      this.end(bond.a, bond.at_a, a), this.end(bond.b, bond.at_b, b);
      lines.push(...a, ...b);
      for (const [actor, anchor] of [[bond.a, a], [bond.b, b]]) {
        if (actor >= 0) lines.push(...this.view.position(actor, centre), ...anchor);
        dots.push(...anchor);
      }
    }
    fill(this.jointLines, lines);
    fill(this.jointDots, dots);
  }

  showPoints(frame, options) {
    const points = options.contacts ? this.run.frames[this.run.pointsFrame(frame)].points : [];
    const dots = [], lines = [], length = 0.05 * this.extent.size;
    for (let i = 0; i < points.length; i += 7) {
      const at = points.slice(i, i + 3), long = length * Math.log1p(points[i + 6]) / Math.log1p(this.strongest || 1);
      dots.push(...at);
      lines.push(...at, at[0] + long * points[i + 3], at[1] + long * points[i + 4], at[2] + long * points[i + 5]);
    }
    fill(this.pointDots, dots);
    fill(this.pointLines, lines);
  }

  showMark(frame) {
    const is = this.parted !== null && frame >= this.parted.frame && this.run.state(frame, this.parted.actor) !== kGone;
    this.mark.visible = this.pin.visible = is;
    if (!is) return;
    const actor = this.run.actors[this.parted.actor];
    let reach = Math.max(actor.radius || 0, 0.008 * this.extent.size);
    for (const part of actor.parts || [])
      reach = Math.max(reach, ...part.at.map((at, i) => Math.abs(at) + part.half[i] + part.radius));
    this.view.position(this.parted.actor, this.mark.position);
    this.mark.quaternion.fromArray(this.view.at, 7 * this.parted.actor + 3);
    this.mark.scale.setScalar(2.3 * reach);
    const size = Math.max(0.35 * reach, 0.012 * this.extent.size);
    this.pin.scale.setScalar(size);
    this.pin.position.copy(this.mark.position).y += 1.9 * reach + 1.3 * size;
  }
}

// A unit cylinder between two points; radius 0: nothing to see.
function rodMatrix(matrix, from, to, radius) {
  const along = to.clone().sub(from), length = along.length();
  if (length === 0 || radius === 0) return matrix.makeScale(0, 0, 0);
  const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.divideScalar(length));
  return matrix.compose(from.clone().add(to).multiplyScalar(0.5), turn, new THREE.Vector3(radius, length, radius));
}
function fill(cloud, numbers) {
  const attribute = cloud.geometry.getAttribute('position');
  attribute.array.set(numbers);
  attribute.needsUpdate = true;
  cloud.geometry.setDrawRange(0, numbers.length / 3);
}
