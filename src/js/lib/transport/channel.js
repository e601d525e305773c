// Channels, their caps, and arrivals: every transport from session to session speaks of these.
// SPDX-License-Identifier: MIT
//
// An endpoint has send(peer, channel, bytes), receive() and disconnect(peer). After `connected` come messages, after
// `disconnected` nothing more until the peer's number is connected again. What a session sends may be lost on the
// channel of datagrams, and arrives whole and in order on the reliable one, or the connection ends.

export const kDatagram = 0, kReliable = 1;
/** [bytes] The caps of one message, by channel: those of isostep/session/timeline/frame.hpp. */
export const kCaps = [1180, 16384];

/** Peers by their numbers, the lowest free one first, and the arrivals from them. */
export class Arrivals {
  constructor(maxPeers) {
    this.maxPeers = maxPeers;
    this.peers = [];
    this.inbox = [];
    this.notify = () => {};  // called when something has arrived
  }

  /** The number of a new peer, or undefined when there are too many. */
  add(link) {
    let peer = this.peers.findIndex(one => one === undefined);
    if (peer < 0) peer = this.peers.length;
    if (peer >= this.maxPeers) return undefined;
    this.peers[peer] = link;
    return peer;
  }
  connected(peer, incoming) { this.#put({kind: 'connected', peer, incoming}); }
  /** Adds a message. Returns false, and nothing arrives, when no session would send that. */
  message(peer, channel, bytes) {
    if (channel > kReliable || bytes.length > kCaps[channel]) return false;
    this.#put({kind: 'message', peer, channel, bytes});
    return true;
  }
  /** Ends a peer, whose number is free again when `disconnected` is read, not before. */
  disconnected(peer) { this.#put({kind: 'disconnected', peer}); }
  /** Ends the connection for this side: nothing more arrives of it. */
  forget(peer) {
    this.peers[peer] = undefined;
    this.inbox = this.inbox.filter(arrival => arrival.peer !== peer);
  }
  #put(arrival) {
    this.inbox.push(arrival);
    this.notify();
  }

  receive() {
    const arrival = this.inbox.shift();
    if (arrival?.kind === 'disconnected') this.peers[arrival.peer] = undefined;
    return arrival ?? null;
  }
}
