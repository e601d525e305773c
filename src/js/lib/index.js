// isostep for JavaScript: load('q32') gives an engine of that scalar, whose worlds and sessions are made by it.
// SPDX-License-Identifier: MIT

import {createHeightField, createHull, createMesh, readBlob} from './blob.js';
import {makeBlock} from './block.js';
import {Calls, given, out} from './calls.js';
import {badValue, IsostepError} from './errors.js';
import {interfaceSchema} from './generated/interface.js';
import {Module, unsigned} from './module.js';
import {SimulatedNetwork} from './network.js';
import {Replay, Tape} from './recordings.js';
import {Session} from './session.js';
import {World} from './world.js';

export {IsostepError} from './errors.js';
export {deliver, dispatch} from './transport/pump.js';
/** By which channel a session's bytes go: they may be lost, or they arrive whole and in order. */
export const Channel = {datagram: 0, reliable: 1};
/** Bits of fields of flags: BodyFlags.lockX | BodyFlags.lockY. */
export const {bodyFlags: BodyFlags, partFlags: PartFlags, jointFlags: JointFlags, zoneEffects: ZoneEffects} = interfaceSchema.flags;

/** The version of the C interface that these files speak. */
const kAbi = interfaceSchema.abi;

/**
 * Starts an engine: 'f32', 'f64', 'q16' or 'q32'. Options: `source`, where the module is, as an address, bytes, a
 * Response or a WebAssembly.Module, else the package's own file; `numbers: 'raw'`, fixed point's integers as BigInt.
 */
export async function load(scalar, {source, numbers = 'si'} = {}) {
  if (numbers !== 'si' && numbers !== 'raw') throw badValue('numbers', '"si" or "raw"', numbers);
  if (numbers === 'raw' && scalar[0] !== 'q') throw badValue('numbers', '"si" for floating scalars', numbers);
  const module = await Module.start(scalar, source);
  const abi = module.call('iso_abi_version');
  if (abi !== kAbi) throw new Error(`isostep: the module's interface has version ${abi}, these files expect ${kAbi}`);
  return new Engine(new Calls(module, scalar, numbers === 'raw'));
}

export class Engine {
  #calls;
  /** Of load(). */
  constructor(calls) { this.#calls = calls; }

  get scalar() { return this.#calls.scalar; }
  /** The release. */
  get version() { return this.#calls.module.text(this.#calls.module.call('iso_version')); }
  /** The version of the results: engines of one behaviour version promise each other's hashes. What lobbies compare. */
  get behaviourVersion() { return unsigned(this.#calls.module.call('iso_behaviour_version')); }
  /** [bytes] of WebAssembly memory, which never shrinks. */
  get memorySize() { return this.#calls.module.exports.memory.buffer.byteLength; }
  /** Plays the built-in recordings and compares their hashes: what a game may ask at start. */
  selfcheck() { return this.#calls.run('selfcheck', out('selfcheck_result')); }

  /** {hz: 60, substeps: 8, gravity: [0, -10, 0], ...}; what is not named has its default. */
  createWorld(settings = {}) {
    return new World(this.#calls, this.#calls.run('P_world_create', given('settings', settings), out('u32')));
  }
  /** A game's own state in the engine's memory: {touches: 'u32', lives: ['i8', 4]}. */
  createState(fields) { return makeBlock(this.#calls.module, fields); }
  createSession(config, game, file) { return Session.create(this.#calls, config, game, file); }
  createNetwork(seed = 1n) { return SimulatedNetwork.create(this.#calls, seed); }

  createHull(points, home) { return createHull(this.#calls, points, home); }
  createMesh(mesh, home) { return createMesh(this.#calls, mesh, home); }
  createHeightField(field, home) { return createHeightField(this.#calls, field, home); }
  readBlob(bytes, home) { return readBlob(this.#calls, bytes, home); }

  createTape() { return new Tape(this.#calls, this.#calls.run('tape_create', out('u32'))); }
  openReplay(bytes) {
    this.#calls.begin();
    const at = this.#calls.placeBytes(bytes, 'bytes');
    return new Replay(this.#calls, this.#calls.runNow('replay_open', at, bytes.byteLength, out('u32')));
  }
  /** What `isostep verify` says of a file. */
  verifyReplay(bytes, {mostFrames = 0xffffffffffffffffn} = {}) {
    this.#calls.begin();
    const at = this.#calls.placeBytes(bytes, 'bytes');
    const simd = this.#calls.number('simd', 'best');
    return this.#calls.runNow('replay_verify', at, bytes.byteLength, simd, BigInt(mostFrames), out('replay_result'));
  }
}
