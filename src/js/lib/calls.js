// Calls of the C interface with JavaScript's values: places arguments in memory, reads results, throws refusals.
// SPDX-License-Identifier: MIT

import {badValue, IsostepError, within} from './errors.js';
import {interfaceSchema} from './generated/interface.js';
import {Layouts, Placed} from './layout.js';
import {numbersOf} from './numbers.js';

/** An id as an argument. */
export function id(value, field) {
  if (typeof value !== 'bigint') throw badValue(field, 'an id, which is a BigInt', value);
  return value;
}

/** Arguments besides words: given(layout, value) by pointer, out(layout) to be read when the call succeeds. */
export const given = (layout, value, field = '') => ({layout, value, field});
export const out = layout => ({layout, isOut: true});

const kRoom = 64 << 10;  // [bytes] for the arguments of one call; larger ones are allocated for themselves

export class Calls {
  #defaults = new Map();
  #used = 0;

  constructor(module, scalar, raw) {
    this.module = module;
    this.scalar = scalar;
    this.numbers = numbersOf(scalar, raw);
    this.layouts = new Layouts(interfaceSchema, this.numbers);
    this.room = module.allocate(kRoom);
    this.large = [];  // allocations of this call
  }
  layout(name) { return this.layouts.of(name); }

  /** A function by its name without "iso_"; "P_..." is the scalar's own. Values that it writes are returned. */
  run(name, ...parts) {
    this.begin();
    return this.runNow(name, ...parts);
  }
  /** Runs like run(), and keeps what was placed before. */
  runNow(name, ...parts) {
    const words = new Array(parts.length);
    let result;
    for (let i = 0; i < parts.length; ++i) {
      const part = parts[i];
      if (part === null || typeof part !== 'object') {
        words[i] = part;
      } else {
        words[i] = part.isOut ? this.sized(part.layout)
                              : within(name.replace('P_', ''), () => this.place(part.layout, part.value, part.field));
        if (part.isOut) result = {codec: this.layout(part.layout), at: words[i]};
      }
    }
    this.call(this.full(name), ...words);
    return result?.codec.read(this.module.view, result.at);
  }
  full(name) { return `iso_${name.startsWith('P_') ? `${this.scalar}_${name.slice(2)}` : name}`; }

  /** The function by its full name; throws what its status says. */
  call(name, ...words) {
    const status = this.module.call(name, ...words);
    if (status !== 0) this.fail(name, status);
  }
  /** Throws a status in words: "world_create: hz: a number is beyond the scalar's limits; expected 10 to 10000". */
  fail(name, status) {
    const sentence = this.module.text(this.module.call('iso_last_error'));
    const parts = /^(\w+): (?:([\w.]+): )?([^;]+)(?:; expected (.*))?$/.exec(sentence);
    if (parts !== null) {
      const [, command, field, reason, expected] = parts;
      throw new IsostepError({status, reason, command, field, expected});
    }
    const command = name.replace(/^iso_/, '').replace(new RegExp(`^${this.scalar}_`), '');
    throw new IsostepError({status, reason: this.module.text(this.module.call('iso_status_text', status)), command});
  }

  // ---- room for arguments: until the next begin()

