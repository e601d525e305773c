// Recordings that grow: a world's commands, steps and hashes as the bytes of a replay.
// SPDX-License-Identifier: MIT
#include "isostep/replay/recorder.hpp"
#include "objects.hpp"

using namespace isostep;
using namespace isostep::c;

namespace {

template <class S> class WriterOf final : public TapeWriter {
 public:
  WriterOf(World<S>& world, std::vector<std::uint8_t>& file) : recorder_(world, sink_to(file)) {}
  Result<void> begin(std::string_view scene) { return recorder_.begin(scene); }
  Result<void> end_frame() override { return recorder_.end_frame(); }
  Result<void> keyframe() override { return recorder_.keyframe(); }
  Result<void> flush() override { return recorder_.flush(); }
  Result<void> finish() override { return recorder_.finish(); }

 private:
  WorldRecorder<S> recorder_;
};

/// work(TapeObject&) for a tape that records; its errors are of what the game did.
template <class Work> iso_status on_tape(iso_tape* tape, const char* call, const Work& work) {
  return guarded(call, [&] {
    const Found<iso_tape> found(tape, call);
    if (found.status != kOk) return found.status;
    if (found.object->writer == nullptr) return refuse(kMisused, call, "tape", "a tape that records a world");
    if (found.object->world->inside != 0) return refuse(ISO_CALLED_BACK, call);
    const Result<void> done = work(*found.object);
    return done ? kOk : refuse(kMisused, call, done.error());
  });
}

}  // namespace

iso_status iso_tape_create(iso_tape** out) {
  return guarded("tape_create", [&] {
    ISO_C_REQUIRE("tape_create", out);
    auto made = std::make_unique<TapeObject>();
    *out = open_handle<iso_tape>(made.get());
    made.release();
    return kOk;
  });
}
iso_status iso_tape_destroy(iso_tape* tape) { return destroy_handle(tape, "tape_destroy"); }

iso_status iso_world_record(iso_world* world, iso_tape* tape, const char* scene) {
  constexpr const char* kCall = "world_record";
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    ISO_C_REQUIRE(kCall, scene);
    const Found<iso_tape> found(tape, kCall);
    if (found.status != kOk) return found.status;
    if (found.object->used) return refuse(kMisused, kCall, "tape", "a tape that has recorded nothing");
    if (of.tape != nullptr || of.keeps_log) {
      return refuse(kMisused, kCall, "world", "a world without a tape that keeps no log");
    }
    using S = typename std::remove_reference_t<decltype(of.world)>::Scalar;
    auto writer = std::make_unique<WriterOf<S>>(of.world, found.object->file);
    const Result<void> begun = writer->begin(scene);
    if (!begun) {
      writer.reset();
      found.object->file.clear();
      return refuse(kMisused, kCall, begun.error());
    }
    found.object->writer = std::move(writer);
    found.object->used = true;
    found.object->world = &of;
    of.tape = found.object;
    return kOk;
  });
}

iso_status iso_tape_end_frame(iso_tape* tape) {
  return on_tape(tape, "tape_end_frame", [](TapeObject& of) { return of.writer->end_frame(); });
}
iso_status iso_tape_keyframe(iso_tape* tape) {
  return on_tape(tape, "tape_keyframe", [](TapeObject& of) { return of.writer->keyframe(); });
}
iso_status iso_tape_flush(iso_tape* tape) {
  return on_tape(tape, "tape_flush", [](TapeObject& of) { return of.writer->flush(); });
}
iso_status iso_tape_finish(iso_tape* tape) {
  return on_tape(tape, "tape_finish", [](TapeObject& of) {
    const Result<void> done = of.writer->finish();
    of.let_go();
    return done;
  });
}

iso_status iso_tape_bytes(const iso_tape* tape, const void** bytes, size_t* size) {
  constexpr const char* kCall = "tape_bytes";
  const Found<iso_tape> found(tape, kCall);
  if (found.status != kOk) return found.status;
  ISO_C_REQUIRE(kCall, bytes);
  ISO_C_REQUIRE(kCall, size);
  *bytes = found.object->file.data();
  *size = found.object->file.size();
  return kOk;
}
iso_status iso_tape_drop_bytes(iso_tape* tape) {
  const Found<iso_tape> found(tape, "tape_drop_bytes");
  if (found.status == kOk) found.object->file.clear();
  return found.status;
}
