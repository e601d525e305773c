// Structs of the C interface as plain objects: reads and writes them by the layouts of generated/interface.js.
// SPDX-License-Identifier: MIT
//
// Vectors are [x, y, z], quaternions [x, y, z, w], ids and other 64-bit integers BigInt, enumerators their names, bools
// true and false, arrays arrays. Members that an object does not name keep their defaults; what the struct has not is
// an error.

import {badValue, kBadEnum, IsostepError} from './errors.js';

const integer = (bits, signed) => {
  const size = bits / 8, name = `${signed ? 'Int' : 'Uint'}${bits}`;
  const least = signed ? -(2 ** (bits - 1)) : 0, most = signed ? 2 ** (bits - 1) - 1 : 2 ** bits - 1;
  return {
    size,
    read: (view, at) => view[`get${name}`](at, true),
    write(view, at, value, field) {
      if (!Number.isInteger(value) || value < least || value > most) {
        throw badValue(field, `an integer from ${least} to ${most}`, value);
      }
      view[`set${name}`](at, value, true);
    }
  };
};
const word64 = signed => ({
  size: 8,
  read: signed ? (view, at) => view.getBigInt64(at, true) : (view, at) => view.getBigUint64(at, true),
  write(view, at, value, field) {
    const whole = Number.isSafeInteger(value) ? BigInt(value) : value;
    const wrapped = typeof whole === 'bigint' ? (signed ? BigInt.asIntN : BigInt.asUintN)(64, whole) : undefined;
    if (wrapped !== whole || wrapped === undefined) {
      throw badValue(field, `${signed ? 'a signed' : 'an'} integer of 64 bits, a BigInt`, value);
    }
    view.setBigUint64(at, BigInt.asUintN(64, whole), true);
  }
});
const kBool = {
  size: 1,
  read: (view, at) => view.getUint8(at) !== 0,
  write(view, at, value, field) {
    if (typeof value !== 'boolean') throw badValue(field, 'true or false', value);
    view.setUint8(at, value ? 1 : 0);
  }
};
const kFloat = {
  size: 4,
  read: (view, at) => view.getFloat32(at, true),
  write(view, at, value, field) {
    if (typeof value !== 'number') throw badValue(field, 'a number', value);
    view.setFloat32(at, value, true);
  }
};
const kDouble = {
  size: 8,
  read: (view, at) => view.getFloat64(at, true),
  write(view, at, value, field) {
    if (typeof value !== 'number') throw badValue(field, 'a number', value);
    view.setFloat64(at, value, true);
  }
};
export const kPlain = {
  u8: integer(8, false), u16: integer(16, false), u32: integer(32, false),
  i8: integer(8, true), i16: integer(16, true), i32: integer(32, true),
  u64: word64(false), i64: word64(true), id: word64(false), bool: kBool, f32: kFloat, f64: kDouble,
  word: integer(32, false),  // a pointer or a size of C
  pointer: {  // of eight bytes on every target, of which four count here
    size: 8,
    read: (view, at) => view.getUint32(at, true),
    write: (view, at, value) => view.setBigUint64(at, BigInt(value), true)
  }
};

/** The codec of enumerators by name: {static: 0, kinematic: 1, dynamic: 2}. */
function enumeration(names) {
  const words = Object.keys(names), byValue = new Map(words.map(word => [names[word], word]));
  return {
    size: 4,
    read: (view, at) => byValue.get(view.getUint32(at, true)) ?? view.getUint32(at, true),
    write(view, at, value, field) {
      if (typeof value !== 'string' || !Object.hasOwn(names, value)) {
        const expected = words.map(word => `"${word}"`).join(', ');
        throw new IsostepError({status: kBadEnum, reason: `${String(value)} is none of its names`, field, expected});
      }
      view.setUint32(at, names[value], true);
    }
  };
}

/** The codec of `count` of `element`, one after the other; it takes an array of any kind. */
function sequence(element, count) {
  return {
    size: element.size * count,
    read(view, at) {
      const out = new Array(count);
      for (let i = 0; i < count; ++i) out[i] = element.read(view, at + i * element.size);
      return out;
    },
    write(view, at, value, field) {
      if (value === null || typeof value !== 'object' || value.length !== count) {
        throw badValue(field, `${count} numbers`, value);
      }
      for (let i = 0; i < count; ++i) element.write(view, at + i * element.size, value[i], field);
    }
  };
}

/** The codec of characters, ended by a zero byte. */
function characters(count) {
  return {
    size: count,
    read(view, at) {
      const bytes = new Uint8Array(view.buffer, at, count), end = bytes.indexOf(0);
      return new TextDecoder().decode(bytes.subarray(0, end < 0 ? count : end));
    },
    write(view, at, value, field) {
      if (typeof value !== 'string') throw badValue(field, 'a text', value);
      const text = new TextEncoder().encode(value);
      if (text.length >= count || text.includes(0)) throw badValue(field, `at most ${count - 1} bytes of text`, value);
      const bytes = new Uint8Array(view.buffer, at, count);
      bytes.fill(0);
      bytes.set(text);
    }
  };
}

