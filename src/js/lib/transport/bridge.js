// A bridge between browsers and a native host: a client that connects here gets a connection of its own there.
// SPDX-License-Identifier: MIT
//
// The host sees ordinary clients over UDP, and need not know that they are browsers. The bridge knows nothing of the
// match: it passes messages on as they are, each on its channel.

import {kReliable} from './channel.js';
import {EnetTransport} from './enet.js';

/**
 * Passes messages between the clients of `listener`, a WebSocketTransport or DataChannelTransport that others connect
 * to, and the native host at "127.0.0.1:41873". Ends with close(). key: the host's EnetSettings::key, 16 bytes. The host
 * lets so many peers come from one address: EnetSettings::max_peers_an_address, 16 unless told.
 */
export function bridge(listener, address, {key} = {}) {
  const host = new EnetTransport({maxPeers: listener.arrivals.maxPeers, key});
  const there = new Map(), here = new Map();  // peers of one side by those of the other
  const early = new Map();  // reliable messages of clients whose connection there is not yet open
  const part = (client, peer) => {
    there.delete(client);
    here.delete(peer);
    early.delete(client);
  };
  const fromClients = () => {
    for (let arrival; (arrival = listener.receive()) !== null;) {
      const {kind, peer: client, channel, bytes} = arrival;
      if (kind === 'connected') {
        const peer = host.connectTo(address);
        there.set(client, peer);
        here.set(peer, client);
        early.set(client, []);
      } else if (kind === 'message' && early.has(client)) {
        if (channel === kReliable) early.get(client).push(bytes);
      } else if (kind === 'message') {
        host.send(there.get(client), channel, bytes);
      } else if (there.has(client)) {
        const peer = there.get(client);
        part(client, peer);
        host.disconnect(peer);
      }
    }
  };
  const fromHost = () => {
    for (let arrival; (arrival = host.receive()) !== null;) {
      const {kind, peer, channel, bytes} = arrival;
      const client = here.get(peer);
      if (kind === 'connected') {
        for (const message of early.get(client)) host.send(peer, kReliable, message);
        early.delete(client);
      } else if (kind === 'message') {
        listener.send(client, channel, bytes);
      } else if (kind === 'disconnected' && client !== undefined) {
        part(client, peer);
        listener.disconnect(client);
      }
    }
  };
  listener.arrivals.notify = fromClients;
  host.arrivals.notify = fromHost;
  return {
    close() {
      listener.arrivals.notify = () => {};
      host.close();
      listener.close();
    }
  };
}
