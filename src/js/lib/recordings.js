// Recordings: whatever a game does to a world, as a file that `isostep verify` plays without the game's code.
// SPDX-License-Identifier: MIT

import {out} from './calls.js';
import {Handle} from './handle.js';
import {unsigned} from './module.js';
import {World} from './world.js';

/** One that grows: World.record, then endFrame after the commands and steps of each frame, then finish. */
export class Tape extends Handle {
  #calls;
  constructor(calls, at) {
    super(calls.module, at, 'iso_tape_destroy', 'tape');
    this.#calls = calls;
  }
  endFrame() { this.#calls.run('tape_end_frame', this.at); }
  /** The whole state, for seeking; after endFrame, before the next command. */
  keyframe() { this.#calls.run('tape_keyframe', this.at); }
  finish() { this.#calls.run('tape_finish', this.at); }
  /** A copy of what there is of the file. */
  bytes() {
    this.#calls.begin();
    const pointer = this.#calls.take(4), size = this.#calls.take(4);
    this.#calls.runNow('tape_bytes', this.at, pointer, size);
    const {view} = this.module;
    return this.module.bytes(view.getUint32(pointer, true), view.getUint32(size, true)).slice();
  }
}

/** One that is read. */
export class Replay extends Handle {
  #calls;
  constructor(calls, at) {
    super(calls.module, at, 'iso_replay_destroy', 'replay');
    this.#calls = calls;
  }
  get info() { return this.#calls.run('replay_get_info', this.at, out('replay_info')); }
  /** In the state before the first frame. */
  createWorld() { return new World(this.#calls, this.#calls.run('replay_create_world', this.at, out('u32'))); }
  /** {commands, hash}: for World.apply, and the hash after it. */
  frame(number) {
    this.#calls.begin();
    const [pointer, size, hash] = [4, 4, 8].map(bytes => this.#calls.take(bytes));
    this.#calls.runNow('replay_get_frame', this.at, BigInt(number), pointer, size, hash);
    const {view} = this.module;
    return {
      commands: this.module.bytes(view.getUint32(pointer, true), view.getUint32(size, true)).slice(),
      hash: unsigned(view.getBigInt64(hash, true))
    };
  }
}
