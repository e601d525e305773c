// Sessions in C: inputs, the transport's side, and what their game decides.
// SPDX-License-Identifier: MIT
#include <cstring>

#include "session_handle.hpp"

using namespace isostep::c;
using isostep::Bytes;

namespace {

using CSession = isostep::Session<SessionGame>;
constexpr const char* kNow = "what this machine may do, at a time when it may";
constexpr const char* kReason = "somebody who is there, and a reason of 1 to 128 characters of printable ASCII";

}  // namespace

extern "C" {

iso_status iso_session_add_local_input(iso_session* session, int32_t player, const void* bytes, size_t size) {
  if (size > 0) ISO_C_REQUIRE(ISO_C_CALL, bytes);
  return ask_session(session, ISO_C_CALL,
                     "a player of ours who is in the match, and an input of its size that is valid",
                     [&](CSession& one) {
                       if (size > isostep::kInputCap) return false;
                       return one.add_local_input(player, Bytes(static_cast<const std::uint8_t*>(bytes), size));
                     });
}

iso_status iso_session_connected(iso_session* session, uint32_t peer, uint64_t now, uint8_t incoming) {
  if (incoming > 1) return refuse(ISO_BAD_ENUM, ISO_C_CALL, "incoming");
  return ask_session(session, ISO_C_CALL, "a peer of 0 to 65535", [&](CSession& one) {
    if (is_peer(peer)) one.connected(static_cast<isostep::PeerId>(peer), now, incoming != 0);
    return is_peer(peer);
  });
}

iso_status iso_session_disconnected(iso_session* session, uint32_t peer, uint64_t now) {
  return ask_session(session, ISO_C_CALL, "a peer of 0 to 65535", [&](CSession& one) {
    if (is_peer(peer)) one.disconnected(static_cast<isostep::PeerId>(peer), now);
    return is_peer(peer);
  });
}

iso_status iso_session_receive(iso_session* session, uint32_t peer, uint32_t channel, const void* bytes, size_t size,
                               uint64_t now) {
  if (size > 0) ISO_C_REQUIRE(ISO_C_CALL, bytes);
  if (channel > ISO_RELIABLE) return refuse(ISO_BAD_ENUM, ISO_C_CALL, "channel");
  return ask_session(session, ISO_C_CALL, "a peer of 0 to 65535", [&](CSession& one) {
    if (!is_peer(peer)) return false;
    one.receive(static_cast<isostep::PeerId>(peer), static_cast<isostep::Channel>(channel),
                Bytes(static_cast<const std::uint8_t*>(bytes), size), now);
    return true;
  });
}

iso_status iso_session_poll_send(iso_session* session, uint64_t now, iso_outgoing* out, const uint8_t** bytes) {
  ISO_C_REQUIRE(ISO_C_CALL, bytes);
  *bytes = nullptr;
  if (const iso_status status = check_struct(out, ISO_C_CALL); status != ISO_OK) return status;
  return in_session(session, ISO_C_CALL, [&](SessionObject& one) {
    static constexpr std::uint8_t kEmpty = 0;
    iso_outgoing given{};
    if (const std::optional<isostep::Outgoing> sent = one.session.poll_send(now)) {
      given.peer = sent->peer;
      given.channel = static_cast<std::uint32_t>(sent->channel);
      given.length = static_cast<std::uint32_t>(sent->bytes.size());
      given.close = sent->close ? 1 : 0;
      *bytes = sent->bytes.empty() ? &kEmpty : sent->bytes.data();
    }
    give(given, out);
    return ISO_OK;
  });
}

iso_status iso_session_poll_connect(iso_session* session, const char** address) {
  ISO_C_REQUIRE(ISO_C_CALL, address);
  *address = nullptr;
  return in_session(session, ISO_C_CALL, [&](SessionObject& one) -> iso_status {
    const std::optional<isostep::Address> named = one.session.poll_connect();
    if (!named) return ISO_OK;
    const std::string_view text = named->view();
    std::memcpy(one.address, text.data(), text.size());
    one.address[text.size()] = 0;
    *address = one.address;
    return ISO_OK;
  });
}

iso_status iso_session_start(iso_session* session, uint64_t now) {
  return in_session(session, ISO_C_CALL, [&](SessionObject& one) {
    one.session.start(now);
    return ISO_OK;
  });
}
iso_status iso_session_resync(iso_session* session) {
  return ask_session(session, ISO_C_CALL, kNow, [](CSession& one) { return one.resync(); });
}
iso_status iso_session_go_on(iso_session* session, uint64_t now) {
  return ask_session(session, ISO_C_CALL,
                     "a match with migration that stands without a majority or its host, and a part in it",
                     [&](CSession& one) { return one.go_on(now); });
}
iso_status iso_session_pause(iso_session* session) {
  return ask_session(session, ISO_C_CALL, kNow, [](CSession& one) { return one.pause(); });
}
iso_status iso_session_unpause(iso_session* session) {
  return ask_session(session, ISO_C_CALL, kNow, [](CSession& one) { return one.unpause(); });
}
iso_status iso_session_set_speed(iso_session* session, int32_t eighths) {
  return ask_session(session, ISO_C_CALL,
                     "4 to 16 eighths, most_packets twice the rate, in a match of which this machine decides",
                     [&](CSession& one) { return one.set_speed(eighths); });
}

iso_status iso_session_propose(iso_session* session, int32_t player, uint32_t proposal, uint32_t subject) {
  if (proposal < ISO_VOTE_PAUSE || proposal > ISO_VOTE_OTHER) return refuse(ISO_BAD_ENUM, ISO_C_CALL, "proposal");
  return ask_session(session, ISO_C_CALL, kNow, [&](CSession& one) {
    return one.propose(player, {static_cast<isostep::Proposal::Kind>(proposal), subject});
  });
}
iso_status iso_session_vote(iso_session* session, int32_t player, uint8_t yes) {
  if (yes > 1) return refuse(ISO_BAD_ENUM, ISO_C_CALL, "yes");
  return ask_session(session, ISO_C_CALL, "a vote that is open, and a player of ours",
                     [&](CSession& one) { return one.vote(player, yes != 0); });
}

iso_status iso_session_poll_applicant(iso_session* session, iso_applicant* out) {
  if (const iso_status status = check_struct(out, ISO_C_CALL); status != ISO_OK) return status;
  return in_session(session, ISO_C_CALL, [&](SessionObject& one) {
    iso_applicant given{};
    if (const std::optional<isostep::Applicant> applicant = one.session.poll_applicant()) {
      given.peer = applicant->peer;
      given.id = applicant->id;
      given.spectator = applicant->spectator ? 1 : 0;
      given.seat = applicant->seat;
      given.seats = applicant->seats;
      given.player = applicant->player;
      given.credential_size = static_cast<std::uint32_t>(applicant->credential.size());
      if (!applicant->credential.empty()) {
        std::memcpy(given.credential, applicant->credential.data(), applicant->credential.size());
      }
    }
    give(given, out);
    return ISO_OK;
  });
}
iso_status iso_session_admit(iso_session* session, uint64_t applicant) {
  return ask_session(session, ISO_C_CALL, "an applicant who is still there, and a seat",
                     [&](CSession& one) { return one.admit(applicant); });
}
iso_status iso_session_refuse(iso_session* session, uint64_t applicant, const char* reason) {
  ISO_C_REQUIRE(ISO_C_CALL, reason);
  return ask_session(session, ISO_C_CALL, kReason, [&](CSession& one) { return one.refuse(applicant, reason); });
}
iso_status iso_session_kick(iso_session* session, int32_t player, const char* reason) {
  ISO_C_REQUIRE(ISO_C_CALL, reason);
  return ask_session(session, ISO_C_CALL, kReason, [&](CSession& one) { return one.kick(player, reason); });
}
iso_status iso_session_kick_peer(iso_session* session, uint32_t peer, const char* reason) {
  ISO_C_REQUIRE(ISO_C_CALL, reason);
  return ask_session(session, ISO_C_CALL, kReason, [&](CSession& one) {
    return is_peer(peer) && one.kick_peer(static_cast<isostep::PeerId>(peer), reason);
  });
}
}
