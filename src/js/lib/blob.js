// Hulls, meshes and height fields: points, triangles, heights that are shared, immutable, and named by their content.
// SPDX-License-Identifier: MIT

import {given, out} from './calls.js';
import {badValue} from './errors.js';
import {Handle} from './handle.js';

export class Blob extends Handle {
  #calls;
  constructor(calls, at) {
    super(calls.module, at, 'iso_blob_destroy', 'blob');
    this.#calls = calls;
  }
  /** 'hull', 'mesh' or 'height_field'. */
  get type() { return this.#calls.run('blob_get_type', this.at, out('shape_type')); }
  /** The hash of its content, equal on every machine. */
  get name() {
    this.#calls.begin();
    const low = this.#calls.take(8), high = this.#calls.take(8);
    this.#calls.runNow('blob_get_name', this.at, low, high);
    const {view} = this.module;
    return view.getBigUint64(high, true) << 64n | view.getBigUint64(low, true);
  }
  /** Returns a file like those of `isostep bake`. */
  write() { return this.#calls.bytesOut('iso_blob_write', this.at); }
}

const home = (calls, name) => calls.number('blob_home', name);
const made = (calls, name, ...parts) => new Blob(calls, calls.runNow(name, ...parts, out('u32')));

/** Makes a hull of points [m], [[x, y, z], ...]. */
export function createHull(calls, points, where = 'carried') {
  calls.begin();
  return made(calls, 'P_blob_create_hull', calls.placeAll('vec3', points, 'points'), points.length, home(calls, where));
}

/** Places numbers as doubles: nested or flat, or a typed array. */
function doubles(calls, values, field) {
  return calls.placeBytes(Float64Array.from(Array.isArray(values) ? values.flat() : values), field);
}
/** Places {numbers, table: [{friction, restitution}]} of triangles or cells, or none. */
function materialsAt(calls, materials) {
  if (materials === undefined) return 0;
  const numbers = Uint8Array.from(materials.numbers ?? []);
  const table = (materials.table ?? []).flatMap(({friction, restitution}) => [friction, restitution]);
  return calls.place('surface_materials', {
    count: numbers.length, numbers: calls.placeBytes(numbers, 'materials.numbers'),
    tableCount: table.length / 2, table: doubles(calls, table, 'materials.table')
  });
}

/** Takes {points: [[x, y, z], ...] [m], triangles: [[0, 1, 2], ...], materials}, counter-clockwise from outside. */
export function createMesh(calls, {points, triangles, materials}, where = 'carried') {
  calls.begin();
  const corners = Uint32Array.from(Array.isArray(triangles) ? triangles.flat() : triangles);
  const places = Array.isArray(points) ? points.flat() : points;
  if (corners.length % 3 !== 0) throw badValue('triangles', 'three corners each', corners.length);
  if (places.length % 3 !== 0) throw badValue('points', 'three numbers each', places.length);
  const mesh = {
    pointCount: places.length / 3, points: doubles(calls, places, 'points'),
    triangleCount: corners.length / 3, vertices: calls.placeBytes(corners, 'triangles')
  };
  return made(calls, 'blob_create_mesh', given('triangles', mesh), materialsAt(calls, materials), home(calls, where));
}

/** Takes {columns, rows, pitch [m], heights [m] by rows, materials}. */
export function createHeightField(calls, {columns, rows, pitch, heights, materials}, where = 'carried') {
  calls.begin();
  const flat = Array.isArray(heights) ? heights.flat() : heights;
  if (flat.length !== columns * rows) throw badValue('heights', 'columns times rows of them', flat.length);
  const sheet = {columns, rows, pitch, heights: doubles(calls, flat, 'heights')};
  return made(calls, 'blob_create_height_field', given('height_sheet', sheet), materialsAt(calls, materials),
    home(calls, where));
}

/** Reads a file of `isostep bake`, or one that Blob.write returned. */
export function readBlob(calls, bytes, where = 'carried') {
  calls.begin();
  return made(calls, 'blob_read', calls.placeBytes(bytes, 'bytes'), bytes.byteLength, home(calls, where));
}
