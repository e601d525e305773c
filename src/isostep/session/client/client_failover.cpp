// A client that was the host, and one that is elected.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/client_core.hpp"
#include "isostep/session/peer/peer_core.hpp"

namespace isostep {

std::unique_ptr<SessionCore> become_client(PeerCore&& host, Retreat&& retreat, Time now) {
  return std::make_unique<ClientCore>(std::move(host), std::move(retreat), now);
}

ClientCore::ClientCore(PeerCore&& host, Retreat&& retreat, Time now)
    : PeerCore(std::move(host)),
      partings_(std::move(retreat.guests)),
      entry_(arrival_, retreat.is_outvoted),
      failover_{parts_, log_, HostSearch(retreat), message_} {
  config_.host = false;
  failover_.callers().make_room(static_cast<std::size_t>(config_.max_peers + config_.max_strangers));
  if (retreat.players == 0) {
    config_.mode = SessionMode::spectator;
  } else {
    own_.sit(retreat.players);
    for (int p = 0; p < players(); ++p) own_.accept_until(p, streams_[static_cast<std::size_t>(p)].end());
    own_.go_on_from(0);
  }
  log_.is_final_until(hashes_.settled().frame);
  failover_.begin(now, false);
}

bool ClientCore::may_stand() const {
  const bool has_state = has_start_ && !entry_.is_under_way() && !entry_.is_spoiled();
  return own_.first() >= 0 && has_state && !views_.is_outvoted(static_cast<std::size_t>(own_.first()));
}

std::unique_ptr<SessionCore> ClientCore::succeed(Time now) {
  HostSearch& search = failover_.search();
  if (!search.is_elected()) return nullptr;
  failover_.callers().forget_untold();
  Succession succession = search.hand_over(failover_.callers().hand_over());
  // To connect takes a while: who was asked before we called may have answered since.
  if (host_.is_connected) succession.asked = host_.peer;
  return become_host(std::move(*this), std::move(succession), now);
}

void ClientCore::accepted(PeerId peer, Time now) {
  if (!failover_.callers().accept(peer, now)) ++stats_.refused;
}

}  // namespace isostep
