// One connection of ENet's protocol, as much of it as isostep's native transport speaks: no sockets, no clock.
// SPDX-License-Identifier: MIT
//
// Source: ENet 1.3.17, protocol.h: record layouts and command numbers, big-endian. The native side is
// src/transport/enet_transport.cpp: datagrams are unsequenced messages of channel 0, reliable messages are those of
// channel 1, in fragments where they are larger than a packet; no compression, no checksum, no sequenced unreliables.

import {kCaps, kDatagram, kReliable} from './channel.js';

const kMtu = 1224, kMostCommands = 32, kControl = 0xff, kNobody = 0xfff;
const kAcknowledge = 1, kConnect = 2, kVerify = 3, kDisconnect = 4, kPing = 5, kSendReliable = 6, kSendFragment = 8,
  kSendUnsequenced = 9;
const kSizes = [0, 8, 48, 44, 8, 4, 6, 0, 24, 8, 12, 16, 0];  // [bytes] of each command
const kAsksAcknowledgement = 0x80, kUnsequenced = 0x40, kHasTime = 0x8000;
const kPiece = kMtu - 4 - 4 - kSizes[kSendFragment];  // as if a checksum were there
const kInFlight = 32 << 10;    // [bytes] sent reliably and not acknowledged yet; half of ENet's window
const kWaiting = 4 << 20;      // [bytes] above that the connection ends
const kSoonest = 100;          // [ms] before something is sent again
const kPingAfter = 500;        // [ms] of silence
const kAhead = 4096;           // reliable messages that may come before one that is missing

export class EnetLink {
  /** `put(bytes)` sends a packet; `on`: {connected(), message(channel, bytes), disconnected()}; times are in ms. */
  constructor(put, on, {timeout = 10000, connectId = 1} = {}) {
    Object.assign(this, {put, on, timeout, connectId: connectId >>> 0});
    this.state = 'connecting';
    this.peerThere = kNobody;
    this.sessionThere = 0;
    this.numbers = {[kReliable]: 0, [kControl]: 0};  // of the last command sent on each channel
    this.group = 0;
    this.unacknowledged = [];  // {channel, number, bytes, sent, tries}, in their order
    this.waiting = [];         // reliable commands that the window has no room for
    this.waitingBytes = 0;
    this.outgoing = [];        // commands of the next packets
    this.expected = 1;         // reliable message of channel 1
    this.early = new Map();    // those that came before it
    this.pieces = [];
    this.roundTrip = 250;      // [ms]
    this.heard = 0;
  }

  // ---- sending

