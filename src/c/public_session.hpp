// PublicSession: an iso_session as the pump between transports and sessions knows one.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "include/isostep.h"
#include "isostep/session/peer/session_core.hpp"

namespace isostep::c {

/// A session of isostep.h, as deliver() and dispatch() know one; the first refusal stays.
struct PublicSession {
  iso_session* session;
  iso_status status = ISO_OK;

  void keep(iso_status one) {
    if (status == ISO_OK) status = one;
  }
  void connected(PeerId peer, Time now, bool incoming) {
    keep(iso_session_connected(session, peer, now, incoming ? 1 : 0));
  }
  void disconnected(PeerId peer, Time now) { keep(iso_session_disconnected(session, peer, now)); }
  void receive(PeerId peer, Channel channel, Bytes bytes, Time now) {
    keep(iso_session_receive(session, peer, static_cast<std::uint32_t>(channel), bytes.data(), bytes.size(), now));
  }
  std::optional<Address> poll_connect() {
    const char* address = nullptr;
    keep(iso_session_poll_connect(session, &address));
    if (address == nullptr) return std::nullopt;
    return Address(std::string_view(address));
  }
  std::optional<Outgoing> poll_send(Time now) {
    iso_outgoing out{};
    out.size = sizeof out;
    const std::uint8_t* bytes = nullptr;
    keep(iso_session_poll_send(session, now, &out, &bytes));
    if (bytes == nullptr) return std::nullopt;
    return Outgoing{static_cast<PeerId>(out.peer), static_cast<Channel>(out.channel), Bytes(bytes, out.length),
                    out.close != 0};
  }
};

}  // namespace isostep::c
