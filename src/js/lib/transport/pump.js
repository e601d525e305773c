// Between an endpoint and a session: what has arrived goes in, what the session has to say goes out.
// SPDX-License-Identifier: MIT

/** Before drive(). */
export function deliver(endpoint, session, now) {
  for (let arrival = endpoint.receive(); arrival !== null; arrival = endpoint.receive()) {
    if (arrival.kind === 'connected') session.connected(arrival.peer, now, arrival.incoming);
    else if (arrival.kind === 'disconnected') session.disconnected(arrival.peer, now);
    else session.receive(arrival.peer, arrival.channel, arrival.bytes, now);
  }
}

/** After it. What an endpoint refuses is as good as lost, and a session lives with losses. */
export function dispatch(endpoint, session, now) {
  if (endpoint.connectTo !== undefined) {
    for (let address = session.pollConnect(); address !== null; address = session.pollConnect()) {
      try {
        endpoint.connectTo(address);
      } catch {
        // An address that cannot be is as one where nobody answers: the session goes on to the next.
      }
    }
  }
  for (let out = session.pollSend(now); out !== null; out = session.pollSend(now)) {
    if (out.bytes.length > 0) endpoint.send(out.peer, out.channel, out.bytes);
    if (out.close) endpoint.disconnect(out.peer);
  }
}
