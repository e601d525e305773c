// A world: every way to change it between steps, its steps, and its state.
// SPDX-License-Identifier: MIT

import {AskedWorld} from './asked.js';
import {given, id, out} from './calls.js';
import {badValue, within} from './errors.js';
import {Handle} from './handle.js';

export class World extends AskedWorld {
  // ---- time

  /** One step of 1 / hz seconds; what it had to mend, all 0 in a sound world. */
  step() { return this.run('world_step', out('step_report')); }
  setGravity(gravity) { this.run('P_world_set_gravity', given('vec3', gravity, 'gravity')); }

  // ---- shapes

  /** addShape('box', {halfExtents: [0.5, 0.5, 0.5]}), 'sphere', 'capsule', ...: shared by the bodies that name it. */
  addShape(kind, shape = {}) {
    const name = this.calls.nameOf('shapes', kind);
    return this.run(`P_add_${name}`, given(name, shape), out('id'));
  }
  /** Of a hull, a mesh or a height field. A hull may have a radius around it. */
  addBlob(blob, {radius} = {}) {
    if (radius === undefined) return this.run('add_blob', blob.at, out('id'));
    return this.run('P_add_hull', given('hull', {radius}), blob.at, out('id'));
  }
  /** Parts at poses of their own: {kind: 'box', shape: {...}, pose: {position, orientation}}, or with a blob; and what
      they have of their own: {traits: {flags: PartFlags.ownMaterial, material: {...}}, userData}. */
  addCompound(parts) {
    const blobs = [...new Set(parts.map(part => part.blob).filter(Boolean))];
    const children = parts.map(({kind, shape, blob, ...own}) =>
      ({...own, primitive: this.#primitive(kind, shape, blob, blobs)}));
    this.calls.begin();
    const list = this.calls.take(4 * Math.max(blobs.length, 1));
    blobs.forEach((blob, i) => this.module.view.setUint32(list + 4 * i, blob.at, true));
    const at = this.calls.placeAll('child', children, 'parts');
    return this.runNow('P_add_compound', at, children.length, list, blobs.length, out('id'));
  }
  #primitive(kind, shape = {}, blob, blobs) {
    if (blob !== undefined) return {type: blob.type, blob: 1 + blobs.indexOf(blob)};
    return this.primitive(kind, shape);
  }
  /** A shape as a primitive: for queries. */
  primitive(kind, shape = {}) {
    const name = this.calls.nameOf('shapes', kind);
    return this.calls.run(`P_${name}_primitive`, given(name, shape), out('primitive'));
  }
  removeShape(shape) { this.run('remove_shape', id(shape, 'shape')); }
  /** What states and commands name and do not carry: blobs whose home is 'asset'. */
  addAsset(blob) { this.run('world_add_asset', blob.at); }
  /** Other heights for a part of the field that is that child of the shape: {column, row, columns, rows, heights}. */
  setHeights(shape, child, {column, row, columns, rows, heights, materials}) {
    this.calls.begin();
    const patch = {column, row, columns, rows, heights: this.calls.placeBytes(Int16Array.from(heights), 'heights')};
    if (materials !== undefined) patch.materials = this.calls.placeBytes(Uint8Array.from(materials), 'materials');
    if (heights.length !== columns * rows) throw badValue('heights', 'columns times rows of them', heights.length);
    this.runNow('set_heights', id(shape, 'shape'), child, given('height_patch', patch));
  }

  // ---- bodies

  /** {type: 'dynamic', shape, position: [0, 2, 0], ...}; what is not named has its default. */
  createBody(definition) { return this.run('P_body_create', given('body_definition', definition), out('id')); }
  destroyBody(body) { this.run('body_destroy', id(body, 'body')); }
  /** The same as one by one, for the price of one; how many there were. */
  destroyBodies(bodies) {
    this.calls.begin();
    return this.runNow('bodies_destroy', this.calls.placeAll('id', bodies, 'bodies'), bodies.length, out('u32'));
  }
  wake(body) { this.run('body_wake', id(body, 'body')); }
  sleep(body) { this.run('body_sleep', id(body, 'body')); }
  /** false: takes part in nothing until it is enabled again; id, pose, joints and records stay. */
  setEnabled(body, enabled) { this.run('body_set_enabled', id(body, 'body'), enabled ? 1 : 0); }
  setFilter(body, filter) { this.run('body_set_filter', id(body, 'body'), given('filter', filter)); }
  setUserData(body, userData) {
    this.run('body_set_user_data', id(body, 'body'), BigInt.asUintN(64, BigInt(userData)));
  }
  /** Teleports; velocity stays. */
  setPose(body, pose) { this.run('P_body_set_pose', id(body, 'body'), given('pose', pose)); }
  setVelocity(body, linear, angular = [0, 0, 0]) {
    this.#push('P_body_set_velocity', body, linear, angular, 'angular');
  }
  setMaterial(body, material) { this.run('P_body_set_material', id(body, 'body'), given('material', material)); }
  /** locks: bits of BodyFlags. */
  setMotion(body, {gravityScale = 1, linearDamping = 0, angularDamping = 0, locks = 0} = {}) {
    const {word} = this.calls.numbers.scalar;
    this.run('P_body_set_motion', id(body, 'body'), word(gravityScale, 'gravityScale'),
      word(linearDamping, 'linearDamping'), word(angularDamping, 'angularDamping'), locks);
  }
  /** `mass`: of what becomes dynamic. */
  setType(body, type, mass = {}) {
    const number = this.calls.number('body_type', type);
    this.run('P_body_set_type', id(body, 'body'), number, given('body_mass', mass));
  }
  setMass(body, mass) { this.run('P_body_set_mass', id(body, 'body'), given('body_mass', mass)); }
  /** Another shape; id, pose, joints and records stay. Without `mass` a dynamic body keeps its own. */
  setShape(body, shape, mass) {
    const weight = mass === undefined ? 0 : given('body_mass', mass);
    this.run('P_body_set_shape', id(body, 'body'), id(shape, 'shape'), weight);
  }
  /** The next step carries a kinematic body there. */
  moveTo(body, pose) { this.run('P_body_move_to', id(body, 'body'), given('pose', pose)); }
  /** [N], [N m] over the next step. */
  applyForce(body, force, torque = [0, 0, 0]) { this.#push('P_body_apply_force', body, force, torque, 'torque'); }
  applyForceAt(body, force, point) { this.#push('P_body_apply_force_at', body, force, point, 'point'); }
  /** [kg m/s], [kg m^2/s] at once. */
  applyImpulse(body, impulse, angular = [0, 0, 0]) {
    this.#push('P_body_apply_impulse', body, impulse, angular, 'angular');
  }
  applyImpulseAt(body, impulse, point) { this.#push('P_body_apply_impulse_at', body, impulse, point, 'point'); }
  #push(name, body, linear, other, field) {
    this.run(name, id(body, 'body'), given('vec3', linear, 'linear'), given('vec3', other, field));
  }

  // ---- joints

  /** createJoint('hinge', {a, b, anchor, axis, ...}); a body of 0n is the world. */
  createJoint(kind, joint) {
    const name = this.calls.nameOf('joints', kind);
    return this.run(`P_create_${name}`, given(name, joint), out('id'));
  }
  /** A joint whose frames lie where `frame` (world) is now. Add limits, motor, spring; then createJointOf. */
  jointAt(type, a, b, frame) {
    const number = this.calls.number('joint_type', type);
    return this.run('P_joint_at', number, id(a, 'a'), id(b, 'b'), given('pose', frame), out('joint_properties'));
  }
  jointBetween(type, a, frameA, b, frameB) {
    const number = this.calls.number('joint_type', type);
    return this.run('P_joint_between', number, id(a, 'a'), given('pose', frameA, 'frameA'), id(b, 'b'),
      given('pose', frameB, 'frameB'), out('joint_properties'));
  }
  createJointOf(properties) { return this.run('P_joint_create', given('joint_properties', properties), out('id')); }
  /** Limits, motor and spring; bodies, frames and type stay. */
  setJoint(joint, properties) { this.run('P_joint_set', id(joint, 'joint'), given('joint_properties', properties)); }
  /** Parts of it: [rad] or [m]; a motor without torque, a spring without frequency is none. */
  setLimits(joint, lower, upper) { this.#setNumbers('limits', joint, {lower, upper}); }
  setMotor(joint, speed, torque) { this.#setNumbers('motor', joint, {speed, torque}); }
  setSpring(joint, frequency, damping) { this.#setNumbers('spring', joint, {frequency, damping}); }
  setTarget(joint, target) { this.#setNumbers('target', joint, {target}); }
  #setNumbers(what, joint, numbers) {
    const {word} = this.calls.numbers.scalar;
    this.run(`P_joint_set_${what}`, id(joint, 'joint'), ...Object.entries(numbers).map(([name, x]) => word(x, name)));
  }
  destroyJoint(joint) { this.run('joint_destroy', id(joint, 'joint')); }
  /** A figure of bodies and joints, one of each a bone: {bodies, joints}. A root's joint is 0n. */
  addRagdoll(bones, settings = {}) {
    this.calls.begin();
    const at = this.calls.placeAll('ragdoll_bone', bones, 'bones');
    const bodies = this.calls.take(8 * bones.length), joints = this.calls.take(8 * bones.length);
    this.runNow('P_add_ragdoll', at, bones.length, given('ragdoll_settings', settings), bodies, joints);
    const read = from => bones.map((_, i) => this.module.view.getBigUint64(from + 8 * i, true));
    return {bodies: read(bodies), joints: read(joints)};
  }

  // ---- records: what acts from step to step

  /** add('thruster', {body, force, ...}): its id. */
  add(kind, record) {
    const name = this.calls.nameOf('records', kind);
    return this.run(`P_add_${name}`, given(name, record), out('id'));
  }
  /** These members of it; the others stay, bit for bit. */
  set(kind, record, changes) { this.#change(this.calls.nameOf('records', kind), record, changes); }
  /** What a game asks of it until it asks something else: setInput('character', id, {move: [1, 0, 0]}). */
  setInput(kind, record, changes) { this.#change(`${this.calls.nameOf('inputs', kind)}_input`, record, changes); }
  #change(name, record, changes) {
    const {calls} = this;
    calls.begin();
    const at = calls.sized(name);
    this.runNow(`P_get_${name}`, id(record, 'record'), at);
    within(`set_${name}`, () => calls.layout(name).write(calls.module.view, at, changes, ''));
    this.runNow(`P_set_${name}`, record, at);
  }
  remove(kind, record) { this.run(`remove_${this.calls.nameOf('records', kind)}`, id(record, 'record')); }
  /** Pieces in place of bodies that a step broke, at most `most` bodies. Once a frame. */
  breakBodies(most) { return this.run('break_bodies', most, out('break_report')); }

  // ---- state

  /** A place to save to, once or every frame. */
  createSnapshot() { return new Snapshot(this.calls, this.run('snapshot_create', out('u32'))); }
  save(snapshot) { this.run('world_save', snapshot.at); }
  /** Same ids, same future. */
  load(snapshot) { this.run('world_load', snapshot.at); }
  /** The portable form, for files and late joiners. */
  write() { return this.calls.bytesOut('iso_world_write', this.at); }
  /** The portable form of a world of the same scalar; its settings come along. */
  read(bytes) { this.#bytes('world_read', bytes); }
  /** Commands and steps as a log or a replay has them. What comes before an error was done: load, then. */
  apply(commands) { this.#bytes('world_apply', commands); }
  #bytes(name, bytes) {
    this.calls.begin();
    this.runNow(name, this.calls.placeBytes(bytes, 'bytes'), bytes.byteLength);
  }
  /** true: every accepted command and every step is appended to the log. */
  keepLog(on) { this.run('world_keep_log', on ? 1 : 0); }
  /** A copy of it. */
  log() {
    this.calls.begin();
    const pointer = this.calls.take(4), size = this.calls.take(4);
    this.runNow('world_log', pointer, size);
    return this.module.bytes(this.module.view.getUint32(pointer, true), this.module.view.getUint32(size, true)).slice();
  }
  clearLog() { this.run('world_clear_log'); }
  /** Records into the tape from the state that the world has now. */
  record(tape, scene) {
    this.calls.begin();
    this.runNow('world_record', tape.at, this.calls.placeText(scene, 'scene'));
  }

  // ---- how, which never changes a bit

  useBroadPhase(name) { this.run('world_use_broad_phase', this.calls.number('broad_phase', name)); }
  get broadPhase() { return this.run('world_get_broad_phase', out('broad_phase')); }
  get simdName() { return this.module.text(this.module.call('iso_world_simd_name', this.at)); }
}

/** A state of a world. One that is saved to again allocates nothing. */
export class Snapshot extends Handle {
  #calls;
  constructor(calls, at) {
    super(calls.module, at, 'iso_snapshot_destroy', 'snapshot');
    this.#calls = calls;
  }
  /** [bytes] What it holds for itself. */
  get byteLength() { return this.#calls.run('snapshot_get_size', this.at, out('u32')); }
}