  begin() {
    this.#used = 0;
    for (const at of this.large.splice(0)) this.module.call('free', at);
  }
  take(size) {
    const rounded = Math.ceil(size / 8) * 8;
    if (this.#used + rounded > kRoom) {
      const at = this.module.allocate(rounded);
      this.large.push(at);
      return at;
    }
    this.#used += rounded;
    return this.room + this.#used - rounded;
  }
  /** A struct with its defaults: from its _init, which is called once. */
  sized(name) {
    const {size} = this.layout(name);
    const at = this.take(size);
    const defaults = this.#defaultsOf(name, size);
    if (defaults !== null) this.module.bytes(at, size).set(defaults);
    else this.module.bytes(at, size).fill(0);
    return at;
  }
  #defaultsOf(name, size) {
    let defaults = this.#defaults.get(name);
    if (defaults !== undefined) return defaults;
    const struct = interfaceSchema.structs[name];
    defaults = null;
    if (struct?.init !== undefined) {
      const at = this.take(size);
      this.call(this.full(struct.init), at, ...(struct.sized ? [size] : []));
      defaults = this.module.bytes(at, size).slice();
    } else if (struct !== undefined) {
      defaults = new Uint8Array(size);
      const view = new DataView(defaults.buffer);
      if (struct.sized) view.setUint32(0, size, true);
      const {write, places} = this.layout(name);
      for (const [key, kind] of struct.fields) {
        if (kind === 'quat') {
          write(view, 0, {[key]: [0, 0, 0, 1]});  // of zeros it is no turn
        } else if (kind in interfaceSchema.structs) {
          defaults.set(this.#defaultsOf(kind, this.layout(kind).size), places.get(key));
        }
      }
    }
    this.#defaults.set(name, defaults);
    return defaults;
  }
  place(name, value, field) {
    const at = this.sized(name);
    this.layout(name).write(this.module.view, at, value, field);
    return at;
  }
  /** Places values one behind the other: for lists of vectors, children, rays. */
  placeAll(name, values, field) {
    const codec = this.layout(name);
    const at = this.take(codec.size * values.length);
    for (let i = 0; i < values.length; ++i) {
      const defaults = this.#defaultsOf(name, codec.size);
      const here = at + i * codec.size;
      if (defaults !== null) this.module.bytes(here, codec.size).set(defaults);
      else this.module.bytes(here, codec.size).fill(0);
      codec.write(this.module.view, here, values[i], `${field}[${i}]`);
    }
    return at;
  }
  placeBytes(bytes, field) {
    if (!ArrayBuffer.isView(bytes)) throw badValue(field, 'a Uint8Array', bytes);
    const at = this.take(Math.max(bytes.byteLength, 1));
    this.module.bytes(at, bytes.byteLength).set(new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength));
    return at;
  }
  placeText(text, field) {
    if (typeof text !== 'string') throw badValue(field, 'a text', text);
    return this.placeBytes(new TextEncoder().encode(`${text}\0`), field);
  }

  // ---- results

  /** The bytes that a function writes as (bytes, size), asked for its size first. */
  bytesOut(name, ...words) {
    this.begin();
    const size = this.take(4);
    this.module.view.setUint32(size, 0, true);
    const status = this.module.call(name, ...words, 0, size);
    if (status !== 0 && status !== -4) this.fail(name, status);
    const need = this.module.view.getUint32(size, true);
    const at = this.take(Math.max(need, 1));
    this.call(name, ...words, at, size);
    return this.module.bytes(at, need).slice();
  }
  /** A copy of the bytes that a function shows as (pointer, size). */
  bytesSeen(name, ...words) {
    this.begin();
    const pointer = this.take(4), size = this.take(4);
    this.runNow(name, ...words, pointer, size);
    const {view} = this.module;
    return this.module.bytes(view.getUint32(pointer, true), view.getUint32(size, true)).slice();
  }
  /** The list that a function writes as (array, room, count), as objects; it is asked again where room lacked. */
  listOut(name, layout, ...words) {
    const codec = this.layout(layout);
    for (let room = 64;;) {
      const at = this.take(codec.size * room), count = this.take(4);
      const status = this.module.call(this.full(name), ...words, at, room, count);
      if (status !== 0 && status !== -4) this.fail(name, status);
      const found = this.module.view.getUint32(count, true);
      if (status === 0) return Array.from({length: found}, (_, i) => codec.read(this.module.view, at + i * codec.size));
      room = found;
    }
  }

  /** A query whose filter names lists, with those lists placed. */
  withLists(query) {
    const {ignoreAll, ignoreKinds} = query?.filter ?? {};
    if (ignoreAll === undefined && ignoreKinds === undefined) return query;
    const placed = (values, kind, field) => values && new Placed(this.placeAll(kind, values, field), values.length);
    return {...query, filter: {
      ...query.filter,
      ignoreAll: placed(ignoreAll, 'id', 'filter.ignoreAll'),
      ignoreKinds: placed(ignoreKinds, 'u32', 'filter.ignoreKinds')
    }};
  }

  /** A kind of record, shape or joint, if it is one. */
  nameOf(list, kind) {
    if (interfaceSchema[list].includes(kind)) return kind;
    throw badValue('kind', interfaceSchema[list].join(', '), kind);
  }
  /** An enumerator's number by its name, and its name by its number. */
  number(kind, name) {
    const names = interfaceSchema.enums[kind];
    if (typeof name === 'string' && Object.hasOwn(names, name)) return names[name];
    throw badValue(kind, Object.keys(names).map(word => `"${word}"`).join(', '), name);
  }
  enumerator(kind, number) {
    const names = interfaceSchema.enums[kind];
    return Object.keys(names).find(name => names[name] === number) ?? number;
  }
}
