// Sessions in C: recordings of their frames, and matches that are put away.
// SPDX-License-Identifier: MIT
#include "isostep/session/observers/match_recorder.hpp"
#include "session_handle.hpp"

namespace isostep::c {
namespace {

class MatchRecording final : public FrameRecording {
 public:
  explicit MatchRecording(const SessionObject& session) : recorder_(session.session, session.game, sink_to(file_)) {}

  void before_step(Frame frame) override { recorder_.before_step(frame); }
  void after_step(Frame) override {}
  void rolled_back(Frame frame) override { recorder_.rolled_back(frame); }
  void restarted(Frame frame) override { recorder_.restarted(frame); }
  void confirmed(Frame frame, std::uint64_t hash) override { recorder_.confirmed(frame, hash); }
  Result<void> flush() override { return recorder_.flush(); }
  Result<void> finish() override { return recorder_.finish(); }

 private:
  MatchRecorder<SessionGame> recorder_;
};

/// Requires that no turn is under way: states are missing in the middle of one.
iso_status require_no_turn(const SessionObject& session, const char* call) {
  return session.turn.is_open() ? refuse(ISO_UNFINISHED, call) : iso_status{ISO_OK};
}

std::unique_ptr<FrameRecording> make_recording(SessionObject& session, std::uint32_t kind, const char* scene) {
  if (kind == ISO_RECORD_MATCH) return std::make_unique<MatchRecording>(session);
  const auto kept = static_cast<std::size_t>(session.session.config().kept);
  return session.game.world()->record(kept, scene != nullptr ? scene : session.config.name);
}

}  // namespace
}  // namespace isostep::c

using namespace isostep::c;

extern "C" {

iso_status iso_session_record(iso_session* session, iso_recording kind, const char* scene) {
  if (kind > ISO_RECORD_WORLD) return refuse(ISO_BAD_ENUM, ISO_C_CALL, "kind");
  return in_session(session, ISO_C_CALL, [&, call = ISO_C_CALL](SessionObject& one) -> iso_status {
    if (const iso_status status = require_no_turn(one, call); status != ISO_OK) return status;
    const SessionObserver& observer = one.observer;
    const bool is_free = observer.recordings[kind] == nullptr || observer.has_ended[kind];
    if (!is_free) return refuse(ISO_REFUSED, call, "kind", "one that is not being recorded");
    if (!one.game.has_portable()) return refuse(ISO_REFUSED, call, "", "a game with write and read");
    if (kind == ISO_RECORD_WORLD && (one.game.world() == nullptr || one.game.world()->is_recorded())) {
      return refuse(ISO_REFUSED, call, "kind", "a game with a world that nothing else records");
    }
    one.observer.recordings[kind] = make_recording(one, kind, scene);
    one.observer.has_ended[kind] = false;
    return ISO_OK;
  });
}

iso_status iso_session_flush_recording(iso_session* session, iso_recording kind, const void** bytes, size_t* size) {
  ISO_C_REQUIRE(ISO_C_CALL, bytes);
  ISO_C_REQUIRE(ISO_C_CALL, size);
  *bytes = nullptr;
  *size = 0;
  if (kind > ISO_RECORD_WORLD) return refuse(ISO_BAD_ENUM, ISO_C_CALL, "kind");
  return in_session(session, ISO_C_CALL, [&, call = ISO_C_CALL](SessionObject& one) -> iso_status {
    FrameRecording* const recording = one.observer.recordings[kind].get();
    if (recording == nullptr) return refuse(ISO_REFUSED, call, "kind", "one that iso_session_record began");
    if (const isostep::Result<void> result = recording->flush(); !result) {
      return refuse(ISO_REFUSED, call, result.error());
    }
    const isostep::Bytes news = recording->show_news();
    *bytes = news.data();
    *size = news.size();
    return ISO_OK;
  });
}

iso_status iso_session_recorded(iso_session* session, iso_recording kind, void* bytes, size_t* size) {
  ISO_C_REQUIRE(ISO_C_CALL, size);
  if (kind > ISO_RECORD_WORLD) return refuse(ISO_BAD_ENUM, ISO_C_CALL, "kind");
  return in_session(session, ISO_C_CALL, [&, call = ISO_C_CALL](SessionObject& one) -> iso_status {
    FrameRecording* const recording = one.observer.recordings[kind].get();
    if (recording == nullptr) return refuse(ISO_REFUSED, call, "kind", "one that iso_session_record began");
    one.observer.has_ended[kind] = true;
    if (const isostep::Result<void> result = recording->finish(); !result) {
      return refuse(ISO_REFUSED, call, result.error());
    }
    return copy_out(call, recording->file().data(), recording->file().size(), bytes, size);
  });
}

iso_status iso_session_save_match(iso_session* session, void* bytes, size_t* size) {
  ISO_C_REQUIRE(ISO_C_CALL, size);
  return in_session(session, ISO_C_CALL, [&, call = ISO_C_CALL](SessionObject& one) -> iso_status {
    if (const iso_status status = require_no_turn(one, call); status != ISO_OK) return status;
    if (!one.game.has_portable()) return refuse(ISO_REFUSED, call, "", "a game with write and read");
    std::vector<std::uint8_t> match;
    if (const isostep::Result<void> result = one.session.save_match(one.game, match); !result) {
      return refuse(ISO_REFUSED, call, result.error());
    }
    return copy_out(call, match.data(), match.size(), bytes, size);
  });
}
}
