// Copies of the engine's arrays: poses, and the reports of a step.
// SPDX-License-Identifier: MIT

/**
 * Records as they were when they were asked for: they outlive the world. Iterating, or at(i), makes objects of them;
 * `numbers` and `ids` are all of them as typed arrays: of record i, the word w is at [i * stride + w].
 */
export class Records {
  #codec;
  #bytes;
  #array;
  #numbers;
  #ids;

  constructor(module, codec, at, length, array) {
    this.#codec = codec;
    this.#bytes = module.bytes(at, length * codec.size).slice().buffer;
    this.#array = array;
    this.length = length;
  }

  /** The words of `numbers` from a record to the next. */
  get stride() { return this.#codec.size / this.#array.BYTES_PER_ELEMENT; }
  get numbers() { return this.#numbers ??= new this.#array(this.#bytes); }
  /** The words of `ids` from a record to the next. */
  get idStride() { return this.#codec.size / 8; }
  get ids() { return this.#ids ??= new BigUint64Array(this.#bytes); }

  at(i) {
    if (!(Number.isInteger(i) && i >= 0 && i < this.length)) return undefined;
    return this.#codec.read(new DataView(this.#bytes), i * this.#codec.size);
  }
  *[Symbol.iterator]() {
    for (let i = 0; i < this.length; ++i) yield this.at(i);
  }
}
