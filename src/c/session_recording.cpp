// Sessions in C: recordings of their frames, and matches that are put away.
// SPDX-License-Identifier: MIT
#include "isostep.h"
#include "isostep/session/match_recorder.hpp"
#include "session_handle.hpp"

namespace isostep::c {
namespace {

class MatchRecording final : public FrameRecording {
 public:
  explicit MatchRecording(const iso_session& session) : recorder_(session.session, session.game, sink_to(file_)) {}

  void before_step(Frame frame) override { recorder_.before_step(frame); }
  void after_step(Frame) override {}
  void rolled_back(Frame frame) override { recorder_.rolled_back(frame); }
  void restarted(Frame frame) override { recorder_.restarted(frame); }
  void confirmed(Frame frame, std::uint64_t hash) override { recorder_.confirmed(frame, hash); }
  Result<void> finish() override { return recorder_.finish(); }

 private:
  MatchRecorder<SessionGame> recorder_;
};

std::unique_ptr<FrameRecording> make_recording(iso_session& session, std::uint32_t kind, const char* scene) {
  if (kind == ISO_RECORD_MATCH) return std::make_unique<MatchRecording>(session);
  const auto kept = static_cast<std::size_t>(session.session.config().kept);
  return session.game.world()->record(kept, scene != nullptr ? scene : session.config.name);
}

/// A refusal that says why.
iso_status refuse(iso_session& session, const Error& error) {
  const auto text = ShortText<sizeof session.reason - 1>(error.place.view()).append(": ").append(error.message.view());
  session.reason[text.view().copy(session.reason, sizeof session.reason - 1)] = 0;
  session.problem = session.reason;
  return ISO_REFUSED;
}

}  // namespace
}  // namespace isostep::c

using namespace isostep::c;

extern "C" {

iso_status iso_session_record(iso_session* session, uint32_t kind, const char* scene) {
  if (kind > ISO_RECORD_WORLD) return ISO_BAD_ENUM;
  return call(session, [&](iso_session& one) -> iso_status {
    const bool is_free = one.observer.recordings[kind] == nullptr || one.observer.has_ended[kind];
    if (!is_free) one.problem = "record: a recording of this kind is under way";
    else if (!one.game.has_portable()) one.problem = "record: of a game with write and read";
    else if (kind == ISO_RECORD_WORLD && one.game.world() == nullptr) one.problem = "record: of a game with a world";
    else {
      one.observer.recordings[kind] = make_recording(one, kind, scene);
      one.observer.has_ended[kind] = false;
      return ISO_OK;
    }
    return ISO_REFUSED;
  });
}

iso_status iso_session_recorded(iso_session* session, uint32_t kind, void* bytes, size_t* size) {
  if (size == nullptr) return ISO_NULL;
  if (kind > ISO_RECORD_WORLD) return ISO_BAD_ENUM;
  return call(session, [&](iso_session& one) -> iso_status {
    FrameRecording* const recording = one.observer.recordings[kind].get();
    if (recording == nullptr) {
      one.problem = "recorded: iso_session_record was not called";
      return ISO_REFUSED;
    }
    one.observer.has_ended[kind] = true;
    if (const isostep::Result<void> result = recording->finish(); !result) return refuse(one, result.error());
    return give_bytes(recording->file(), bytes, size);
  });
}

iso_status iso_session_save_match(iso_session* session, void* bytes, size_t* size) {
  if (size == nullptr) return ISO_NULL;
  return call(session, [&](iso_session& one) -> iso_status {
    if (!one.game.has_portable()) {
      one.problem = "save_match: of a game with write and read";
      return ISO_REFUSED;
    }
    std::vector<std::uint8_t> match;
    if (const isostep::Result<void> result = one.session.save_match(one.game, match); !result) {
      return refuse(one, result.error());
    }
    return give_bytes(match, bytes, size);
  });
}
}
