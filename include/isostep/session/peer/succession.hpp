// A client becomes the host, or a host a client: what each room makes of the other's core.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "isostep/session/agreement/failover.hpp"
#include "isostep/session/peer/peer_core.hpp"

namespace isostep {

/// The client was elected.
std::unique_ptr<SessionCore> become_host(PeerCore&& client, Succession&& succession, Time now);
/// The host has been left behind, or gives way.
std::unique_ptr<SessionCore> become_client(PeerCore&& host, Retreat&& retreat, Time now);

}  // namespace isostep
