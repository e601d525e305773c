// Worlds of every scalar, as sessions see them.
// SPDX-License-Identifier: MIT
#include "session_world.hpp"

#include <optional>
#include <utility>

#include "isostep/replay/session_recorder.hpp"
#include "isostep/state/replay_format.hpp"
#include "isostep/store/state.hpp"
#include "isostep/world/world.hpp"
#include "objects.hpp"

namespace isostep::c {
namespace {

template <class S> class WorldRecording final : public FrameRecording {
 public:
  WorldRecording(World<S>& world, std::size_t kept, std::string_view scene)
      : history_(std::in_place, world, HistorySettings{.frames = kept, .states = false}),
        recorder_(*history_, sink_to(file_), scene) {}

  void before_step(Frame frame) override {
    history_->before_step(frame);
    recorder_.before_step(frame);
  }
  void after_step(Frame frame) override { history_->after_step(frame); }
  void rolled_back(Frame frame) override {
    history_->rolled_back(frame);
    recorder_.rolled_back(frame);
  }
  void restarted(Frame frame) override {
    history_->restarted(frame);
    recorder_.restarted(frame);
  }
  void confirmed(Frame frame, std::uint64_t hash) override {
    history_->confirmed(frame, hash);
    recorder_.confirmed(frame, hash);
  }
  Result<void> flush() override { return recorder_.flush(); }
  Result<void> finish() override {
    const Result<void> finished = recorder_.finish();
    history_.reset();  // which listens to the world in the middle of a step too
    return finished;
  }

 private:
  std::optional<FrameHistory<S>> history_;  // until the end
  SessionRecorder<S> recorder_;
};

template <class S> class SessionWorldOf final : public SessionWorld {
 public:
  struct Saved final : Slot {
    typename World<S>::Snapshot state;
  };

  SessionWorldOf(const iso_world* handle, WorldOf<S>& object) : handle_(handle), object_(object) { ++object_.holders; }
  ~SessionWorldOf() override { let_go_of(&object_); }
  SessionWorldOf(const SessionWorldOf&) = delete;
  SessionWorldOf& operator=(const SessionWorldOf&) = delete;

  std::unique_ptr<Slot> make_slot() const override { return std::make_unique<Saved>(); }
  void save(Slot& to) const override { object_.world.save(static_cast<Saved&>(to).state); }
  bool load(const Slot& from) override { return object_.world.load(static_cast<const Saved&>(from).state); }
  std::uint64_t hash() const override { return object_.world.hash(); }
  void write_portable(Writer& writer) const override { object_.world.write_portable(writer); }
  Result<void> read_portable(Reader& reader) override { return object_.world.read_portable(reader); }
  Result<ReplayHeader> identity(std::string_view name) const override {
    return make_replay_header(identity_of_world(object_.world.settings(), name));
  }
  bool is_recorded() const override { return object_.tape != nullptr || object_.keeps_log; }
  std::unique_ptr<FrameRecording> record(std::size_t kept, std::string_view scene) override {
    return std::make_unique<WorldRecording<S>>(object_.world, kept, scene);
  }
  bool is_alive() const override { return Found<iso_world>(handle_, "game.world").object != nullptr; }

 private:
  const iso_world* handle_;
  WorldOf<S>& object_;
};

}  // namespace

std::unique_ptr<SessionWorld> session_world_of(iso_world* world) {
  const Found<iso_world> found(world, "game.world");
  if (found.object == nullptr) return nullptr;
#define ISO_CASE(S)                           \
  if (found.object->scalar == kScalarName<S>) \
    return std::make_unique<SessionWorldOf<S>>(world, static_cast<WorldOf<S>&>(*found.object));
  ISO_FOR_EACH_SCALAR(ISO_CASE)
#undef ISO_CASE
  return nullptr;
}

}  // namespace isostep::c
