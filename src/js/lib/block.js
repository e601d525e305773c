// A game's own state: named numbers in the engine's memory, where a session saves, rolls back, hashes and sends them.
// SPDX-License-Identifier: MIT

import {badValue, IsostepError} from './errors.js';
import {Handle} from './handle.js';
import {kPlain} from './layout.js';

const kArrays = {
  u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, u64: BigUint64Array,
  i8: Int8Array, i16: Int16Array, i32: Int32Array, i64: BigInt64Array, f32: Float32Array, f64: Float64Array
};

/** The members [[name, type, offset, count or undefined]] and their size, laid out as in a C struct. */
function layoutOf(fields) {
  const places = [];
  let end = 0, align = 1;
  for (const [name, kind] of Object.entries(fields)) {
    const [type, count] = Array.isArray(kind) ? kind : [kind];
    if (!Object.hasOwn(kArrays, type)) throw badValue(name, `one of ${Object.keys(kArrays).join(', ')}`, type);
    if (count !== undefined && !(Number.isInteger(count) && count > 0)) throw badValue(name, 'a count above 0', count);
    const {size} = kPlain[type];
    end = Math.ceil(end / size) * size;
    places.push([name, type, end, count]);
    end += size * (count ?? 1);
    align = Math.max(align, size);
  }
  if (end === 0) throw new IsostepError({status: -100, reason: 'a block without fields', field: 'fields'});
  return {places, size: Math.ceil(end / align) * align};
}

/**
 * The block of `fields`: {touches: 'u32', lives: ['i8', 4]}. A number is a property, an array a typed array that shows
 * the memory itself: take it anew after anything that may make the memory grow. All of it begins as 0.
 */
export function makeBlock(module, fields) {
  const {places, size} = layoutOf(fields);
  const at = module.allocate(size);
  module.bytes(at, size).fill(0);
  const block = new Block(module, at, size);
  for (const [name, type, offset, count] of places) {
    if (name in block) throw badValue(name, 'a name that a block has no use for itself', name);
    const {read, write} = kPlain[type];
    const property = count === undefined ? {
      get: () => read(module.view, block.at + offset),
      set(value) { write(module.view, block.at + offset, value, name); }
    } : {get: () => new kArrays[type](module.exports.memory.buffer, block.at + offset, count)};
    Object.defineProperty(block, name, {...property, enumerable: true});
  }
  return block;
}

class Block extends Handle {
  constructor(module, at, size) {
    super(module, at, 'free', 'block');
    this.byteLength = size;
  }
}
