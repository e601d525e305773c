// Questions to a world: bodies, joints, records, queries, events, poses.
// SPDX-License-Identifier: MIT

import {given, id, out} from './calls.js';
import {IsostepError} from './errors.js';
import {Handle} from './handle.js';
import {unsigned} from './module.js';
import {Records} from './views.js';

export class AskedWorld extends Handle {
  /** An engine makes it; nothing else does. */
  constructor(calls, at) {
    super(calls.module, at, 'iso_world_destroy', 'world');
    Object.defineProperty(this, 'calls', {value: calls});
  }

  /** A function of this world; a refusal is thrown with the world's own report. */
  run(name, ...parts) {
    this.calls.begin();
    return this.runNow(name, ...parts);
  }
  /** Runs like run(), and keeps what was placed before. */
  runNow(name, ...parts) { return this.#told(() => this.calls.runNow(name, this.at, ...parts)); }
  #told(call) {
    try {
      return call();
    } catch (error) {
      if (!(error.status > 0)) throw error;
      const fault = this.#fault();  // of commands; what is only asked leaves it
      throw fault.command === error.command ? fault : error;
    }
  }
  #fault() {
    const {status, command, field, expected} = this.calls.run('world_fault', this.at, out('fault_report'));
    const text = at => this.module.text(at);
    const reason = text(this.module.call('iso_status_text', status));
    return new IsostepError({status, reason, command: text(command), field: text(field), expected: text(expected)});
  }

  // ---- the world

  /** The hash of the whole state, the same on every machine. */
  get hash() { return unsigned(this.module.call('iso_world_hash', this.at)); }
  /** The number of steps taken. */
  get tick() { return Number(unsigned(this.module.call('iso_world_tick', this.at))); }
  get settings() { return this.run('P_world_get_settings', out('settings')); }
  get counts() { return this.run('world_get_counts', out('world_counts')); }
  /** All bodies, ascending by slot. */
  bodies() { return this.#list('world_bodies', 'id'); }
  joints() { return this.#list('world_joints', 'id'); }
  #list(name, layout, ...words) {
    this.calls.begin();
    return this.#told(() => this.calls.listOut(name, layout, this.at, ...words));
  }

  // ---- bodies, joints, records

  hasBody(body) { return this.module.call('iso_body_exists', this.at, id(body, 'body')) !== 0; }
  hasShape(shape) { return this.module.call('iso_shape_exists', this.at, id(shape, 'shape')) !== 0; }
  hasJoint(joint) { return this.module.call('iso_joint_exists', this.at, id(joint, 'joint')) !== 0; }
  /** The body's pose, velocity, and what is asked most often beside them. */
  body(body) { return this.run('P_body_get_state', id(body, 'body'), out('body_state')); }
  bodyProperties(body) { return this.run('P_body_get_properties', id(body, 'body'), out('body_properties')); }
  /** The parts of its shape, in the body's frame. */
  children(body) { return this.#list('P_body_get_children', 'child', id(body, 'body')); }
  /** [m/s] The velocity of a point [m] that moves with the body. */
  velocityAt(body, point) {
    return this.run('P_body_get_velocity_at', id(body, 'body'), given('vec3', point), out('vec3'));
  }
  /** [kg m^2] The inertia about an axis through its centre of mass, world frame. */
  inertia(body, axis) {
    return this.run('P_body_get_inertia', id(body, 'body'), given('unit_vec3', axis), out('number'));
  }
  joint(joint) { return this.run('P_joint_get', id(joint, 'joint'), out('joint_properties')); }
  /** [m] The distance between the anchors; the error of a distance joint. */
  jointError(joint) { return this.run('P_joint_get_error', id(joint, 'joint'), out('number')); }
  /** [rad] or [m] The position that limits count; `axis` of a six-axis joint. */
  jointPosition(joint, axis) {
    if (axis === undefined) return this.run('P_joint_get_position', id(joint, 'joint'), out('number'));
    const number = this.calls.number('joint_axis', axis);
    return this.run('P_joint_get_axis_position', id(joint, 'joint'), number, out('number'));
  }
  /** The axis_drive on one axis of a six-axis joint, for get, set and remove; 0n where there is none. */
  axisDrive(joint, axis) {
    const number = this.calls.number('joint_axis', axis);
    return this.run('joint_get_axis_drive', id(joint, 'joint'), number, out('id'));
  }
  /** A record by its kind: get('thruster', id). */
  get(kind, record) {
    const name = this.calls.nameOf('records', kind);
    return this.run(`P_get_${name}`, id(record, 'record'), out(name));
  }
  /** The game's input to it: input('vehicle', id). */
  input(kind, record) {
    const name = `${this.calls.nameOf('inputs', kind)}_input`;
    return this.run(`P_get_${name}`, id(record, 'record'), out(name));
  }
  /** Its state after the last step: state('wheel', id). */
  state(kind, record) {
    const name = `${this.calls.nameOf('states', kind)}_state`;
    return this.run(`P_get_${name}`, id(record, 'record'), out(name));
  }

  // ---- queries, as of the last step or command

  /** The first hit, or null. */
  castRay(ray) { return this.#first('P_cast_ray', 'ray_cast', ray, 'ray_hit'); }
  /** All hits in order. */
  castRayAll(ray) { return this.#all('P_cast_ray_all', 'ray_cast', ray, 'ray_hit'); }
  castShape(cast) { return this.#first('P_cast_shape', 'shape_cast', cast, 'shape_hit'); }
  castShapeAll(cast) { return this.#all('P_cast_shape_all', 'shape_cast', cast, 'shape_hit'); }
  closestPoint(query) { return this.#first('P_closest_point', 'point_query', query, 'closest_body'); }
  overlapFirst(query) { return this.#first('P_overlap_first', 'overlap_query', query, 'overlap_hit'); }
  overlapShape(query) { return this.#all('P_overlap_shape', 'overlap_query', query, 'overlap_hit'); }
  /** Bodies whose bounds meet the box: a cheap first query. */
  overlapBox(query) { return this.#all('P_overlap_box', 'box_query', query, 'id'); }
  /** Casts many rays at once: at most `each` hits for each, the nearest, in order. */
  castRays(rays, each = 1) { return this.#many('P_cast_rays', 'ray_cast', rays, 'ray_hit', each); }
  castShapes(casts, each = 1) { return this.#many('P_cast_shapes', 'shape_cast', casts, 'shape_hit', each); }

  #placed(query) {
    this.calls.begin();
    return this.calls.withLists(query);
  }
  #first(name, layout, query, hit) {
    const codec = this.calls.layout(hit), asked = this.#placed(query);
    const at = this.calls.take(codec.size), found = this.calls.take(1);
    this.runNow(name, given(layout, asked), at, found);
    return this.module.view.getUint8(found) === 0 ? null : codec.read(this.module.view, at);
  }
  #all(name, layout, query, hit) {
    const at = this.calls.place(layout, this.#placed(query));
    return this.#told(() => this.calls.listOut(name, hit, this.at, at));
  }
  #many(name, layout, queries, hit, each) {
    this.calls.begin();
    const codec = this.calls.layout(hit);
    const at = this.calls.placeAll(layout, queries.map(query => this.calls.withLists(query)), 'queries');
    const hits = this.calls.take(codec.size * each * queries.length);
    this.runNow(name, at, queries.length, hits, each);
    return queries.map((_, query) => {
      const found = [];
      for (let i = 0; i < each; ++i) {
        const one = codec.read(this.module.view, hits + (query * each + i) * codec.size);
        if (one.body !== 0n) found.push(one);
      }
      return found;
    });
  }

  // ---- poses, and what the last step reports: Records, which outlive the world

  /** The poses of all moving bodies, between the last two steps; alpha from 0 to 1. They are always float. */
  poses(alpha = 1) { return this.#records('world_poses', 'render_pose', Float32Array, alpha); }
  contactBegins() { return this.#records('P_contact_begins', 'contact_begin'); }
  contactEnds() { return this.#records('contact_ends', 'body_pair'); }
  sensorBegins() { return this.#records('sensor_begins', 'sensor_event'); }
  sensorEnds() { return this.#records('sensor_ends', 'sensor_event'); }
  brokeEvents() { return this.#records('P_broke_events', 'broke'); }
  jointBrokeEvents() { return this.#records('P_joint_broke_events', 'joint_broke'); }
  /** The hits of bodies with a hit report. */
  contactHits() { return this.#records('P_contact_hits', 'contact_hit'); }
  /** The contact points of bodies with a contact report. */
  contactPoints() { return this.#records('P_contact_points', 'contact_point'); }
  fellAsleep() { return this.#records('fell_asleep', 'id').ids; }
  woke() { return this.#records('woke', 'id').ids; }
  /** The contact points of one body, as objects. */
  contactsOf(body) { return this.#list('P_body_get_contacts', 'contact_point', id(body, 'body')); }

  #records(name, layout, array = this.calls.numbers.array, ...words) {
    this.calls.begin();
    const pointer = this.calls.take(4), count = this.calls.take(4);
    this.calls.call(this.calls.full(name), this.at, ...words, pointer, count);
    const {view} = this.module;
    return new Records(this.module, this.calls.layout(layout), view.getUint32(pointer, true),
      view.getUint32(count, true), array);
  }
}
