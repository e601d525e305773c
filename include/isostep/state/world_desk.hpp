// WorldDesk: how calls enter a world, and what is kept of them: faults of what was refused, a command log of what was
// accepted, hashes of the state from stage to stage.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/exclusive_call.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/state/command_journal.hpp"

namespace isostep {

/// The engine of each world has one. It is no part of the state: it is not saved, loaded or hashed.
struct WorldDesk {
  OneAtATime entry;
  FaultLog faults;
  CommandJournal journal;
  std::vector<std::uint64_t>* trace = nullptr;  // gets the state's hash as a step begins and after each of its stages

  ISO_INLINE ExclusiveCall enter(const char* name) { return {entry, faults, name}; }

  /// Executes a command of the closed list Executor::EveryCommand. Returns what `execute` returns: the id of what was
  /// made, or whether it was accepted. A refused command changes nothing and is not recorded.
  template <class Executor, class C> ISO_INLINE auto run(const char* name, Executor& executor, const C& command) {
    using Result = decltype(executor.execute(command));
    const ExclusiveCall call = enter(name);
    if (!call.allowed()) return Result{};
    faults.clear();
    const Result result = pin_floats([&] { return executor.execute(command); });
    faults.sign(name);
    if (static_cast<bool>(result)) journal.record<typename Executor::EveryCommand>(command);
    return result;
  }

  template <class Engine> ISO_INLINE void note_hash(const Engine& engine) {
    if (trace != nullptr) trace->push_back(engine.hash());
  }
  ISO_INLINE void note_load() {
    journal.note_load();
    faults.clear();
  }
  /// Ends recording and tracing as the world is moved, because whoever does them refers to the former object.
  ISO_INLINE void detach() {
    journal.record_to(nullptr);
    trace = nullptr;
  }
};

}  // namespace isostep
