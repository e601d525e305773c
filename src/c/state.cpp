// Snapshots, the portable form, commands as bytes, and the trace of stages.
// SPDX-License-Identifier: MIT
#include "objects.hpp"

using namespace isostep;
using namespace isostep::c;

namespace {

/// Runs work(WorldOf<S>&, SnapshotOf<S>&) for a snapshot of the world's scalar.
template <class Work>
iso_status with_snapshot(const iso_world* world, const iso_snapshot* snapshot, const char* call, Access access,
                         const Work& work) {
  return in_any_world(world, call, access, [&](auto& of) {
    const Found<iso_snapshot> found(snapshot, call);
    if (found.status != kOk) return found.status;
    if (found.object->scalar != of.scalar) return refuse(ISO_WRONG_SCALAR, call, "snapshot");
    using S = typename std::remove_reference_t<decltype(of.world)>::Scalar;
    work(of, static_cast<SnapshotOf<S>&>(*found.object));
    return kOk;
  });
}

/// A pointer into one of the world's own lists.
template <class T, class To>
iso_status point_to(const char* call, const std::vector<T>& list, const To** out, std::size_t* count) {
  ISO_C_REQUIRE(call, out);
  ISO_C_REQUIRE(call, count);
  *out = list.data();
  *count = list.size();
  return kOk;
}

}  // namespace

iso_status iso_snapshot_create(const iso_world* like, iso_snapshot** out) {
  constexpr const char* kCall = "snapshot_create";
  return in_any_world(like, kCall, Access::reads, [&](auto& of) {
    ISO_C_REQUIRE(kCall, out);
    using S = typename std::remove_reference_t<decltype(of.world)>::Scalar;
    auto made = std::make_unique<SnapshotOf<S>>();
    *out = open_handle<iso_snapshot>(made.get());
    made.release();
    return kOk;
  });
}
iso_status iso_snapshot_destroy(iso_snapshot* snapshot) { return destroy_handle(snapshot, "snapshot_destroy"); }

iso_status iso_snapshot_get_size(const iso_snapshot* snapshot, size_t* out) {
  constexpr const char* kCall = "snapshot_get_size";
  const Found<iso_snapshot> found(snapshot, kCall);
  if (found.status != kOk) return found.status;
  ISO_C_REQUIRE(kCall, out);
#define ISO_SIZE(S) \
  if (found.object->scalar == kScalarName<S>) *out = static_cast<SnapshotOf<S>*>(found.object)->snapshot.bytes();
  ISO_FOR_EACH_SCALAR(ISO_SIZE)
#undef ISO_SIZE
  return kOk;
}

iso_status iso_world_save(const iso_world* world, iso_snapshot* to) {
  return with_snapshot(world, to, "world_save", Access::reads,
                       [](auto& of, auto& snapshot) { of.world.save(snapshot.snapshot); });
}
iso_status iso_world_load(iso_world* world, const iso_snapshot* from) {
  return with_snapshot(world, from, "world_load", Access::changes,
                       [](auto& of, auto& snapshot) { of.world.load(snapshot.snapshot); });
}

iso_status iso_world_write(const iso_world* world, void* bytes, size_t* size) {
  constexpr const char* kCall = "world_write";
  return in_any_world(world, kCall, Access::reads, [&](auto& of) {
    std::vector<std::uint8_t> written;
    Writer writer(written);
    of.world.write_portable(writer);
    return copy_out(kCall, written.data(), written.size(), bytes, size);
  });
}
iso_status iso_world_read(iso_world* world, const void* bytes, size_t size) {
  constexpr const char* kCall = "world_read";
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    if (size != 0) ISO_C_REQUIRE(kCall, bytes);
    Reader reader(Bytes(static_cast<const std::uint8_t*>(bytes), size));
    // The state is read aside first: bytes behind it are an error too, and the world stays as it was.
    std::remove_reference_t<decltype(of.world)> aside(of.world.settings());
    of.use_assets_of(aside);
    Result<void> read = aside.read_portable(reader);
    if (read) {
      reader.expect_end();
      read = reader.result("state");
    }
    if (!read) return refuse(ISO_CORRUPT, kCall, read.error());
    Reader again(Bytes(static_cast<const std::uint8_t*>(bytes), size));
    read = of.world.read_portable(again);
    return read ? kOk : refuse(ISO_CORRUPT, kCall, read.error());
  });
}

iso_status iso_world_apply(iso_world* world, const void* commands, size_t size) {
  constexpr const char* kCall = "world_apply";
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    if (size != 0) ISO_C_REQUIRE(kCall, commands);
    const Inside inside(of, WorldObject::kSteps);
    const Result<void> applied = of.world.step_recorded({static_cast<const std::uint8_t*>(commands), size});
    return applied ? kOk : refuse(ISO_CORRUPT, kCall, applied.error());
  });
}

iso_status iso_world_keep_log(iso_world* world, uint8_t on) {
  constexpr const char* kCall = "world_keep_log";
  if (on > 1) return refuse(ISO_BAD_ENUM, kCall, "on");
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    if (of.tape != nullptr) return refuse(kMisused, kCall, "world", "a world that no tape records");
    of.world.record_to(on == 1 ? &of.log : nullptr);
    of.keeps_log = on == 1;
    return kOk;
  });
}
iso_status iso_world_log(const iso_world* world, const void** bytes, size_t* size) {
  constexpr const char* kCall = "world_log";
  WorldObject* object = nullptr;
  const iso_status status = enter(world, kCall, Access::reads, object);
  if (status != kOk) return status;
  ISO_C_REQUIRE(kCall, bytes);
  ISO_C_REQUIRE(kCall, size);
  *bytes = object->log.data();
  *size = object->log.size();
  return kOk;
}
iso_status iso_world_clear_log(iso_world* world) {
  WorldObject* object = nullptr;
  const iso_status status = enter(world, "world_clear_log", Access::changes, object);
  if (status == kOk) object->log.clear();
  return status;
}

iso_status iso_world_trace(iso_world* world, uint8_t on) {
  if (on > 1) return refuse(ISO_BAD_ENUM, "world_trace", "on");
  return in_any_world(world, "world_trace", Access::changes, [&](auto& of) {
    of.world.trace_to(on == 1 ? &of.stage_hashes : nullptr);
    return kOk;
  });
}
iso_status iso_world_stage_hashes(const iso_world* world, const uint64_t** hashes, size_t* count) {
  WorldObject* object = nullptr;
  const iso_status status = enter(world, "world_stage_hashes", Access::reads, object);
  return status != kOk ? status : point_to("world_stage_hashes", object->stage_hashes, hashes, count);
}
iso_status iso_world_clear_trace(iso_world* world) {
  WorldObject* object = nullptr;
  const iso_status status = enter(world, "world_clear_trace", Access::changes, object);
  if (status == kOk) object->stage_hashes.clear();
  return status;
}
