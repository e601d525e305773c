// Sessions over WebRTC data channels: a browser's own, or the package `node-datachannel` in Node.
// SPDX-License-Identifier: MIT
//
// Each of a session's channels is a data channel of its own: datagrams unordered and never sent again, so that a lost
// one delays nobody. Both sides open them by number, without a word about it. How two machines find each other is
// signalling, which is the game's: connectBySocket() does it over any WebSocket between the two.

import {Arrivals, kCaps, kDatagram, kReliable} from './channel.js';

const kFull = 64 << 10;     // [bytes] that wait: above that a datagram is as good as lost,
const kOverfull = 4 << 20;  // and a connection that does not take what is sent reliably ends

export class DataChannelTransport {
  /** @param {{maxPeers?: number}} [options] */
  constructor({maxPeers = 64} = {}) { this.arrivals = new Arrivals(maxPeers); }

  /** Attaches an RTCPeerConnection, on both sides before the offer or answer. `incoming`: the other side asked. */
  attach(connection, incoming) {
    const open = (label, id, options) => connection.createDataChannel(label, {negotiated: true, id, ...options});
    const channels = [open('isostep datagrams', kDatagram, {ordered: false, maxRetransmits: 0}),
                      open('isostep messages', kReliable, {ordered: true})];
    const link = {connection, channels};
    const peer = this.arrivals.add(link);
    if (peer === undefined) return connection.close();
    const isOurs = () => this.arrivals.peers[peer] === link;
    let waiting = channels.length, over = false;
    const end = () => {
      if (over || !isOurs()) return;
      over = true;
      this.arrivals.disconnected(peer);
    };
    channels.forEach((channel, number) => {
      channel.binaryType = 'arraybuffer';
      channel.addEventListener('open', () => --waiting === 0 && isOurs() && this.arrivals.connected(peer, incoming));
      channel.addEventListener('message', ({data}) => {
        if (over || waiting > 0 || !isOurs() || typeof data === 'string') return;
        if (!this.arrivals.message(peer, number, new Uint8Array(data))) connection.close();
      });
      channel.addEventListener('close', end);
    });
    connection.addEventListener('connectionstatechange', () => {
      if (connection.connectionState === 'failed' || connection.connectionState === 'closed') end();
    });
  }

  send(peer, channel, bytes) {
    const link = this.arrivals.peers[peer];
    const line = link?.channels[channel];
    if (line?.readyState !== 'open' || bytes.length > kCaps[channel]) return false;
    if (channel === kDatagram && line.bufferedAmount > kFull) return false;
    if (line.bufferedAmount > kOverfull) {
      link.connection.close();
      return false;
    }
    line.send(bytes.slice());  // not a view of memory that the engine goes on to use
    return true;
  }
  receive() { return this.arrivals.receive(); }
  disconnect(peer) {
    const link = this.arrivals.peers[peer];
    if (link === undefined) return;
    this.arrivals.forget(peer);
    link.connection.close();
  }
  close() { this.arrivals.peers.forEach((_, peer) => this.disconnect(peer)); }
}

/** Exchanges offer, answer and candidates as JSON over an open WebSocket. `offers` is set on one side of the two. */
export async function connectBySocket(connection, socket, offers) {
  const say = message => socket.send(JSON.stringify(message));
  connection.addEventListener('icecandidate', ({candidate}) => candidate && say({candidate}));
  const early = [];
  socket.addEventListener('message', async ({data}) => {
    const {description, candidate} = JSON.parse(data);
    if (description) {
      await connection.setRemoteDescription(description);
      for (const one of early.splice(0)) await connection.addIceCandidate(one);
      if (description.type === 'offer') {
        await connection.setLocalDescription(await connection.createAnswer());
        say({description: connection.localDescription});
      }
    } else if (connection.remoteDescription) {
      await connection.addIceCandidate(candidate);
    } else {
      early.push(candidate);
    }
  });
  if (!offers) return;
  await connection.setLocalDescription(await connection.createOffer());
  say({description: connection.localDescription});
}
