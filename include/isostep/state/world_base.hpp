// WorldBase: what every kind of world has besides what is in it: faults, recording, snapshots, hash, portable form.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "isostep/core/fault.hpp"
#include "isostep/state/archive.hpp"

namespace isostep {

class StageView;  // state/fields.hpp
struct Stepper;   // state/command_log.hpp

/// The parts of a kind of world: its Settings, State, Engine and EveryCommand, its stages, its name in errors.
template <class World> struct WorldParts;

/// A base of World<S> and ParticleWorld<S>. `load(save(w))` brings back ids and future exactly. Bodies:
/// world_base.inl, instantiated with the world.
template <class World> class WorldBase {
  using Parts = WorldParts<World>;

 public:
  using State = typename Parts::State;
  using EveryCommand = typename Parts::EveryCommand;

  const typename Parts::Settings& settings() const;
  std::uint64_t tick() const;

  // Faults.
  /// Why the last call was refused: the rule, the call, the field, and what was expected; `describe` makes a sentence
  /// of it. Commands clear it. Accepted queries and steps leave it.
  const FaultReport& fault() const;
  /// The first refusal since the world was made or told to forget. Refusals come in chains, because what was refused
  /// has no id.
  const FaultReport& first_fault() const;
  void forget_faults();
  /// Refuses on behalf of code that makes things by several calls, as add_ragdoll does. The fault is kept and told as
  /// one of the world's own. Returns false.
  bool refuse(const char* call, const FaultReport& report);
  /// Sets a callback for every refused call from now on. One without a function ends that.
  void set_fault_handler(const FaultHandler& handler);

  // Recording.
  /// Appends every accepted command and every step from now on to `log` (null: to nothing). The caller clears it every
  /// frame. Loading keeps it.
  void record_to(std::vector<std::uint8_t>* log);
  bool records_to(const std::vector<std::uint8_t>* log) const;
  /// Plays a frame's commands and steps as `record_to` wrote them. More than kFrameStepCap steps are an error.
  /// `stepper`, if given, takes the steps in place of `step`.
  Result<void> step_recorded(Bytes input);
  Result<void> step_recorded(Bytes input, const Stepper& stepper);
  /// From now on appends the state's hash to `hashes` as a step begins and after each of its stages (null: to nothing).
  /// It narrows desyncs down, and costs a hash a stage.
  void trace_to(std::vector<std::uint64_t>* hashes);
  /// The number of times that the world was loaded or read. Commands alone do not lead across that: a WorldRecorder
  /// ends there, and a session's recording or bundle (frame_history.hpp) cannot play a frame with one inside.
  std::uint64_t loads() const;

  // State.
  class Snapshot {
   public:
    Snapshot();
    ~Snapshot();
    Snapshot(Snapshot&& other) noexcept;
    Snapshot& operator=(Snapshot&& other) noexcept;
    /// [bytes] The size of what it holds for itself. It does not count what it shares with the world and other
    /// snapshots until it changes: in a World sleeping islands, static bodies, shapes and tables of slots; in both
    /// kinds records that only commands change.
    std::size_t bytes() const;

   private:
    friend class WorldBase;
    std::unique_ptr<State> state_;
  };
  void save(Snapshot& to) const;
  /// Loads a saved state. Returns false, with no change and a fault, if `from` was
  /// never saved to, was moved from, or is of a world that was made with other
  /// settings; gravity may differ. The portable form brings its settings along.
  bool load(const Snapshot& from);
  std::uint64_t hash() const;
  void write_portable(Writer& writer) const;
  Result<void> read_portable(Reader& reader);
  /// The arrays behind the world, for tools that compare, describe and measure.
  const State& state() const;
  /// The state field by field, by name: what an observer of stages gets, without what a stage leaves.
  StageView state_fields() const;

 protected:
  explicit WorldBase(const typename Parts::Settings& settings);
  ~WorldBase();
  /// Leaves `other` empty, with its settings, and as usable as a new one. Recording and tracing end, because whoever
  /// does them refers to `other`.
  WorldBase(WorldBase&& other) noexcept;
  WorldBase& operator=(WorldBase&& other) noexcept;

  std::unique_ptr<typename Parts::Engine> engine_;
};

}  // namespace isostep
