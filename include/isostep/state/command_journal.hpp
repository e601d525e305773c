// CommandJournal: how calls enter a world, and what is kept of them: a command log of what was accepted, a trace of
// hashes of the state, and the faults of what was refused. It is inside a world; a CommandRecorder is beside one.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/fault.hpp"
#include "isostep/core/one_at_a_time.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/state/command_log.hpp"

namespace isostep {

/// Each engine of a world has one. It is no part of the state: it is not saved, loaded or hashed.
class CommandJournal {
 public:
  /// A call that changes the world, from its entry to its return: in the pinned float environment, and alone. A call
  /// from inside another one, as an observer of stages could make it, is refused.
  class Call {
   public:
    ISO_INLINE Call(CommandJournal& journal, const char* name) : entry_(journal.one_at_a_time_) {
      if (!allowed()) journal.refuse_call(name, {Fault::called_in_step, "", "", "observers to change nothing"});
    }
    ISO_INLINE bool allowed() const { return entry_.alone(); }

   private:
    FloatEnvironment environment_;
    OneAtATime::Entry entry_;
  };

  /// Has a command of the closed list Executor::Command executed. Returns what `execute` returns: an id of what was
  /// made, or whether it was accepted. What is refused changes nothing and is not recorded.
  template <class Executor, class C> ISO_INLINE auto run(const char* name, Executor& executor, const C& command) {
    using Result = decltype(executor.execute(command));
    const Call call(*this, name);
    if (!call.allowed()) return Result{};
    fault_ = {};
    const Result result = executor.execute(command);
    sign(name);
    if (static_cast<bool>(result)) record<typename Executor::Command>(command);
    return result;
  }

  /// Has a world play a command log: see play_commands. An error from inside one of its own calls.
  template <class Command, class World> ISO_INLINE Result<void> play(World& world, Bytes log, const Stepper& stepper) {
    if (!Call(*this, "step_recorded").allowed())
      return Error{ErrorCode::invalid, "called while the world steps", "commands"};
    return play_commands<Command>(
        log, [&](const auto& command) ISO_INLINE_LAMBDA { return static_cast<bool>(world.apply(command)); },
        [&]() ISO_INLINE_LAMBDA {
          if (stepper.step == nullptr) world.step();
          else stepper.step(stepper.user);
        });
  }

  // Faults.
  /// While a command executes. Returns false, for the command to return it.
  ISO_INLINE bool refuse(const FaultReport& report) {
    fault_ = report;
    return false;
  }
  ISO_INLINE bool refuse(Fault fault) { return refuse(FaultReport{fault}); }
  ISO_INLINE bool accept(const FaultReport& report) { return report == Fault::none || refuse(report); }
  ISO_INLINE bool accept(Fault fault) { return accept(FaultReport{fault}); }
  /// Writes the command's name into the fault that it left, if it left one, and keeps the first of all faults.
  ISO_INLINE void sign(const char* command) {
    if (fault_ == Fault::none) return;
    fault_.command = command;
    if (first_fault_ == Fault::none) first_fault_ = fault_;
    if (handler_.refused == nullptr || is_handling_) return;  // not of what the handler itself is refused
    is_handling_ = true;
    const FaultReport report = fault_;
    handler_.refused(handler_.user, report);
    is_handling_ = false;
  }
  /// For calls that are no commands. A query that is accepted leaves the fault as it is, so that any number of threads
  /// may query at once.
  ISO_INLINE bool refuse_call(const char* name, const FaultReport& report) {
    refuse(report);
    sign(name);
    return false;
  }
  ISO_INLINE bool accept_call(const char* name, const FaultReport& report) {
    return report == Fault::none || refuse_call(name, report);
  }
  /// Of the last call that was refused. Commands clear it.
  ISO_INLINE const FaultReport& fault() const { return fault_; }
  /// Of the first one since `forget_faults`.
  ISO_INLINE const FaultReport& first_fault() const { return first_fault_; }
  ISO_INLINE void set_fault_handler(const FaultHandler& handler) { handler_ = handler; }
  ISO_INLINE void clear_fault() { fault_ = {}; }
  ISO_INLINE void forget_faults() { fault_ = first_fault_ = {}; }

  /// Of a world that is moved: who records or traces it refers to the object that it was.
  ISO_INLINE void detach() {
    log_ = nullptr;
    trace_ = nullptr;
  }

  // The command log: see play_commands.
  /// Null: to nothing.
  ISO_INLINE void record_to(std::vector<std::uint8_t>* log) { log_ = log; }
  ISO_INLINE bool records_to(const std::vector<std::uint8_t>* log) const { return log_ == log; }
  template <class Command, class C> ISO_INLINE void record(const C& command) {
    if (log_ == nullptr) return;
    Writer writer(*log_);
    write_command<Command>(writer, command);
  }
  ISO_INLINE void record_step() {
    if (log_ != nullptr) log_->push_back(kStepMarker);
  }
  /// The state was replaced by one to which the command log does not lead.
  ISO_INLINE void note_load() {
    ++loads_;
    clear_fault();
  }
  ISO_INLINE std::uint64_t loads() const { return loads_; }

  // The trace: the state's hash as a step begins and after each of its stages.
  /// Null: to nothing.
  ISO_INLINE void trace_to(std::vector<std::uint64_t>* hashes) { trace_ = hashes; }
  ISO_INLINE bool is_tracing() const { return trace_ != nullptr; }
  template <class Engine> ISO_INLINE void trace(const Engine& engine) {
    if (trace_ != nullptr) trace_->push_back(engine.hash());
  }

 private:
  FaultReport fault_, first_fault_;
  FaultHandler handler_;
  bool is_handling_ = false;
  OneAtATime one_at_a_time_;
  std::vector<std::uint8_t>* log_ = nullptr;
  std::vector<std::uint64_t>* trace_ = nullptr;
  std::uint64_t loads_ = 0;
};

}  // namespace isostep
