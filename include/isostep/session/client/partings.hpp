// Partings: connections that a client ends, and whom it tells before that it goes.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "isostep/session/peer/peer_link.hpp"
#include "isostep/session/protocol/message.hpp"

namespace isostep {

/// In: peers to leave. Out: each with its last message; an empty one ends the connection. Keeps: those that are left.
class Partings {
 public:
  Partings() = default;
  explicit Partings(std::vector<PeerId> told) : told_(std::move(told)) {}

  void hang_up(PeerId peer) { untold_.push_back(peer); }
  /// Says farewell to our host or our guest, then ends the connection.
  void bid_farewell(PeerId peer) { told_.push_back(peer); }
  /// Leaves the host. `is_known`: says farewell, for a host would count us among those who left the match, and a
  /// candidate may have become the host by our support.
  void leave(PeerLink& host, bool is_known) {
    if (host.is_connected && is_known) bid_farewell(host.peer);
    else if (host.is_connected) hang_up(host.peer);
    host.is_connected = false;
  }
  std::optional<PeerId> write_next(std::vector<std::uint8_t>& message) {
    if (told_.empty() && untold_.empty()) return std::nullopt;
    std::vector<PeerId>& from = told_.empty() ? untold_ : told_;
    const PeerId peer = from.back();
    from.pop_back();
    message.clear();
    if (&from == &untold_) return peer;
    write_farewell(message);
    hang_up(peer);
    return peer;
  }

 private:
  std::vector<PeerId> told_, untold_;
};

}  // namespace isostep
