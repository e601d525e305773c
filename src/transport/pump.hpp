// Between a transport and a session: what has arrived goes in, what the session has to say goes out.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/core.hpp"
#include "transport/endpoint.hpp"

namespace isostep::transport {

/// Before drive().
template <Endpoint E, class Session> void deliver(E& endpoint, Session& session, Time now) {
  while (const std::optional<Arrival> arrival = endpoint.receive()) {
    switch (arrival->kind) {
      case ArrivalKind::connected: session.connected(arrival->peer, now, arrival->incoming); break;
      case ArrivalKind::disconnected: session.disconnected(arrival->peer, now); break;
      case ArrivalKind::message: session.receive(arrival->peer, arrival->channel, arrival->bytes, now); break;
    }
  }
}

/// After it. What the transport refuses is as good as lost, and a session lives with losses.
template <Endpoint E, class Session> void dispatch(E& endpoint, Session& session, Time now) {
  while (const std::optional<Outgoing> out = session.poll_send(now)) {
    if (!out->bytes.empty()) static_cast<void>(endpoint.send(out->peer, out->channel, out->bytes).ok());
    if (out->close) endpoint.disconnect(out->peer);
  }
}

}  // namespace isostep::transport