  connect(now) {
    this.heard = now;
    const command = this.#command(kConnect | kAsksAcknowledgement, kControl);
    const view = new DataView(command.buffer);
    view.setUint16(4, 0);
    command[6] = command[7] = 0xff;  // sessions: none yet
    // MTU, window, channels, bandwidths: none said, throttle: as the native side has it, identity, data.
    [kMtu, 65536, 2, 0, 0, 5000, 32, 0, this.connectId, 0].forEach((word, i) => view.setUint32(8 + 4 * i, word));
    this.#reliably(command, kControl, now);
    this.flush(now);
  }
  /** Sends a message. Returns false when not connected, or when it is too long or too much waits. */
  send(channel, bytes, now) {
    if (this.state !== 'connected' || bytes.length > kCaps[channel]) return false;
    if (channel === kDatagram) {
      this.outgoing.push(this.#unsequenced(bytes));
    } else if (this.waitingBytes > kWaiting) {
      this.#end(now);
      return false;
    } else if (bytes.length <= kPiece) {
      const command = this.#command(kSendReliable | kAsksAcknowledgement, kReliable, bytes);
      new DataView(command.buffer).setUint16(4, bytes.length);
      this.#reliably(command, kReliable, now);
    } else {
      this.#sendPieces(bytes, now);
    }
    return true;
  }
  disconnect(now) {
    if (this.state !== 'connected') {
      this.state = 'over';
      return;
    }
    this.state = 'closing';
    this.#reliably(this.#command(kDisconnect | kAsksAcknowledgement, kControl), kControl, now);
    this.flush(now);
  }

  #command(number, channel, payload = []) {
    const size = kSizes[number & 0xf];
    const command = new Uint8Array(size + payload.length);
    command[0] = number;
    command[1] = channel;
    command.set(payload, size);
    return command;
  }
  #unsequenced(bytes) {
    const command = this.#command(kSendUnsequenced | kUnsequenced, kDatagram, bytes);
    const view = new DataView(command.buffer);
    this.group = (this.group + 1) & 0xffff;
    view.setUint16(4, this.group);
    view.setUint16(6, bytes.length);
    return command;
  }
  #sendPieces(bytes, now) {
    const count = Math.ceil(bytes.length / kPiece), first = (this.numbers[kReliable] + 1) & 0xffff;
    for (let i = 0; i < count; ++i) {
      const piece = bytes.subarray(i * kPiece, (i + 1) * kPiece);
      const command = this.#command(kSendFragment | kAsksAcknowledgement, kReliable, piece);
      const view = new DataView(command.buffer);
      view.setUint16(4, first);
      view.setUint16(6, piece.length);
      [count, i, bytes.length, i * kPiece].forEach((word, at) => view.setUint32(8 + 4 * at, word));
      this.#reliably(command, kReliable, now);
    }
  }
  #reliably(command, channel, now) {
    const number = this.numbers[channel] = (this.numbers[channel] + 1) & 0xffff;
    new DataView(command.buffer).setUint16(2, number);
    this.waiting.push({channel, number, bytes: command, sent: now, tries: 0});
    this.waitingBytes += command.length;
  }

  /** Puts waiting commands into packets and sends them. */
  flush(now) {
    let inFlight = this.unacknowledged.reduce((sum, {bytes}) => sum + bytes.length, 0);
    while (this.waiting.length > 0 && inFlight < kInFlight) {
      const one = this.waiting.shift();
      Object.assign(one, {sent: now, tries: 1});
      this.unacknowledged.push(one);
      this.outgoing.push(one.bytes);
      inFlight += one.bytes.length;
    }
    while (this.outgoing.length > 0) this.put(this.#packet(now));
  }
  #packet(now) {
    const packet = new Uint8Array(kMtu);
    const view = new DataView(packet.buffer);
    const session = this.peerThere === kNobody ? 0 : (this.sessionThere & 3) << 12;
    view.setUint16(0, this.peerThere | session | kHasTime);
    view.setUint16(2, now & 0xffff);
    let end = 4;
    for (let i = 0; i < kMostCommands && this.outgoing.length > 0; ++i) {
      if (end + this.outgoing[0].length > kMtu) break;
      const command = this.outgoing.shift();
      packet.set(command, end);
      end += command.length;
    }
    return packet.subarray(0, end);
  }

  /** Does what is due by itself; call it every few milliseconds. */
  tend(now) {
    if (this.state === 'over') return;
    if (now - this.heard > this.timeout) return this.#end(now);
    for (const one of this.unacknowledged) {
      if (now - one.sent < Math.max(kSoonest, 2 * this.roundTrip) * 2 ** Math.min(one.tries - 1, 4)) continue;
      Object.assign(one, {sent: now, tries: one.tries + 1});
      this.outgoing.push(one.bytes);
    }
    if (this.state === 'connected' && this.unacknowledged.length === 0 && now - this.heard > kPingAfter) {
      this.#reliably(this.#command(kPing | kAsksAcknowledgement, kControl), kControl, now);
    }
    this.flush(now);
  }
  #end() {
    const told = this.state !== 'closing' && this.state !== 'over';
    this.state = 'over';
    if (told) this.on.disconnected();
  }

  // ---- receiving

  /** Receives a packet from the other side. A malformed command ends its reading, and loses nothing before it. */
  receive(packet, now) {
    if (this.state === 'over' || packet.length < 4) return;
    const view = new DataView(packet.buffer, packet.byteOffset, packet.length);
    const hasTime = (view.getUint16(0) & kHasTime) !== 0;
    const time = hasTime ? view.getUint16(2) : 0;
    this.heard = now;
    for (let at = hasTime ? 4 : 2; at + 4 <= packet.length && this.state !== 'over';) {
      const number = packet[at] & 0xf, size = kSizes[number] ?? 0;
      if (size === 0 || at + size > packet.length) break;
      const length = number === kSendReliable ? view.getUint16(at + 4)
        : number === kSendFragment || number === kSendUnsequenced ? view.getUint16(at + 6) : 0;
      if (at + size + length > packet.length) break;
      const payload = packet.subarray(at + size, at + size + length);
      if ((packet[at] & kAsksAcknowledgement) !== 0) this.#acknowledge(packet[at + 1], view.getUint16(at + 2), time);
      this.#handle(number, packet[at + 1], new DataView(view.buffer, view.byteOffset + at, size), payload, now);
      at += size + length;
    }
    this.flush(now);
  }
  #acknowledge(channel, number, time) {
    const command = this.#command(kAcknowledge, channel);
    const view = new DataView(command.buffer);
    view.setUint16(2, number);
    view.setUint16(4, number);
    view.setUint16(6, time);
    this.outgoing.push(command);
  }
  #handle(number, channel, command, payload, now) {
    if (number === kAcknowledge) this.#acknowledged(channel, command.getUint16(4), now);
    if (number === kVerify) this.#verified(command);
    if (number === kDisconnect) {
      this.flush(now);
      this.#end();
    }
    if (this.state !== 'connected') return;
    if (number === kSendUnsequenced) this.on.message(kDatagram, payload.slice());
    if ((number === kSendReliable || number === kSendFragment) && channel === kReliable) {
      this.#inOrder(command, number === kSendFragment, payload);
    }
  }
  #acknowledged(channel, number, now) {
    const i = this.unacknowledged.findIndex(one => one.channel === channel && one.number === number);
    if (i < 0) return;
    const [one] = this.unacknowledged.splice(i, 1);
    this.waitingBytes -= one.bytes.length;
    if (one.tries === 1) this.roundTrip += (now - one.sent - this.roundTrip) / 8;
    if (this.state === 'closing' && (one.bytes[0] & 0xf) === kDisconnect) this.state = 'over';
  }
  #verified(command) {
    const isOurs = command.getUint32(40) === this.connectId && command.getUint32(8) === kMtu;
    if (this.state !== 'connecting' || !isOurs) return;
    this.peerThere = command.getUint16(4);
    this.sessionThere = command.getUint8(7);
    this.unacknowledged = [];  // who verifies has the request
    this.waitingBytes = 0;
    this.state = 'connected';
    this.on.connected();
  }
  /** Puts reliable messages, and the fragments of large ones, in the order of their numbers. */
  #inOrder(command, isPiece, payload) {
    const number = command.getUint16(2), ahead = (number - this.expected) & 0xffff;
    if (ahead > kAhead || this.early.has(number)) return;  // one that is behind looks as if it were far ahead
    const last = !isPiece || command.getUint32(12) + 1 === command.getUint32(8);
    this.early.set(number, {last, bytes: payload.slice()});
    for (let next; (next = this.early.get(this.expected)) !== undefined;) {
      this.early.delete(this.expected);
      this.expected = (this.expected + 1) & 0xffff;
      this.pieces.push(next.bytes);
      if (this.pieces.length > Math.ceil(kCaps[kReliable] / kPiece)) return this.#end();
      if (!next.last) continue;
      const whole = this.pieces.length === 1 ? next.bytes : Uint8Array.from(this.pieces.flatMap(piece => [...piece]));
      this.pieces = [];
      this.on.message(kReliable, whole);
    }
  }
}
