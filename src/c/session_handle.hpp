// The object behind an iso_session: a Session of a SessionGame, the turn that is under way, and what observes it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "flat_struct.hpp"
#include "handle.hpp"
#include "include/isostep.h"
#include "isostep/session/session.hpp"
#include "session_game.hpp"

namespace isostep::c {

inline constexpr std::uint32_t kRecordings = 2;  // ISO_RECORD_MATCH, ISO_RECORD_WORLD

/// Observes the turns for the recordings that are under way, and keeps the request that the caller is told next.
struct SessionObserver {
  std::unique_ptr<FrameRecording> recordings[kRecordings];
  bool has_ended[kRecordings] = {};  // its file is whole
  std::optional<iso_request> notice;

  template <class F> void each(F&& call) {
    for (std::uint32_t i = 0; i < kRecordings; ++i) {
      if (recordings[i] != nullptr && !has_ended[i]) call(*recordings[i]);
    }
  }
  void before_step(Frame frame) {
    each([&](FrameRecording& one) { one.before_step(frame); });
  }
  void after_step(Frame frame) {
    each([&](FrameRecording& one) { one.after_step(frame); });
  }
  void rolled_back(Frame frame) {
    each([&](FrameRecording& one) { one.rolled_back(frame); });
    tell(ISO_ROLLED_BACK, frame, 0);
  }
  void restarted(Frame frame) {
    each([&](FrameRecording& one) { one.restarted(frame); });
    tell(ISO_RESTARTED, frame, 0);
  }
  void confirmed(Frame frame, std::uint64_t hash) {
    each([&](FrameRecording& one) { one.confirmed(frame, hash); });
    tell(ISO_FRAME_CONFIRMED, frame, hash);
  }
  void tell(std::uint32_t kind, Frame frame, std::uint64_t hash) {
    notice = iso_request{sizeof(iso_request), kind, frame, 0, hash};
  }
};

/// drive(), one request at a time. A turn that the caller leaves in the middle, by an exception of the game's step, is
/// over where the next begins: its requests were not carried out, which the session tells as misuse and makes good.
class SessionTurn {
 public:
  bool is_open() const { return is_open_; }
  /// Returns true while the step that was asked for last is not over.
  bool is_stepping() const { return is_stepping_; }
  const iso_input* inputs() const { return inputs_.data(); }

  void begin(Session<SessionGame>& session, Time now);
  iso_request next(Session<SessionGame>& session, SessionGame& game, SessionObserver& observer);

 private:
  void show(const InputView<Bytes>& inputs);

  std::span<const Request<Bytes>> requests_;
  std::size_t at_ = 0;
  bool is_open_ = false, is_stepping_ = false;
  std::vector<iso_input> inputs_;  // of the step, by player
};

struct SessionObject {
  SessionGame game;
  std::vector<std::uint8_t> file;  // of a replay
  Session<SessionGame> session;
  SessionObserver observer;
  SessionTurn turn;
  char address[kAddressCap + 1] = {};  // that was polled last
  bool is_called = false;              // a function of ours is at work: the game's callbacks may call none
  bool is_broken = false;              // memory was not there in the middle of something
  iso_session_config config;

  SessionObject(const iso_game& its_game, const iso_session_config& its_config, const SessionConfig& rest, Bytes bytes);
};
template <> struct HandleOf<iso_session> {
  using Object = SessionObject;
  static constexpr HandleKind kKind = HandleKind::session;
  static constexpr const char* kName = "session";
};

/// The name of the function that this stands in, without iso_, as sentences have it.
#define ISO_C_CALL (__func__ + 4)

/// Finds the session of a handle, if it may be called now.
iso_status enter(const iso_session* handle, const char* call, SessionObject*& object);

/// Every function that changes a session is called by this; `work(SessionObject&)` returns a status.
template <class Work> iso_status in_session(iso_session* handle, const char* call, const Work& work) {
  SessionObject* object = nullptr;
  if (const iso_status status = enter(handle, call, object); status != ISO_OK) return status;
  object->is_called = true;
  const iso_status status = guarded(call, [&] { return work(*object); });
  object->is_called = false;
  if (status == ISO_NO_MEMORY) object->is_broken = true;
  return status;
}
/// Runs `work`, which returns whether it was done.
template <class Work>
iso_status ask_session(iso_session* handle, const char* call, const char* expected, const Work& work) {
  return in_session(handle, call, [&](SessionObject& object) {
    return work(object.session) ? iso_status{ISO_OK} : refuse(ISO_REFUSED, call, "", expected);
  });
}
/// Checks a struct that is to be filled, whose size the caller has set.
template <class T> iso_status check_struct(const T* out, const char* call) {
  const iso_status status = can_give(out);
  return status == ISO_OK ? status : refuse(status, call, "out");
}
/// Writes, for _init, `defaults` into a struct of the caller's.
template <class T>
iso_status start_struct(const char* call, const std::type_identity_t<T>& defaults, T* out, std::size_t size) {
  const iso_status status = start(defaults, out, size);
  return status == ISO_OK ? status : refuse(status, call, out == nullptr ? "out" : "size");
}
inline bool is_peer(std::uint32_t peer) { return peer <= 0xffff; }

}  // namespace isostep::c