/** The codec of `count` bytes as a Uint8Array; the number before them says how many are used. */
function byteArray(count, usedOffset) {
  return {
    size: count,
    read: (view, at) => new Uint8Array(view.buffer, at, view.getUint32(at + usedOffset, true)).slice(),
    write(view, at, value, field) {
      if (!(value instanceof Uint8Array) || value.length > count) {
        throw badValue(field, `a Uint8Array of at most ${count} bytes`, value);
      }
      new Uint8Array(view.buffer, at, count).fill(0).set(value);
      view.setUint32(at + usedOffset, value.length, true);
    }
  };
}

/** A list elsewhere in memory, by its place and its length: Calls.list() makes it. */
export class Placed {
  constructor(at, count) { Object.assign(this, {at, count}); }
}
function list(countOffset) {
  return {
    size: 8,
    read: (view, at) => view.getUint32(at, true),
    write(view, at, value, field) {
      if (!(value instanceof Placed)) throw badValue(field, 'a list that this function takes', value);
      view.setBigUint64(at, BigInt(value.at), true);
      view.setUint32(at + countOffset, value.count, true);
    }
  };
}

/** The codec of a value that may be missing, null; a byte `has` says whether it is there. */
function optional(element, hasOffset) {
  return {
    size: element.size,
    read: (view, at) => view.getUint8(at + hasOffset) === 0 ? null : element.read(view, at),
    write(view, at, value, field) {
      view.setUint8(at + hasOffset, value === null ? 0 : 1);
      if (value !== null) element.write(view, at, value, field);
    }
  };
}

/**
 * The structs of one scalar. `schema`: {structs, enums}; a struct is {size: [bytes], fields: [[key, kind, place, count,
 * partner]]}. Sizes and places are pairs where they depend on the numbers': of 4 bytes, of 8. `partner` is the place of
 * the number or bool that a kind of 'bytes' or 'optional ...' has elsewhere.
 */
export class Layouts {
  constructor(schema, numbers) {
    this.schema = schema;
    this.numbers = numbers;
    this.known = new Map();
  }

  /** The codec of a kind: a plain one, an enum, or a struct by its name. */
  of(kind) {
    let codec = this.known.get(kind);
    if (codec === undefined) this.known.set(kind, codec = this.#make(kind));
    return codec;
  }

  #make(kind) {
    if (kind === 'number') return this.numbers.scalar;
    if (kind === 'unit') return this.numbers.unit;
    if (kind === 'vec3') return sequence(this.numbers.scalar, 3);
    if (kind === 'unit_vec3') return sequence(this.numbers.unit, 3);
    if (kind === 'quat') return sequence(this.numbers.unit, 4);
    if (Object.hasOwn(kPlain, kind)) return kPlain[kind];
    if (Object.hasOwn(this.schema.enums, kind)) return enumeration(this.schema.enums[kind]);
    const layout = this.schema.structs[kind];
    if (layout === undefined) throw new Error(`isostep: no layout of ${kind}`);
    return this.#struct(layout);
  }
  #of(place) { return Array.isArray(place) ? place[this.numbers.scalar.size === 4 ? 0 : 1] : place; }

  #member(kind, at, count, partner) {
    if (kind === 'text') return characters(count);
    if (kind === 'bytes') return byteArray(count, this.#of(partner) - at);
    if (kind === 'list') return list(this.#of(partner) - at);
    if (kind.startsWith('optional ')) return optional(this.of(kind.slice(9)), this.#of(partner) - at);
    return count === undefined ? this.of(kind) : sequence(this.of(kind), count);
  }

  #struct({size, fields}) {
    const members = new Map();
    for (const [key, kind, place, count, partner] of fields) {
      const at = this.#of(place);
      members.set(key, {codec: this.#member(kind, at, count, partner), at});
    }
    const all = [...members];
    return {
      size: this.#of(size),
      places: new Map(all.map(([key, {at}]) => [key, at])),  // [bytes] of its members
      read(view, base) {
        const out = {};
        for (const [key, {codec, at}] of all) out[key] = codec.read(view, base + at);
        return out;
      },
      write(view, base, value, field = '') {
        if (value === null || typeof value !== 'object') throw badValue(field, 'an object', value);
        for (const key of Object.keys(value)) {
          if (value[key] === undefined) continue;
          const place = field === '' ? key : `${field}.${key}`;
          const member = members.get(key);
          if (member === undefined) throw badValue(place, `one of ${[...members.keys()].join(', ')}`, 'a name');
          member.codec.write(view, base + member.at, value[key], place);
        }
      }
    };
  }
}
