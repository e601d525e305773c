// Sessions over WebSockets: a browser's own, or the package `ws` in Node, which is also what listens.
// SPDX-License-Identifier: MIT
//
// A message is a byte that names the channel, then the session's bytes. Both channels are one stream of TCP: what is
// lost is sent again, and what comes behind it waits. On lines that lose packets a data channel is better.

import {Arrivals, kCaps, kDatagram} from './channel.js';

const kOpen = 1;               // WebSocket.OPEN
const kFull = 256 << 10;       // [bytes] that wait in the socket: above that a datagram is as good as lost,
const kOverfull = 4 << 20;     // and a connection that does not take what is sent reliably ends
const kTooMany = 1013, kMalformed = 1007;

export class WebSocketTransport {
  /** @param {{maxPeers?: number, WebSocket?: typeof globalThis.WebSocket}} [options] */
  constructor({maxPeers = 64, WebSocket = globalThis.WebSocket} = {}) {
    this.arrivals = new Arrivals(maxPeers);
    this.WebSocket = WebSocket;
  }

  /** Accepts the connections of a `ws` WebSocketServer. */
  static listen(server, options) {
    const transport = new WebSocketTransport(options);
    server.on('connection', socket => transport.attach(socket, true));
    return transport;
  }
  /** Connects to "ws://host:port/..."; in Node before 22 options need the class of `ws`. */
  static connect(address, options) {
    const transport = new WebSocketTransport(options);
    transport.connectTo(address);
    return transport;
  }
  connectTo(address) {
    if (this.WebSocket === undefined) throw new Error('isostep: no WebSocket here: give {WebSocket} of the package ws');
    this.attach(new this.WebSocket(address), false);
  }

  /** A socket of either kind, open or about to. */
  attach(socket, incoming) {
    socket.binaryType = 'arraybuffer';
    const peer = this.arrivals.add(socket);
    if (peer === undefined) return socket.close(kTooMany);
    const isOurs = () => this.arrivals.peers[peer] === socket;
    const opened = () => isOurs() && this.arrivals.connected(peer, incoming);
    if (socket.readyState === kOpen) opened();
    else socket.addEventListener('open', opened);
    socket.addEventListener('message', ({data}) => {
      if (!isOurs()) return;
      const bytes = typeof data === 'string' ? new Uint8Array() : new Uint8Array(data);
      if (bytes.length === 0 || !this.arrivals.message(peer, bytes[0], bytes.subarray(1))) socket.close(kMalformed);
    });
    socket.addEventListener('close', () => isOurs() && this.arrivals.disconnected(peer));
    socket.addEventListener('error', () => {});  // `close` follows, and says all that a session wants to know
  }

  send(peer, channel, bytes) {
    const socket = this.arrivals.peers[peer];
    if (socket?.readyState !== kOpen || bytes.length > kCaps[channel]) return false;
    if (channel === kDatagram && socket.bufferedAmount > kFull) return false;
    if (socket.bufferedAmount > kOverfull) {
      socket.close();
      return false;
    }
    const message = new Uint8Array(1 + bytes.length);
    message[0] = channel;
    message.set(bytes, 1);
    socket.send(message);
    return true;
  }
  receive() { return this.arrivals.receive(); }
  disconnect(peer) {
    const socket = this.arrivals.peers[peer];
    if (socket === undefined) return;
    this.arrivals.forget(peer);
    socket.close();
  }
  close() { this.arrivals.peers.forEach((_, peer) => this.disconnect(peer)); }
}
