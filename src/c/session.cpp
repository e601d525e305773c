// Sessions in C: their life, and the turn.
// SPDX-License-Identifier: MIT
#include <cstring>
#include <new>

#include "isostep.h"
#include "session_config.hpp"
#include "session_handle.hpp"

namespace isostep::c {

void SessionTurn::begin(Session<SessionGame>& session, Time now) {
  requests_ = session.advance(now);
  at_ = 0;
  is_open_ = true;
}

iso_request SessionTurn::next(Session<SessionGame>& session, SessionGame& game, SessionObserver& observer) {
  if (is_stepping_) observer.after_step(requests_[at_ - 1].frame);
  is_stepping_ = false;
  while (is_open_) {
    if (observer.notice) {
      const iso_request notice = *observer.notice;
      observer.notice.reset();
      return notice;
    }
    if (at_ < requests_.size()) {
      const Request<Bytes>& request = requests_[at_++];
      if (request.kind == RequestKind::step) {
        observer.before_step(request.frame);
        show(request.inputs);
        is_stepping_ = true;
        return {sizeof(iso_request), ISO_STEP, request.frame, 0, 0};
      }
      carry_out(session, game, request, observer);
    } else if (const auto confirmed = session.poll_confirmed()) {
      observer.confirmed(confirmed->frame, confirmed->hash);
    } else {
      is_open_ = false;
    }
  }
  return {sizeof(iso_request), ISO_NOTHING, kNoFrame, 0, 0};
}

void SessionTurn::show(const InputView<Bytes>& inputs) {
  inputs_.resize(inputs.size());
  for (std::size_t p = 0; p < inputs.size(); ++p) {
    inputs_[p] = {};
    inputs_[p].size = static_cast<std::uint16_t>(inputs[p].size());
    inputs_[p].status = static_cast<std::uint8_t>(inputs.status(p));
    if (!inputs[p].empty()) std::memcpy(inputs_[p].bytes, inputs[p].data(), inputs[p].size());
  }
}

iso_status can_call(const iso_session* session, bool in_turn) {
  if (session == nullptr) return ISO_NULL;
  if (!Sessions::has(session)) return ISO_NOT_ALIVE;
  if (session->is_called) return ISO_CALLED_BACK;
  if (session->is_broken) return ISO_NO_MEMORY;
  if (!session->game.is_alive()) return ISO_NOT_ALIVE;
  if (session->turn.is_open() && !in_turn) return ISO_UNFINISHED;
  return ISO_OK;
}

namespace {

Bytes recording_of(const iso_session_config& config, const std::vector<std::uint8_t>& file) {
  return config.mode == ISO_REPLAY ? Bytes(file) : Bytes();
}

void step(iso_session& session, Frame frame) {
  const iso_game& game = session.game.callbacks();
  game.step(game.user, frame, session.turn.inputs(), static_cast<std::uint32_t>(session.session.config().players));
}

/// Tells the game's callbacks; true: that was a step.
bool carry_out(iso_session& session, const iso_request& request) {
  const iso_game& game = session.game.callbacks();
  switch (request.kind) {
    case ISO_STEP: step(session, request.frame); return true;
    case ISO_ROLLED_BACK:
      if (game.rolled_back != nullptr) game.rolled_back(game.user, request.frame);
      break;
    case ISO_RESTARTED:
      if (game.restarted != nullptr) game.restarted(game.user, request.frame);
      break;
    case ISO_FRAME_CONFIRMED:
      if (game.confirmed != nullptr) game.confirmed(game.user, request.frame, request.hash);
      break;
    default: break;
  }
  return false;
}

}  // namespace
}  // namespace isostep::c

using namespace isostep::c;

iso_session::iso_session(const iso_game& its_game, const iso_session_config& its_config, isostep::SessionConfig rest,
                         isostep::Bytes bytes)
    : game(its_game, its_config),
      file(bytes.begin(), bytes.end()),
      session(rest, game.rules(), recording_of(its_config, file)),
      config(its_config) {}

extern "C" {

iso_status iso_session_create(const iso_session_config* config, const iso_game* game, const void* file,
                              size_t file_size, iso_session** out) {
  if (out != nullptr) *out = nullptr;
  if (config == nullptr || game == nullptr || out == nullptr || (file == nullptr && file_size > 0)) return ISO_NULL;
  return guarded([&]() -> iso_status {
    iso_session_config whole;
    iso_game its_game;
    if (const Problem problem = read_game(game, its_game); problem.status != ISO_OK) return problem.status;
    if (const Problem problem = read_config(config, whole); problem.status != ISO_OK) return problem.status;
    isostep::SessionConfig rest = to_session_config(whole);
    const std::unique_ptr<SessionWorld> world = session_world_of(its_game.world);
    if (its_game.world != nullptr && world == nullptr) return ISO_NOT_ALIVE;
    const isostep::Result<isostep::ReplayHeader> identity = identity_of_game(its_game, world.get(), whole.name);
    if (!identity) return ISO_REFUSED;
    rest.identity = identity.value();
    const isostep::Bytes bytes(static_cast<const std::uint8_t*>(file), file_size);
    if (whole.mode != ISO_REPLAY) rest.saved_match.assign(bytes.begin(), bytes.end());
    if (isostep::problem_of(rest) != nullptr) return ISO_REFUSED;
    auto session = std::make_unique<iso_session>(its_game, whole, rest, bytes);
    Sessions::add(session.get());
    *out = session.release();
    return ISO_OK;
  });
}

iso_status iso_session_destroy(iso_session* session) {
  if (session == nullptr) return ISO_OK;
  if (!Sessions::has(session)) return ISO_NOT_ALIVE;
  if (session->is_called) return ISO_CALLED_BACK;
  Sessions::remove(session);
  delete session;
  return ISO_OK;
}

const char* iso_session_problem(const iso_session* session) {
  return session != nullptr && Sessions::has(session) ? session->problem : "";
}

iso_status iso_session_advance(iso_session* session, uint64_t now) {
  return call(session, [&](iso_session& one) {
    one.turn.begin(one.session, now);
    return ISO_OK;
  });
}

iso_status iso_session_next(iso_session* session, iso_request* out) {
  return call(
      session,
      [&](iso_session& one) -> iso_status {
        if (const iso_status status = can_give(out); status != ISO_OK) return status;
        give(one.turn.next(one.session, one.game, one.observer), out);
        return ISO_OK;
      },
      true);
}

const iso_input* iso_session_inputs(const iso_session* session, uint32_t* players) {
  const bool has = session != nullptr && Sessions::has(session) && session->turn.is_stepping();
  if (players != nullptr) *players = has ? static_cast<std::uint32_t>(session->session.config().players) : 0;
  return has ? session->turn.inputs() : nullptr;
}

iso_status iso_session_drive(iso_session* session, uint64_t now, uint32_t* steps) {
  if (steps != nullptr) *steps = 0;
  return call(session, [&](iso_session& one) -> iso_status {
    if (one.game.callbacks().step == nullptr) return ISO_NULL;
    one.turn.begin(one.session, now);
    for (;;) {
      const iso_request request = one.turn.next(one.session, one.game, one.observer);
      if (request.kind == ISO_NOTHING) return ISO_OK;
      if (isostep::c::carry_out(one, request) && steps != nullptr) ++*steps;
    }
  });
}
}
