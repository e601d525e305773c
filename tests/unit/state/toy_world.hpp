// A toy world with a closed list of commands, for the tests of command logs and of what records them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "isostep/state/command_recorder.hpp"
#include "isostep/state/world_desk.hpp"
#include "recording.hpp"

namespace toy {

struct Push {
  std::uint32_t to;
  Q32_32 by;
  ISO_FIELDS(to, by)
};
struct Clear {
  ISO_FIELDS()
};
inline constexpr std::uint32_t kFillCap = 5;
struct Fill {
  std::vector<std::uint16_t> numbers;

  void write(Writer& writer) const { writer.write_array(numbers); }
  void read(Reader& reader) { reader.read_array(numbers, kFillCap); }
};
using ToyCommand = std::variant<Push, Clear, Fill>;
using EveryToyCommand = CommandTypes<void, Push, Clear, Fill>;

struct ToySettings {
  std::uint32_t hz = 30;
};
inline ReplayIdentity identity_of_world(const ToySettings& settings, std::string_view scene) {
  ReplayIdentity here = identity();
  here.hz = settings.hz;
  here.scene = scene;
  here.world = "toys";
  return here;
}

enum class ToyStage : std::uint32_t { count, fold };
inline constexpr const char* kToyStages[] = {"count", "fold"};
struct ToyObserver {
  void (*after)(void* user, ToyStage stage) = nullptr;
  void* user = nullptr;
};

/// A sum that every command and step changes.
class ToyWorld {
 public:
  using Scalar = Q32_32;
  using EveryCommand = EveryToyCommand;
  struct State {
    std::uint64_t tick = 0, sum = 0;
    ISO_FIELDS(tick, sum)
  };
  using Snapshot = State;

  const ToySettings& settings() const { return settings_; }
  const State& state() const { return state_; }
  std::uint64_t tick() const { return state_.tick; }
  std::uint64_t loads() const { return desk_->journal.loads(); }
  void record_to(Buffer* log) { desk_->journal.record_to(log); }
  bool records_to(const Buffer* log) const { return desk_->journal.records_to(log); }
  void trace_to(std::vector<std::uint64_t>* hashes) { desk_->trace = hashes; }

  bool apply(const ToyCommand& command) {
    return std::visit([&](const auto& one) { return desk_->run("apply", *this, one); }, command);
  }
  bool execute(const Push& push) { return set_sum(state_.sum + (push.to ^ to_bits(push.by))); }
  bool execute(const Clear&) { return set_sum(0); }
  bool execute(const Fill& fill) {
    for (const std::uint16_t number : fill.numbers) set_sum(3 * state_.sum + number);
    return true;
  }
  void step(const ToyObserver& observer = {}) {
    desk_->journal.record_step();
    desk_->note_hash(*this);
    ++state_.tick;
    after(observer, ToyStage::count);
    state_.sum = state_.sum * 31 + state_.tick;
    after(observer, ToyStage::fold);
  }
  std::uint64_t hash() const { return state_.sum ^ state_.tick << 32; }
  void save(Snapshot& to) const { to = state_; }
  void load(const Snapshot& from) {
    state_ = from;
    desk_->note_load();
  }
  void write_portable(Writer& writer) const { writer.write(state_); }
  Result<void> read_portable(Reader& reader) {
    const auto state = reader.read<State>();
    if (reader.ok()) load(state);
    return reader.result("toy world");
  }
  Result<void> step_recorded(Bytes commands) {
    return step_recorded(commands, {[](void* world) { static_cast<ToyWorld*>(world)->step(); }, this});
  }
  Result<void> step_recorded(Bytes commands, const Stepper& stepper) {
    return play_commands<EveryCommand>(
        commands, [&](const ToyCommand& command) { return apply(command); }, [&] { stepper.step(stepper.user); });
  }

 private:
  bool set_sum(std::uint64_t sum) {
    state_.sum = sum;
    return true;
  }
  void after(const ToyObserver& observer, ToyStage stage) {
    desk_->note_hash(*this);
    if (observer.after != nullptr) observer.after(observer.user, stage);
  }

  ToySettings settings_;
  State state_;
  std::unique_ptr<WorldDesk> desk_ = std::make_unique<WorldDesk>();  // so that the world can be moved
};
static_assert(RecordableWorld<ToyWorld> && !RecordableWorld<Game>);

}  // namespace toy
