// A session: which frames a game steps, with whose inputs, and when. No sockets and no clock: times [us] are given.
// SPDX-License-Identifier: MIT

import {badValue} from './errors.js';
import {Handle} from './handle.js';
import {unsigned} from './module.js';

const kStatuses = ['confirmed', 'predicted', 'disconnected'];     // iso_input_status
const kInputSize = 516, kInputBytes = 4;                          // iso_input: the size, the status, then the bytes
const kRefused = -11;

/** The time in microseconds as the C interface has it. */
function time(now) {
  if (!(now >= 0 && now <= Number.MAX_SAFE_INTEGER)) throw badValue('now', 'microseconds since the start', now);
  return BigInt(Math.floor(now));
}

export class Session extends Handle {
  #calls;
  #game;

  /**
   * `config`: {mode: 'rollback', host, players, name, inputCap, seed, ...}, or with `preset: 'fighting'` what suits a
   * genre. `game`: {world, state, step(inputs, frame)} and, if it likes, rolledBack, restarted, confirmed.
   */
  static create(calls, {preset, ...config}, game, file) {
    if (typeof game?.step !== 'function') throw badValue('game', 'an object with step(inputs, frame)', game);
    if (game.world === undefined && game.state === undefined) throw badValue('game', 'a world, a state, both', 'none');
    calls.begin();
    const settings = calls.sized('session_config');
    if (preset !== undefined) {
      calls.call('iso_session_config_preset', settings, calls.number('genre', preset), config.players ?? 2);
    }
    calls.layout('session_config').write(calls.module.view, settings, config, 'config');
    const bytes = file === undefined ? 0 : calls.placeBytes(file, 'file'), out = calls.take(4);
    calls.call('iso_session_create', settings, placeGame(calls, game), bytes, file?.byteLength ?? 0, out);
    return new Session(calls, calls.module.view.getUint32(out, true), game);
  }
  constructor(calls, at, game) {
    super(calls.module, at, 'iso_session_destroy', 'session', [game.world, game.state]);
    this.#calls = calls;
    this.#game = game;
  }

