// The objects behind handles.
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "convert.hpp"
#include "handle.hpp"
#include "isostep/geometry/blob.hpp"
#include "isostep/state/replay_format.hpp"
#include "isostep/world/world.hpp"

namespace isostep::c {

struct TapeObject;

/// A world of any scalar. It is destroyed as its WorldOf.
struct WorldObject {
  /// The values of `inside`: the world steps, or so many batches of queries run, and the game's threads may call back.
  static constexpr std::uint32_t kSteps = 1, kBatch = 2;

  explicit WorldObject(ScalarName of) : scalar(of) {}
  virtual ~WorldObject();

  const ScalarName scalar;
  std::atomic<std::uint32_t> holders = 1;  // its handle, and the sessions that play it
  std::atomic<std::uint32_t> inside = 0;
  TapeObject* tape = nullptr;  // that records it
  bool keeps_log = false;
  std::vector<std::uint8_t> log;
  std::vector<std::uint64_t> stage_hashes;
  std::vector<BlobRef> assets;
  /// Makes `world`, of any scalar, find these assets. This object outlives it.
  template <class World> void use_assets_of(World& world) { world.use_assets({find_asset, this}); }
  static BlobRef find_asset(void* user, const ContentId& id);
  /// The events of the last step in C's layout, each kind in a list of its own; whole words, so that ids are aligned.
  static constexpr int kEventKinds = 10;
  std::vector<std::uint64_t> events[kEventKinds];
  std::vector<std::uint64_t> poses;
};
template <class S> struct WorldOf : WorldObject {
  explicit WorldOf(const Settings<S>& settings) : WorldObject(kScalarName<S>), world(settings) {
    world.set_fault_handler(refusal_handler());
  }
  World<S> world;
};

/// Gives up one holder; the last one takes the world along.
inline void let_go_of(WorldObject* object) {
  if (object->holders.fetch_sub(1) == 1) delete object;
}

struct SnapshotObject {
  explicit SnapshotObject(ScalarName of) : scalar(of) {}
  virtual ~SnapshotObject();
  const ScalarName scalar;
};
template <class S> struct SnapshotOf : SnapshotObject {
  SnapshotOf() : SnapshotObject(kScalarName<S>) {}
  typename World<S>::Snapshot snapshot;
};

struct BlobObject {
  BlobRef blob;
};

/// A replay: the file and the recording read from it.
struct ReplayObject {
  explicit ReplayObject(Bytes file) : bytes(file.begin(), file.end()), reader(bytes) {}
  std::vector<std::uint8_t> bytes;
  ReplayReader reader;
};

/// The writer of a recording, of a world of any scalar.
class TapeWriter {
 public:
  virtual ~TapeWriter();
  virtual Result<void> end_frame() = 0;
  virtual Result<void> keyframe() = 0;
  virtual Result<void> flush() = 0;
  virtual Result<void> finish() = 0;
};
struct TapeObject {
  ~TapeObject() { let_go(); }
  /// Ends the recording of the world.
  void let_go() {
    writer.reset();
    if (world != nullptr) world->tape = nullptr;
    world = nullptr;
  }
  std::vector<std::uint8_t> file;
  bool used = false;  // a tape records once
  WorldObject* world = nullptr;
  std::unique_ptr<TapeWriter> writer;  // while it records
};

#define ISO_C_HANDLE(Handle, Type, kind_)                  \
  template <> struct HandleOf<Handle> {                    \
    using Object = Type;                                   \
    static constexpr HandleKind kKind = HandleKind::kind_; \
    static constexpr const char* kName = #kind_;           \
  };
ISO_C_HANDLE(iso_world, WorldObject, world)
ISO_C_HANDLE(iso_snapshot, SnapshotObject, snapshot)
ISO_C_HANDLE(iso_blob, BlobObject, blob)
ISO_C_HANDLE(iso_tape, TapeObject, tape)
ISO_C_HANDLE(iso_replay, ReplayObject, replay)
#undef ISO_C_HANDLE

// ---- Calls

/// The access of a call to the world.
enum class Access : std::uint32_t { reads, changes };

/// Finds the world of a handle, if it may be called now.
iso_status enter(const iso_world* handle, const char* call, Access access, WorldObject*& object);

/// Runs `work` and turns a refusal of the world meanwhile into the status.
template <class S, class Work> iso_status run_in(WorldObject& object, const char* call, const Work& work) {
  Refusal& refusal = refusal_here();
  refusal.happened = false;
  const iso_status status = guarded(call, [&] { return work(static_cast<WorldOf<S>&>(object)); });
  return refusal.happened && status == kOk ? refuse(refusal.report) : status;
}

/// Runs work(WorldOf<S>&), which returns a status; a refusal of the world meanwhile becomes the call's.
template <class S, class Work>
iso_status in_world(const iso_world* handle, const char* call, Access access, const Work& work) {
  WorldObject* object = nullptr;
  const iso_status status = enter(handle, call, access, object);
  if (status != kOk) return status;
  if constexpr (kIsBuilt<S>) {
    if (object->scalar == kScalarName<S>) return run_in<S>(*object, call, work);
  } else {
    return refuse(ISO_NO_SCALAR, call);
  }
  return refuse(ISO_WRONG_SCALAR, call);
}

/// in_world() for a world of any scalar.
template <class Work>
iso_status in_any_world(const iso_world* handle, const char* call, Access access, const Work& work) {
  WorldObject* object = nullptr;
  const iso_status status = enter(handle, call, access, object);
  if (status != kOk) return status;
#define ISO_CASE(S) \
  if (object->scalar == kScalarName<S>) return run_in<S>(*object, call, work);
  ISO_FOR_EACH_SCALAR(ISO_CASE)
#undef ISO_CASE
  return refuse(ISO_NOT_ALIVE, call);
}

/// Marks, while it lives, that the game's threads may call back.
class Inside {
 public:
  Inside(WorldObject& object, std::uint32_t what) : object_(object), what_(what) { object_.inside += what_; }
  ~Inside() { object_.inside -= what_; }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

 private:
  WorldObject& object_;
  std::uint32_t what_;
};

/// The status of a call that may not be made now, which is no fault of the world's.
inline constexpr iso_status kMisused = ISO_FAULT_BAD_ARGUMENT;

/// Puts as many of `all` as there is room for, and their number.
template <class T>
iso_status put_list(const char* call, const std::vector<T>& all, void* out, std::size_t room, std::size_t* count) {
  ISO_C_REQUIRE(call, count);
  *count = all.size();
  const std::size_t many = all.size() < room ? all.size() : room;
  if (many != 0) ISO_C_REQUIRE(call, out);
  for (std::size_t i = 0; i < many; ++i) put_plain(static_cast<std::uint8_t*>(out) + i * extent_of<T>().size, all[i]);
  return many < all.size() ? refuse(ISO_SMALL_BUFFER, call, "room") : kOk;
}
/// Hands out an id that a world gave; where it gave none it has said why.
template <class IdType> iso_status put_id(IdType id, std::uint64_t* out) {
  *out = id_bits(id);
  return kOk;
}

}  // namespace isostep::c
