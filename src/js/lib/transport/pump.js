// The pump between an endpoint and a session: arrivals go in, the session's messages go out.
// SPDX-License-Identifier: MIT

/** Gives arrivals to the session, before drive(). */
export function deliver(endpoint, session, now) {
  for (let arrival = endpoint.receive(); arrival !== null; arrival = endpoint.receive()) {
    if (arrival.kind === 'connected') session.connected(arrival.peer, now, arrival.incoming);
    else if (arrival.kind === 'disconnected') session.disconnected(arrival.peer, now);
    else session.receive(arrival.peer, arrival.channel, arrival.bytes, now);
  }
}

/** Sends the session's messages, after drive(). One that an endpoint refuses is lost; sessions live with losses. */
export function dispatch(endpoint, session, now) {
  if (endpoint.connectTo !== undefined) {
    for (let address = session.pollConnect(); address !== null; address = session.pollConnect()) {
      try {
        endpoint.connectTo(address);
      } catch {
        // An impossible address is like one where nobody answers: the session goes on to the next.
      }
    }
  }
  for (let out = session.pollSend(now); out !== null; out = session.pollSend(now)) {
    if (out.bytes.length > 0) endpoint.send(out.peer, out.channel, out.bytes);
    if (out.close) endpoint.disconnect(out.peer);
  }
}