  /** Throws when the session's world or state is gone: the engine would write to memory that is somebody else's. */
  get at() {
    const {world, state} = this.#game;
    world?.at;
    state?.at;
    return super.at;
  }
  #call(name, ...words) { this.#calls.call(name, this.at, ...words); }
  /** Returns true, or false where the session refuses: not now, not yours, or not sound. */
  #try(name, ...words) {
    const status = this.module.call(name, this.at, ...words);
    if (status === kRefused) return false;
    if (status !== 0) this.#calls.fail(name, status);
    return true;
  }
  /** The reason why the last call was refused. */
  get problem() { return this.module.text(this.module.call('iso_last_error')); }

  // ---- a turn

  /**
   * Plays what is due with `game.step`, and tells `rolledBack`, `restarted` and `confirmed` of it. Returns how many
   * frames were stepped, those again included. Without inputs of its own since the last turn a player repeats the last.
   * An error that the game throws ends the turn: the next one tells 'misuse', steps again what was missed, from the
   * newest final state, and the match goes on.
   */
  drive(now) {
    this.#call('iso_session_advance', time(now));
    const layout = this.#calls.layout('request');
    for (let steps = 0;;) {
      this.#calls.begin();
      const at = this.#calls.sized('request');
      this.#call('iso_session_next', at);
      const {kind, frame, hash} = layout.read(this.module.view, at);
      if (kind === 'nothing') return steps;
      if (kind === 'step') {
        this.#game.step(this.#inputs(), frame);
        ++steps;
      } else if (kind === 'rolled_back') {
        this.#game.rolledBack?.(frame);
      } else if (kind === 'restarted') {
        this.#game.restarted?.(frame);
      } else {
        this.#game.confirmed?.(frame, hash);
      }
    }
  }
  #inputs() {
    const room = this.#calls.take(4);
    const first = this.module.call('iso_session_inputs', this.at, room);
    const players = this.module.view.getUint32(room, true);
    return Array.from({length: players}, (_, player) => this.#input(first + player * kInputSize));
  }
  /** A copy of an input: the memory may grow in the step. */
  #input(at) {
    const size = this.module.view.getUint16(at, true);
    return {bytes: this.module.bytes(at + kInputBytes, size).slice(),
            status: kStatuses[this.module.view.getUint8(at + 2)]};
  }

  /** Gives the next frame's input; until that is stepped a later one replaces it. False: not our player, or not now. */
  addLocalInput(player, bytes) {
    this.#calls.begin();
    return this.#try('iso_session_add_local_input', player, this.#calls.placeBytes(bytes, 'bytes'), bytes.byteLength);
  }
  /** True when the last input has been taken: a game of orders hands over the next only then. */
  wantsInput(player) { return this.module.call('iso_session_wants_input', this.at, player) !== 0; }
  /** [us] The time until the next frame is due. */
  wait(now) { return Number(unsigned(this.module.call('iso_session_wait', this.at, time(now)))); }

  // ---- the transport's side

  connected(peer, now, incoming = false) {
    this.#call('iso_session_connected', peer, time(now), incoming ? 1 : 0);
  }
  disconnected(peer, now) { this.#call('iso_session_disconnected', peer, time(now)); }
  /** Takes a message. `channel` 0 is a datagram, 1 a reliable message. */
  receive(peer, channel, bytes, now) {
    this.#calls.begin();
    const at = this.#calls.placeBytes(bytes, 'bytes');
    this.#call('iso_session_receive', peer, channel, at, bytes.byteLength, time(now));
  }
  /** The next message to be sent: {peer, channel, bytes, close}, or null. `bytes` is a view until the next call. */
  pollSend(now) {
    this.#calls.begin();
    const at = this.#calls.sized('outgoing'), pointer = this.#calls.take(4);
    this.#call('iso_session_poll_send', time(now), at, pointer);
    const bytes = this.module.view.getUint32(pointer, true);
    if (bytes === 0) return null;
    const {peer, channel, length, close} = this.#calls.layout('outgoing').read(this.module.view, at);
    return {peer, channel: this.#calls.number('channel', channel), bytes: this.module.bytes(bytes, length), close};
  }
  /** The address that the transport is to connect to, or null. */
  pollConnect() {
    this.#calls.begin();
    const room = this.#calls.take(4);
    this.#call('iso_session_poll_connect', room);
    const at = this.module.view.getUint32(room, true);
    return at === 0 ? null : this.module.text(at);
  }

  // ---- what happens

  /** The next event {kind: 'joined', player, frame, ...}, or null. */
  pollEvent() {
    this.#calls.begin();
    const at = this.#calls.sized('session_event');
    this.#call('iso_session_poll_event', at);
    const event = this.#calls.layout('session_event').read(this.module.view, at);
    return event.kind === 'none' ? null : event;
  }
  get phase() { return this.#calls.enumerator('phase', this.module.call('iso_session_phase', this.at)); }
  /** The next frame to be stepped. */
  get current() { return this.module.call('iso_session_current', this.at); }
  /** The last frame whose state is final. */
  get confirmed() { return this.module.call('iso_session_confirmed', this.at); }
  /** The first player of this machine; -1: none yet. */
  get localPlayer() { return this.module.call('iso_session_local_player', this.at); }
  /** All players of this machine, a bit each. */
  get localPlayers() { return this.module.call('iso_session_local_players', this.at) >>> 0; }
  /** The setting `token`, which says who we are after a crash. 0n: not seated yet. */
  get token() { return unsigned(this.module.call('iso_session_token', this.at)); }
  /** The input of a player in a frame that is at most `kept` frames old. */
  input(frame, player) {
    this.#calls.begin();
    const at = this.#calls.take(kInputSize);
    this.#calls.call('iso_session_input', this.at, frame, player, at);
    return this.#input(at);
  }
  get stats() { return this.#read('session_stats', 'iso_session_get_stats'); }
  playerStats(player) { return this.#read('player_stats', 'iso_session_get_player_stats', player); }
  #read(layout, name, ...words) {
    this.#calls.begin();
    const at = this.#calls.sized(layout);
    this.#calls.call(name, this.at, ...words, at);
    return this.#calls.layout(layout).read(this.module.view, at);
  }
  /** [bytes] The progress of the snapshot that a client waits for, or that a host sends to `peer`. */
  snapshotProgress(peer = 0) {
    this.#calls.begin();
    const at = this.#calls.take(8);
    this.#calls.call('iso_session_snapshot_progress', this.at, peer, at, at + 4);
    return {arrived: this.module.view.getUint32(at, true), size: this.module.view.getUint32(at + 4, true)};
  }

  // ---- decisions: false where they are refused

  start(now) { return this.#try('iso_session_start', time(now)); }
  resync() { return this.#try('iso_session_resync'); }
  /**
   * Goes on with those who are here, at this machine. It is for sessions with `migration` whose match stands for lack
   * of a majority, or whose host is lost. The caller knows that the others play nowhere else: nothing else keeps one
   * match from becoming two.
   */
  goOn(now) { return this.#try('iso_session_go_on', time(now)); }
  pause() { return this.#try('iso_session_pause'); }
  unpause() { return this.#try('iso_session_unpause'); }
  /** Sets the speed [1/8 of the match's rate], 4 to 16. */
  setSpeed(eighths) { return this.#try('iso_session_set_speed', eighths); }
  propose(player, proposal, subject = 0) {
    return this.#try('iso_session_propose', player, this.#calls.number('proposal', proposal), subject);
  }
  vote(player, yes) { return this.#try('iso_session_vote', player, yes ? 1 : 0); }

  /** The applicant who waits for an answer, or null; for a host with asksAdmission. */
  pollApplicant() {
    const applicant = this.#read('applicant', 'iso_session_poll_applicant');
    return applicant.id === 0n ? null : applicant;
  }
  admit(applicant) { return this.#try('iso_session_admit', applicant); }
  refuse(applicant, reason) { return this.#withReason('iso_session_refuse', applicant, reason); }
  kick(player, reason) { return this.#withReason('iso_session_kick', player, reason); }
  kickPeer(peer, reason) { return this.#withReason('iso_session_kick_peer', peer, reason); }
  #withReason(name, whom, reason) {
    this.#calls.begin();
    return this.#try(name, whom, this.#calls.placeText(reason, 'reason'));
  }
  /** The peer that has the seat; -1: nobody. For a host. */
  peerOf(player) { return this.module.call('iso_session_peer_of', this.at, player); }

  // ---- recordings

  /** Returns the match in its newest final state, for `file` of another process. For a host. */
  saveMatch() { return this.#calls.bytesOut('iso_session_save_match', this.at); }
  /** Records from the next frame on: the game plays 'match' again, `isostep verify` plays 'world' without it. */
  record(kind, scene = null) {
    this.#calls.begin();
    const text = scene === null ? 0 : this.#calls.placeText(scene, 'scene');
    return this.#try('iso_session_record', this.#calls.number('recording', kind), text);
  }
  /** The file's new bytes since the last such call, with all final frames: appended, they survive a crash. */
  flushRecording(kind) {
    return this.#calls.bytesSeen('session_flush_recording', this.at, this.#calls.number('recording', kind));
  }
  /** Ends the recording with the last confirmed frame; returns the file. */
  recorded(kind) {
    return this.#calls.bytesOut('iso_session_recorded', this.at, this.#calls.number('recording', kind));
  }
}

/** Places world and state for the session; the game's deeds are asked for, never called back from within. */
function placeGame(calls, {world, state}) {
  return calls.place('game', {
    ...(world !== undefined && {world: world.at}),
    ...(state !== undefined && {block: state.at, blockSize: state.byteLength})
  }, 'game');
}
