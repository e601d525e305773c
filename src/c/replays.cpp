// Recordings that are read: what they are, whether they come out here, and their frames.
// SPDX-License-Identifier: MIT
#include "isostep/core/scalars.hpp"
#include "isostep/replay/recorder.hpp"
#include "isostep/replay/replay_check.hpp"
#include "objects.hpp"

using namespace isostep;
using namespace isostep::c;

namespace {

template <std::size_t N> void copy_text_member(char (&to)[N], std::string_view text) {
  copy_member(to, N, text.data(), text.size());
}

VerifyOutcome outcome_of(ReplayStatus status) {
  switch (status) {
    case ReplayStatus::complete: return VerifyOutcome::verified;
    case ReplayStatus::truncated: return VerifyOutcome::truncated;
    case ReplayStatus::incompatible: return VerifyOutcome::incompatible;
    case ReplayStatus::corrupt: break;
  }
  return VerifyOutcome::corrupt;
}

CReplayInfo info_of(const ReplayReader& reader) {
  CReplayInfo info;
  info.file = outcome_of(reader.status());
  info.frames = reader.frame_count();
  info.keyframes = reader.keyframes().size();
  info.has_state = reader.has_state();
  if (reader.has_state()) info.start_hash = reader.state_hash();
  if (!reader.has_header()) return info;
  const Result<std::uint64_t> first = reader.header().number(kFirstFrameKey);
  if (first) info.first_frame = first.value();
  const Result<ReplayIdentity> identity = identity_of(reader.header());
  if (!identity) return info;
  info.behaviour = identity.value().behaviour;
  info.hz = identity.value().hz;
  info.substeps = identity.value().substeps;
  copy_text_member(info.scalar, identity.value().scalar);
  copy_text_member(info.scene, identity.value().scene);
  copy_text_member(info.world, identity.value().world);
  copy_text_member(info.engine, identity.value().engine);
  return info;
}

iso_status check_file(const char* call, const void* bytes, std::size_t size, Bytes& file) {
  ISO_C_REQUIRE(call, bytes);
  file = Bytes(static_cast<const std::uint8_t*>(bytes), size);
  return has_replay_magic(file) ? kOk : refuse(ISO_CORRUPT, call, "bytes", "the beginning of a replay");
}

template <class S> iso_status create_world(const ReplayReader& reader, const char* call, iso_world** out) {
  auto made = std::make_unique<WorldOf<S>>(Settings<S>{});
  Reader start(reader.state());
  Result<void> read = made->world.read_portable(start);
  if (read) {
    start.expect_end();
    read = start.result("INIT");
  }
  if (!read) return refuse(ISO_CORRUPT, call, read.error());
  *out = open_handle<iso_world>(made.get());
  made.release();
  return kOk;
}

}  // namespace

iso_status iso_replay_about(const void* bytes, size_t size, iso_replay_info* out) {
  constexpr const char* kCall = "replay_about";
  return guarded(kCall, [&] {
    Bytes file;
    const iso_status status = check_file(kCall, bytes, size, file);
    return status == kOk ? put_sized(kCall, out, info_of(ReplayReader(file))) : status;
  });
}

iso_status iso_replay_verify(const void* bytes, size_t size, iso_simd simd, uint64_t most_frames,
                             iso_replay_result* out) {
  constexpr const char* kCall = "replay_verify";
  return guarded(kCall, [&] {
    if (size != 0) ISO_C_REQUIRE(kCall, bytes);
    if (simd >= Enumerators<Simd>::kCount) return refuse(ISO_BAD_ENUM, kCall, "simd");
    const iso_status writable = put_sized(kCall, out, CReplayResult{});
    if (writable != kOk) return writable;
    ReplayCheck check;
    check.simd = static_cast<Simd>(simd);
    check.span.count = most_frames;
    const CheckedReplay checked = check_replay({static_cast<const std::uint8_t*>(bytes), size}, check);
    CReplayResult told;
    told.outcome = checked.result.outcome;
    told.where = checked.result.where;
    told.frames = checked.result.frames;
    told.expected = checked.result.expected;
    told.actual = checked.result.actual;
    told.offset = checked.result.offset;
    copy_text_member(told.scalar, checked.scalar);
    copy_text_member(told.scene, checked.scene);
    copy_text_member(told.lanes, checked.lanes);
    copy_text_member(told.text, describe(checked.result));
    return put_sized(kCall, out, told);
  });
}

iso_status iso_replay_open(const void* bytes, size_t size, iso_replay** out) {
  constexpr const char* kCall = "replay_open";
  return guarded(kCall, [&] {
    ISO_C_REQUIRE(kCall, out);
    *out = nullptr;
    Bytes file;
    const iso_status status = check_file(kCall, bytes, size, file);
    if (status != kOk) return status;
    auto made = std::make_unique<ReplayObject>(file);
    const ReplayStatus is = made->reader.status();
    if (is != ReplayStatus::complete && is != ReplayStatus::truncated) {
      return refuse(ISO_CORRUPT, kCall, made->reader.error());
    }
    *out = open_handle<iso_replay>(made.get());
    made.release();
    return kOk;
  });
}
iso_status iso_replay_destroy(iso_replay* replay) { return destroy_handle(replay, "replay_destroy"); }

iso_status iso_replay_get_info(const iso_replay* replay, iso_replay_info* out) {
  const Found<iso_replay> found(replay, "replay_get_info");
  return found.status != kOk ? found.status : put_sized("replay_get_info", out, info_of(found.object->reader));
}

iso_status iso_replay_create_world(const iso_replay* replay, iso_world** out) {
  constexpr const char* kCall = "replay_create_world";
  return guarded(kCall, [&] {
    const Found<iso_replay> found(replay, kCall);
    if (found.status != kOk) return found.status;
    ISO_C_REQUIRE(kCall, out);
    *out = nullptr;
    const ReplayReader& reader = found.object->reader;
    const CReplayInfo info = info_of(reader);
    if (!reader.has_state()) return refuse(ISO_CORRUPT, kCall, "replay", "a start");
    if (info.world[0] != '\0') return refuse(ISO_CORRUPT, kCall, "replay", "a world of rigid bodies");
    iso_status status = ISO_NO_SCALAR;
    const bool known = with_scalar(
        info.scalar, [&](auto tag) { status = create_world<typename decltype(tag)::Type>(reader, kCall, out); });
    return known ? status : refuse(ISO_NO_SCALAR, kCall, "replay");
  });
}

iso_status iso_replay_get_frame(const iso_replay* replay, uint64_t frame, const void** commands, size_t* size,
                                uint64_t* hash) {
  constexpr const char* kCall = "replay_get_frame";
  const Found<iso_replay> found(replay, kCall);
  if (found.status != kOk) return found.status;
  ISO_C_REQUIRE(kCall, commands);
  ISO_C_REQUIRE(kCall, size);
  ISO_C_REQUIRE(kCall, hash);
  if (frame >= found.object->reader.frame_count()) return refuse(kMisused, kCall, "frame", "one of the replay's");
  const ReplayFrame read = found.object->reader.frame(frame);
  *commands = read.input.data();
  *size = read.input.size();
  *hash = read.hash;
  return kOk;
}
