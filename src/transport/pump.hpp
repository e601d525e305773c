// The pump between a transport and a session: what has arrived goes in, what the session has to say goes out.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/peer/session_core.hpp"
#include "transport/endpoint.hpp"

namespace isostep::transport {

/// Gives a session what has arrived. It comes before drive().
template <Endpoint E, class Session> void deliver(E& endpoint, Session& session, Time now) {
  if constexpr (requires { endpoint.tend(now); }) endpoint.tend(now);
  while (const std::optional<Arrival> arrival = endpoint.receive()) {
    switch (arrival->kind) {
      case ArrivalKind::connected: session.connected(arrival->peer, now, arrival->incoming); break;
      case ArrivalKind::disconnected: session.disconnected(arrival->peer, now); break;
      case ArrivalKind::message: session.receive(arrival->peer, arrival->channel, arrival->bytes, now); break;
    }
  }
}

/// Sends what a session has to say. It comes after drive(). What the transport refuses is as good as lost, and a
/// session lives with losses. With an endpoint that is no Connector the caller asks poll_connect() itself, where the
/// match may go on without its host.
template <Endpoint E, class Session> void dispatch(E& endpoint, Session& session, Time now) {
  if constexpr (Connector<E>) {
    // An address that cannot be is as one where nobody answers: the session goes on to the next.
    while (const auto address = session.poll_connect()) static_cast<void>(endpoint.connect_to(address->view()).ok());
  }
  while (const std::optional<Outgoing> out = session.poll_send(now)) {
    if (!out->bytes.empty()) static_cast<void>(endpoint.send(out->peer, out->channel, out->bytes).ok());
    if (out->close) endpoint.disconnect(out->peer);
  }
}

}  // namespace isostep::transport
