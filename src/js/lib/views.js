// Arrays of the engine's as views, without a copy: poses, and what a step reports.
// SPDX-License-Identifier: MIT

/**
 * Records that lie in the engine's memory, until the next call that changes their world. Iterating, or at(i), makes
 * objects of them; `numbers` and `ids` are the memory itself as typed arrays: of record i, the word w is at
 * [i * stride + w]. They are made anew when the memory has grown, so take them where they are used.
 */
export class Records {
  #module;
  #codec;
  #at;
  #array;
  #made = {};

  constructor(module, codec, at, length, array) {
    this.#module = module;
    this.#codec = codec;
    this.#at = at;
    this.#array = array;
    this.length = length;
  }

  /** Words of `numbers` from a record to the next. */
  get stride() { return this.#codec.size / this.#array.BYTES_PER_ELEMENT; }
  get numbers() { return this.#view(this.#array); }
  /** Words of `ids` from a record to the next. */
  get idStride() { return this.#codec.size / 8; }
  get ids() { return this.#view(BigUint64Array); }
  #view(array) {
    const {buffer} = this.#module.exports.memory;
    let view = this.#made[array.name];
    if (view === undefined || view.buffer !== buffer) {
      view = this.#made[array.name] =
        new array(buffer, this.#at, this.length * this.#codec.size / array.BYTES_PER_ELEMENT);
    }
    return view;
  }

  at(i) {
    if (!(Number.isInteger(i) && i >= 0 && i < this.length)) return undefined;
    return this.#codec.read(this.#module.view, this.#at + i * this.#codec.size);
  }
  *[Symbol.iterator]() {
    for (let i = 0; i < this.length; ++i) yield this.at(i);
  }
}
