// Sessions in C: events, figures, and all else that only looks. Also from within callbacks.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>

#include "session_handle.hpp"

using namespace isostep::c;
using isostep::SessionEvent;

namespace {

using CSession = isostep::Session<SessionGame>;

/// Asks a session; returns `otherwise` of a handle that is none.
template <class T, class F> T look(const iso_session* session, const char* call, T otherwise, const F& function) {
  const Found<iso_session> found(session, call);
  return found.object != nullptr ? static_cast<T>(function(found.object->session)) : otherwise;
}
/// Fills a struct of the caller's.
template <class T, class F>
iso_status look_into(const iso_session* session, const char* call, T* out, const F& function) {
  const Found<iso_session> found(session, call);
  if (found.status != ISO_OK) return found.status;
  if (const iso_status status = check_struct(out, call); status != ISO_OK) return status;
  T given{};
  function(found.object->session, given);
  give(given, out);
  return ISO_OK;
}

template <std::size_t N> void copy_text(std::string_view from, char (&to)[N]) {
  const std::size_t size = std::min(from.size(), N - 1);
  std::copy_n(from.data(), size, to);
  to[size] = 0;
}

static_assert(static_cast<std::uint32_t>(SessionEvent::Kind::unhashed) + 1 == ISO_EVENT_UNHASHED);
static_assert(static_cast<std::uint32_t>(SessionEvent::Kind::vote) + 1 == ISO_EVENT_VOTE);
static_assert(static_cast<std::uint32_t>(isostep::SessionPhase::over) == ISO_OVER);
static_assert(static_cast<std::uint32_t>(isostep::SessionMode::replay) == ISO_REPLAY);
static_assert(static_cast<std::uint32_t>(isostep::InputStatus::disconnected) == ISO_DISCONNECTED);
static_assert(static_cast<std::uint32_t>(isostep::Channel::reliable) == ISO_RELIABLE);
static_assert(static_cast<std::uint32_t>(isostep::Proposal::Kind::other) == ISO_VOTE_OTHER);
static_assert(isostep::kMaxPlayers == ISO_MAX_PLAYERS && isostep::kInputCap == ISO_INPUT_CAP &&
              isostep::kCredentialCap == ISO_CREDENTIAL_CAP && isostep::kDatagramCap == ISO_DATAGRAM_CAP &&
              isostep::kReliableCap == ISO_RELIABLE_CAP && isostep::Tempo::kNormal == ISO_NORMAL_SPEED);

iso_session_event event_of(const SessionEvent& from) {
  iso_session_event to{};
  to.kind = static_cast<std::uint32_t>(from.kind) + 1;
  to.player = from.player;
  to.frame = from.frame;
  to.agreed = from.agreed;
  to.players = from.players;
  to.speed = from.speed;
  to.vote = from.ballot.number;
  to.proposal = from.ballot.number == 0 ? 0 : static_cast<std::uint32_t>(from.ballot.proposal.kind);
  to.subject = from.ballot.proposal.subject;
  to.proposer = from.ballot.by;
  to.voters = from.ballot.voters;
  to.yes = from.ballot.yes;
  to.no = from.ballot.no;
  to.ours = from.ours;
  to.theirs = from.theirs;
  copy_text(from.field.key.view(), to.key);
  copy_text(from.field.in_file.view(), to.theirs_text);
  copy_text(from.field.here.view(), to.ours_text);
  return to;
}

}  // namespace

