// Sessions in C: their life, and the turn.
// SPDX-License-Identifier: MIT
#include <cstring>
#include <memory>

#include "session_config.hpp"
#include "session_handle.hpp"

namespace isostep::c {

void SessionTurn::begin(Session<SessionGame>& session, Time now) {
  requests_ = session.advance(now);  // tells misuse where the turn before was left
  at_ = 0;
  is_open_ = true;
  is_stepping_ = false;
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

SessionObject::SessionObject(const iso_game& its_game, const iso_session_config& its_config, const SessionConfig& rest,
                             Bytes bytes)
    : game(its_game, its_config),
      file(bytes.begin(), bytes.end()),
      session(rest, game.rules(), its_config.mode == ISO_REPLAY ? Bytes(file) : Bytes()),
      config(its_config) {}

iso_status enter(const iso_session* handle, const char* call, SessionObject*& object) {
  const Found<iso_session> found(handle, call);
  if (found.status != ISO_OK) return found.status;
  object = found.object;
  if (object->is_called) return refuse(ISO_CALLED_BACK, call);
  if (object->is_broken) return refuse(ISO_NO_MEMORY, call, "an earlier call");
  return object->game.is_alive() ? ISO_OK : refuse(ISO_NOT_ALIVE, call, "the game's world");
}

namespace {

void step(SessionObject& session, Frame frame) {
  const iso_game& game = session.game.callbacks();
  game.step(game.user, frame, session.turn.inputs(), static_cast<std::uint32_t>(session.session.config().players));
}

/// Tells the game's callbacks. Returns true when that was a step.
bool carry_out(SessionObject& session, const iso_request& request) {
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

extern "C" {

iso_status iso_session_create(const iso_session_config* config, const iso_game* game, const void* file,
                              size_t file_size, iso_session** out) {
  ISO_C_REQUIRE(ISO_C_CALL, out);
  *out = nullptr;
  if (file_size > 0) ISO_C_REQUIRE(ISO_C_CALL, file);
  return guarded(ISO_C_CALL, [&, call = ISO_C_CALL]() -> iso_status {
    iso_session_config whole;
    iso_game its_game;
    if (const Problem problem = read_game(game, its_game); problem.status != ISO_OK)
      return refuse(problem, call, "game");
    if (const Problem problem = read_config(config, whole); problem.status != ISO_OK) {
      return refuse(problem, call, "config");
    }
    std::unique_ptr<SessionWorld> world;
    if (its_game.world != nullptr) world = session_world_of(its_game.world);
    if (its_game.world != nullptr && world == nullptr) return refuse(ISO_NOT_ALIVE, call, "game.world");
    const isostep::Result<isostep::ReplayHeader> identity = identity_of_game(its_game, world.get(), whole.name);
    if (!identity) return refuse(ISO_REFUSED, call, identity.error());
    isostep::SessionConfig rest = to_session_config(whole);
    rest.identity = identity.value();
    const isostep::Bytes bytes(static_cast<const std::uint8_t*>(file), file_size);
    if (whole.mode != ISO_REPLAY) rest.saved_match.assign(bytes.begin(), bytes.end());
    if (const char* problem = isostep::problem_of(rest)) return refuse(ISO_REFUSED, call, "file", problem);
    auto session = std::make_unique<SessionObject>(its_game, whole, rest, bytes);
    *out = open_handle<iso_session>(session.get());
    session.release();
    return ISO_OK;
  });
}

iso_status iso_session_destroy(iso_session* session) {
  if (session == nullptr) return ISO_OK;
  const Found<iso_session> found(session, ISO_C_CALL);
  if (found.status == ISO_OK && found.object->is_called) return refuse(ISO_CALLED_BACK, ISO_C_CALL);
  return destroy_handle(session, ISO_C_CALL);
}

iso_status iso_session_advance(iso_session* session, uint64_t now) {
  return in_session(session, ISO_C_CALL, [&](SessionObject& one) {
    one.turn.begin(one.session, now);
    return ISO_OK;
  });
}

iso_status iso_session_next(iso_session* session, iso_request* out) {
  if (const iso_status status = check_struct(out, ISO_C_CALL); status != ISO_OK) return status;
  return in_session(session, ISO_C_CALL, [&](SessionObject& one) {
    give(one.turn.next(one.session, one.game, one.observer), out);
    return ISO_OK;
  });
}

const iso_input* iso_session_inputs(const iso_session* session, uint32_t* players) {
  const Found<iso_session> found(session, ISO_C_CALL);
  const bool has = found.object != nullptr && found.object->turn.is_stepping();
  if (players != nullptr) *players = has ? static_cast<std::uint32_t>(found.object->session.config().players) : 0;
  return has ? found.object->turn.inputs() : nullptr;
}

iso_status iso_session_drive(iso_session* session, uint64_t now, uint32_t* steps) {
  if (steps != nullptr) *steps = 0;
  return in_session(session, ISO_C_CALL, [&, call = ISO_C_CALL](SessionObject& one) -> iso_status {
    if (one.game.callbacks().step == nullptr) return refuse(ISO_NULL, call, "game.step");
    one.turn.begin(one.session, now);
    for (;;) {
      const iso_request request = one.turn.next(one.session, one.game, one.observer);
      if (request.kind == ISO_NOTHING) return ISO_OK;
      if (isostep::c::carry_out(one, request) && steps != nullptr) ++*steps;
    }
  });
}
}
