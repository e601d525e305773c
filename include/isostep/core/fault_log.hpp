// FaultLog: why calls were refused: the last fault, the first one, and whom to tell.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fault.hpp"

namespace isostep {

/// Each world has one. It is no part of the state: it is not saved, loaded or hashed.
class FaultLog {
 public:
  // Keeps the fault of a command while it executes. Returns false, for the command to return it.
  ISO_INLINE bool refuse(const FaultReport& report) {
    last_ = report;
    return false;
  }
  ISO_INLINE bool refuse(Fault fault) { return refuse(FaultReport{fault}); }
  ISO_INLINE bool accept(const FaultReport& report) { return report == Fault::none || refuse(report); }
  ISO_INLINE bool accept(Fault fault) { return accept(FaultReport{fault}); }

  /// Writes the command's name into the fault that it left, if it left one, and keeps the first of all faults.
  ISO_INLINE void sign(const char* command) {
    if (last_ == Fault::none) return;
    last_.command = command;
    if (first_ == Fault::none) first_ = last_;
    if (handler_.refused == nullptr || is_handling_) return;  // not of what the handler itself is refused
    is_handling_ = true;
    const FaultReport report = last_;
    handler_.refused(handler_.user, report);
    is_handling_ = false;
  }

  // Keeps and signs the fault of a call that is no command. A query that is accepted leaves the fault as it is, so that
  // any number of threads may query at once.
  ISO_INLINE bool refuse_call(const char* name, const FaultReport& report) {
    refuse(report);
    sign(name);
    return false;
  }
  ISO_INLINE bool accept_call(const char* name, const FaultReport& report) {
    return report == Fault::none || refuse_call(name, report);
  }

  /// Returns the last refusal. Commands clear it.
  ISO_INLINE const FaultReport& last() const { return last_; }
  /// Returns the first refusal since `forget`.
  ISO_INLINE const FaultReport& first() const { return first_; }
  ISO_INLINE void set_handler(const FaultHandler& handler) { handler_ = handler; }
  ISO_INLINE void clear() { last_ = {}; }
  ISO_INLINE void forget() { last_ = first_ = {}; }

 private:
  FaultReport last_, first_;
  FaultHandler handler_;
  bool is_handling_ = false;
};

}  // namespace isostep
