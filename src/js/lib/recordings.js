// Recordings: whatever a game does to a world, as a file that `isostep verify` plays without the game's code.
// SPDX-License-Identifier: MIT

import {out} from './calls.js';
import {Handle} from './handle.js';
import {unsigned} from './module.js';
import {World} from './world.js';

/** A recording that grows: World.record, then endFrame after the commands and steps of each frame, then finish. */
export class Tape extends Handle {
  #calls;
  constructor(calls, at) {
    super(calls.module, at, 'iso_tape_destroy', 'tape');
    this.#calls = calls;
  }
  endFrame() { this.#calls.run('tape_end_frame', this.at); }
  /** Records the whole state, for seeking; after endFrame, before the next command. */
  keyframe() { this.#calls.run('tape_keyframe', this.at); }
  /** Puts all frames so far into bytes(): a crash costs none that are kept. Else it costs a second. */
  flush() { this.#calls.run('tape_flush', this.at); }
  finish() { this.#calls.run('tape_finish', this.at); }
  /** A copy of the file so far. */
  bytes() { return this.#calls.bytesSeen('tape_bytes', this.at); }
}

/** A recording that is read. */
export class Replay extends Handle {
  #calls;
  constructor(calls, at) {
    super(calls.module, at, 'iso_replay_destroy', 'replay');
    this.#calls = calls;
  }
  get info() { return this.#calls.run('replay_get_info', this.at, out('replay_info')); }
  /** Makes a world in the state before the first frame. */
  createWorld() { return new World(this.#calls, this.#calls.run('replay_create_world', this.at, out('u32'))); }
  /** The frame's {commands, hash}: for World.apply, and the hash after it. */
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