extern "C" {

#define ISO_START(name)                                              \
  iso_status iso_##name##_init_sized(iso_##name* out, size_t size) { \
    return start_struct(#name "_init", {}, out, size);               \
  }
ISO_START(request)
ISO_START(outgoing)
ISO_START(session_event)
ISO_START(session_stats)
ISO_START(player_stats)
ISO_START(applicant)
#undef ISO_START

iso_status iso_session_poll_event(iso_session* session, iso_session_event* out) {
  if (const iso_status status = check_struct(out, ISO_C_CALL); status != ISO_OK) return status;
  return in_session(session, ISO_C_CALL, [&](SessionObject& one) {
    const std::optional<SessionEvent> event = one.session.poll_event();
    give(event ? event_of(*event) : iso_session_event{}, out);
    return ISO_OK;
  });
}

uint8_t iso_session_wants_input(const iso_session* session, int32_t player) {
  return look<uint8_t>(session, ISO_C_CALL, 0, [&](const CSession& one) { return one.wants_input(player) ? 1 : 0; });
}
uint64_t iso_session_wait(const iso_session* session, uint64_t now) {
  return look<uint64_t>(session, ISO_C_CALL, 0, [&](const CSession& one) { return one.wait(now); });
}
iso_phase iso_session_phase(const iso_session* session) {
  return look<uint32_t>(session, ISO_C_CALL, ISO_OVER, [](const CSession& one) { return one.phase(); });
}
uint64_t iso_session_token(const iso_session* session) {
  return look<uint64_t>(session, ISO_C_CALL, 0, [](const CSession& one) { return one.token(); });
}
int32_t iso_session_local_player(const iso_session* session) {
  return look<int32_t>(session, ISO_C_CALL, -1, [](const CSession& one) { return one.local_player(); });
}
uint32_t iso_session_local_players(const iso_session* session) {
  return look<uint32_t>(session, ISO_C_CALL, 0, [](const CSession& one) { return one.local_players(); });
}
int32_t iso_session_current(const iso_session* session) {
  return look<int32_t>(session, ISO_C_CALL, -1, [](const CSession& one) { return one.current(); });
}
int32_t iso_session_confirmed(const iso_session* session) {
  return look<int32_t>(session, ISO_C_CALL, -1, [](const CSession& one) { return one.confirmed(); });
}
int32_t iso_session_peer_of(const iso_session* session, int32_t player) {
  return look<int32_t>(session, ISO_C_CALL, -1, [&](const CSession& one) {
    const std::optional<isostep::PeerId> peer = one.peer_of(player);
    return peer ? int32_t{*peer} : -1;
  });
}

iso_status iso_session_input(const iso_session* session, int32_t frame, int32_t player, iso_input* out) {
  ISO_C_REQUIRE(ISO_C_CALL, out);
  const Found<iso_session> found(session, ISO_C_CALL);
  if (found.status != ISO_OK) return found.status;
  const CSession& one = found.object->session;
  const isostep::Bytes bytes = one.input(frame, player);
  *out = {};
  out->size = static_cast<std::uint16_t>(bytes.size());
  out->status = static_cast<std::uint8_t>(one.status(frame, player));
  if (!bytes.empty()) std::memcpy(out->bytes, bytes.data(), bytes.size());
  return ISO_OK;
}

iso_status iso_session_snapshot_progress(const iso_session* session, uint32_t peer, uint32_t* arrived, uint32_t* size) {
  ISO_C_REQUIRE(ISO_C_CALL, arrived);
  ISO_C_REQUIRE(ISO_C_CALL, size);
  const Found<iso_session> found(session, ISO_C_CALL);
  if (found.status != ISO_OK) return found.status;
  isostep::SnapshotProgress progress;
  if (is_peer(peer)) progress = found.object->session.snapshot_progress(static_cast<isostep::PeerId>(peer));
  *arrived = progress.arrived;
  *size = progress.size;
  return ISO_OK;
}

iso_status iso_session_get_stats(const iso_session* session, iso_session_stats* out) {
  return look_into(session, ISO_C_CALL, out, [](const CSession& one, iso_session_stats& to) {
    const isostep::SessionStats& from = one.stats();
    static_assert(sizeof to.rollbacks == sizeof from.rollbacks);
    std::copy(std::begin(from.rollbacks), std::end(from.rollbacks), to.rollbacks);
#define ISO_COPY(name) to.name = from.name;
    ISO_COPY(delay)
    ISO_COPY(steps)
    ISO_COPY(waits)
    ISO_COPY(datagrams_out)
    ISO_COPY(datagrams_in)
    ISO_COPY(bytes_out)
    ISO_COPY(bytes_in) ISO_COPY(refused) ISO_COPY(flooded) ISO_COPY(put_out) ISO_COPY(events_lost) ISO_COPY(round_trip)
        ISO_COPY(peers) ISO_COPY(machines) ISO_COPY(jitter) ISO_COPY(loss) ISO_COPY(stretch)
#undef ISO_COPY
  });
}

iso_status iso_session_get_player_stats(const iso_session* session, int32_t player, iso_player_stats* out) {
  if (player < 0 || player >= ISO_MAX_PLAYERS) return refuse(ISO_REFUSED, ISO_C_CALL, "player", "0 to 31");
  return look_into(session, ISO_C_CALL, out, [&](const CSession& one, iso_player_stats& to) {
    const isostep::PlayerStats& from = one.stats().players[player];
    to.early = from.early;
    to.replaced = from.replaced;
    to.waited = from.waited;
    to.round_trip = from.round_trip;
    to.jitter = from.jitter;
    to.loss = from.loss;
  });
}
}
