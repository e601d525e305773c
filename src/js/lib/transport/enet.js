// From Node to isostep's native hosts: their UDP transport's clients, each with a socket of its own.
// SPDX-License-Identifier: MIT
//
// Not secret: who can forge what is told at src/transport/README.md. IPv4 alone, as the native side.

import {randomBytes, randomInt} from 'node:crypto';
import {createSocket} from 'node:dgram';

import {Arrivals} from './channel.js';
import {EnetLink} from './enet_link.js';
import {LineGuard} from './line_guard.js';

const kTend = 10;  // [ms] between looks at what is to be sent again

export class EnetTransport {
  /**
   * @param {{maxPeers?: number, timeout?: number, key?: Uint8Array}} [options] timeout: [ms] without a word until a
   * peer is gone; key: the host's EnetSettings::key, 16 bytes
   */
  constructor({maxPeers = 64, timeout = 10000, key = new Uint8Array(16)} = {}) {
    if (key.length !== 16) throw new Error(`isostep: a key of ${key.length} bytes: a host's has 16`);
    this.arrivals = new Arrivals(maxPeers);
    this.timeout = timeout;
    this.key = key;
  }
  /** Connects to a host at "192.0.2.7:4000". */
  static connect(address, options) {
    const transport = new EnetTransport(options);
    transport.connectTo(address);
    return transport;
  }

  /** Adds a connection; returns its peer's number, or undefined when there are too many. */
  connectTo(address) {
    const [, host, port] = /^(.+):(\d+)$/.exec(address) ?? [];
    if (host === undefined || Number(port) < 1 || Number(port) > 65535) {
      throw new Error(`isostep: "${address}": an address is like 192.0.2.7:4000`);
    }
    const socket = createSocket('udp4');
    const entry = {socket};
    const peer = this.arrivals.add(entry);
    if (peer === undefined) return void socket.close();
    const isOurs = () => this.arrivals.peers[peer] === entry;
    entry.guard = new LineGuard(bytes => entry.open && socket.send(bytes),
      packet => entry.link.receive(packet, Math.round(performance.now())), {key: this.key, nonce: randomBytes(8)});
    entry.link = new EnetLink(packet => entry.guard.send(packet), {
      connected: () => isOurs() && this.arrivals.connected(peer, false),
      message: (channel, bytes) => isOurs() && this.arrivals.message(peer, channel, bytes),
      disconnected: () => isOurs() && this.arrivals.disconnected(peer)
    }, {timeout: this.timeout, connectId: randomInt(2 ** 32)});
    socket.on('error', () => {});  // nobody listens there: silence, which the link's timeout is for
    socket.on('message', bytes => entry.guard.receive(bytes));
    socket.connect(Number(port), host, error => {
      entry.open = !error;
      entry.link.connect(Math.round(performance.now()));
    });
    this.#tend(entry);
    return peer;
  }
  #tend(entry) {
    const timer = setInterval(() => {
      entry.link.tend(Math.round(performance.now()));
      if (entry.link.state !== 'over') return;
      clearInterval(timer);
      entry.open = false;
      entry.socket.close();
    }, kTend);
  }

  send(peer, channel, bytes) {
    const entry = this.arrivals.peers[peer];
    if (entry === undefined || !entry.link.send(channel, bytes, Math.round(performance.now()))) return false;
    if (!entry.flushing) {  // with whatever else is sent in this turn
      entry.flushing = true;
      setImmediate(() => {
        entry.flushing = false;
        entry.link.flush(Math.round(performance.now()));
      });
    }
    return true;
  }
  receive() { return this.arrivals.receive(); }
  disconnect(peer) {
    const entry = this.arrivals.peers[peer];
    if (entry === undefined) return;
    this.arrivals.forget(peer);
    entry.link.disconnect(Math.round(performance.now()));
  }
  close() { this.arrivals.peers.forEach((_, peer) => this.disconnect(peer)); }
}
