// The numbers of each scalar in memory, and their way to JavaScript's and back.
// SPDX-License-Identifier: MIT
//
// A Number becomes the nearest number of the format, ties away from zero, as iso_<P>_from_double has it; outside of the
// range it is an error and never the nearest end. A BigInt is the raw integer of a fixed-point format. What is read is
// a Number, exact but for the last bits of a Q32.32 beyond 2^53 raw units, or with `raw` the integer itself.

import {badValue} from './errors.js';

function integerOf(value, field, bits) {
  const limit = 1n << BigInt(bits - 1);
  if (value < -limit || value >= limit) throw badValue(field, `raw integers of ${bits} bits`, value);
  return value;
}

/** Scales by a power of two, which is exact, and rounds to the nearest integer. */
function scaled(value, field, fraction, bits) {
  if (typeof value !== 'number' || Number.isNaN(value)) throw badValue(field, 'a number', value);
  const exact = value * 2 ** fraction;
  const size = Math.abs(exact);
  const whole = Math.floor(size);
  const nearest = size - whole >= 0.5 ? whole + 1 : whole;
  const limit = 2 ** (bits - 1);
  if (nearest > limit || (nearest === limit && exact > 0)) {
    const most = 2 ** (bits - 1 - fraction);
    throw badValue(field, `${-most} to below ${most}`, value);
  }
  return exact < 0 ? -nearest : nearest;
}

/** A codec: `word` is the number as an argument of a call; `write` and `read` are in memory. */
function floating(size, get, set) {
  const word = (value, field) => {
    if (typeof value !== 'number') throw badValue(field, 'a number', value);
    return value;
  };
  return {
    size, word,
    read: (view, at) => view[get](at, true),
    write: (view, at, value, field) => view[set](at, word(value, field), true)
  };
}
function fixed32(fraction, raw) {
  const word = (value, field) =>
    typeof value === 'bigint' ? Number(integerOf(value, field, 32)) : scaled(value, field, fraction, 32);
  return {
    size: 4, word,
    read: raw ? (view, at) => BigInt(view.getInt32(at, true)) : (view, at) => view.getInt32(at, true) / 2 ** fraction,
    write: (view, at, value, field) => view.setInt32(at, word(value, field), true)
  };
}
function fixed64(fraction, raw) {
  const word = (value, field) =>
    typeof value === 'bigint' ? integerOf(value, field, 64) : BigInt(scaled(value, field, fraction, 64));
  return {
    size: 8, word,
    read: raw ? (view, at) => view.getBigInt64(at, true)
              : (view, at) => Number(view.getBigInt64(at, true)) / 2 ** fraction,
    write: (view, at, value, field) => view.setBigInt64(at, word(value, field), true)
  };
}

const kFloat = floating(4, 'getFloat32', 'setFloat32');
const kDouble = floating(8, 'getFloat64', 'setFloat64');

/** The numbers of a scalar, its units (directions and quaternions), and the typed array that shows them raw. */
export function numbersOf(scalar, raw) {
  switch (scalar) {
    case 'f32': return {scalar: kFloat, unit: kFloat, array: Float32Array};
    case 'f64': return {scalar: kDouble, unit: kDouble, array: Float64Array};
    case 'q16': return {scalar: fixed32(16, raw), unit: fixed32(30, raw), array: Int32Array};
    case 'q32': return {scalar: fixed64(32, raw), unit: fixed64(62, raw), array: BigInt64Array};
    default: throw badValue('scalar', 'f32, f64, q16 or q32', scalar);
  }
}
